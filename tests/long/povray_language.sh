#!/bin/bash
# The cases of tests/parse that write with #debug and have no diagnostics, run
# by POV-Ray, which must write the same but for blanks and the same files. A case that POV-Ray
# reads otherwise says so in a section `-- unlike POV-Ray: the reason`.
set -u
cd "$(dirname "$0")/../parse" || exit 2
if ! command -v povray >/dev/null; then
    echo "ok - language # SKIP povray is not installed"
    exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Each case becomes a folder: its texts, and what it should write in `out`.
cat ./*.txt | awk -v work="$work" '
    function begin(file) { to = file; printf "" >to }
    /^== / {
        folder = sprintf("%s/%03d", work, ++count)
        system("mkdir -p " folder "/library")
        print substr($0, 4) >(folder "/name")
        begin(folder "/scene.pov")
        print "#version 3.7; global_settings { assumed_gamma 1 }" >to
        next
    }
    /^-- file / { begin(folder "/" $3); next }
    /^-- out/ { begin(folder "/out"); next }
    /^-- wrote / {
        system("mkdir -p " folder "/wrote")
        begin(folder "/wrote/" $3)
        next
    }
    /^-- (set|diag|unlike)/ { begin(folder "/special"); next }
    { print >to }'

cd "$work" || exit 2
for folder in [0-9]*; do
    [ -e "$folder/out" ] && [ ! -e "$folder/special" ] || continue
    # Bytes and NULs are spelled out in the cases.
    grep -q '%[xN]' "$folder/scene.pov" && continue
    echo '#debug "\n"' >>"$folder/scene.pov"
    # Into a file: what the terminal gets is mixed with reports of progress.
    (cd "$folder" && povray -D -F +W1 +H1 +WT1 -GR -GS +Llibrary +GDdebug \
        scene.pov >/dev/null 2>&1)
    got=$(tr -d ' \n\t\r' <"$folder/debug")
    want=$(tr -d ' \n\t\r' <"$folder/out")
    for file in "$folder"/wrote/*; do
        [ -e "$file" ] || continue
        got=$got$(tr -d '\n' <"$folder/${file##*/}")
        want=$want$(tr -d '\n' <"$file")
    done
    if [ "$got" = "$want" ]; then
        echo "ok - language: $(<"$folder/name")"
    else
        echo "not ok - language: $(<"$folder/name")"
        echo "# POV-Ray: $got"
        echo "# expected: $want"
    fi
done
