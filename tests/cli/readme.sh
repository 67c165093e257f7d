#!/bin/sh
# The commands of README.md are run, on the scene it shows; `make demo` and
# `make test`, which hold this test, are not.
. "$(dirname "$0")/lib"

# block LANGUAGE: the lines of the README's blocks in that language.
block()
{
    awk -v fence="^\`\`\`$1\$" '$0 ~ fence { inside = 1; next }
        /^```/ { inside = 0 } inside' "$ROOT/README.md"
}

block pov >fog.pov
block sh | sed 's/ *#.*//' | grep -vE '^make (demo|test)$' >commands

new_case 'there are commands, and a scene'
has fog.pov commands

# One sample a pixel, or a second, is enough to know that a command runs.
while read -r program words; do
    new_case "$program $words"
    is "$program" build/brume
    case $words in
    *--temporal*) least='--spp 1 --photons 100' ;;
    measure*) least='--budget 1' ;;
    *) least='--spp 1' ;;
    esac
    # shellcheck disable=SC2086 # the words of a command
    brume $words $least
    exits 0
done <commands

new_case 'they leave their pictures'
has fog.png fog.exr film1.png film4.png fog.flicker.csv

end_cases
