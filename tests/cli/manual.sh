#!/bin/sh
# brume(1) tells of every option that --help lists; the commands of its examples
# are run, and the scene of brume(5)'s.
. "$(dirname "$0")/lib"
page=$ROOT/man/brume.1

new_case 'every option is in the manual'
brume --help
grep -oE '(^|[ ,;(])(\+[A-Z]+|--[a-z-]+|[A-Z][A-Za-z_]+=)' printed |
    sed 's/^[ ,;(]//; s/=$//' | sort -u >names
[ "$(wc -l <names)" -gt 150 ] || complain 'too few options were found'
while read -r name; do
    case $name in
    --*) wanted="Fl -${name#--}" ;;
    *) wanted=$name ;;
    esac
    grep -qE -e "$(printf '%s' "$wanted" | sed 's/+/[+]/')( |\$)" "$page" ||
        complain "brume.1 lacks $name"
done <names

# Of one sample a pixel, and small; a picture that goes to a viewer is kept.
examples()
{
    sed -n '/^\.Sh EXAMPLES/,/^\.Sh DIAG/s/^\.Dl //p' "$page"
}

new_case 'there are examples, and their files'
write_scene smoke.pov
write_scene fire.pov
printf 'Input_File_Name=smoke.pov\nFinal_Frame=100\n' >film.ini
is "$(examples | wc -l)" 6
examples | grep -v '^sbatch' >commands
while read -r program words; do
    new_case "$program $words"
    is "$program" brume
    # shellcheck disable=SC2086 # the words of a command
    brume ${words%|*} +W8 +H6 --spp 1
    exits 0
    case $words in
    *'| display -') is "$(head -c 2 printed)" P6 ;;
    *) [ "${words%|*}" = "$words" ] || complain "what is $words?" ;;
    esac
done <commands
new_case 'they leave their pictures'
has smoke.exr smoke026.png smoke030.png smoke038.png smoke040.png
lacks smoke025.png smoke041.png

# Its tasks are those of tests/long/slurm.sh.
new_case 'the script of the job array is there'
script=$(examples | sed -n 's/^sbatch [^ ]* \([^ ]*\) film.ini$/\1/p')
[ -x "$ROOT/scenes/$script" ] || complain "no script '$script'"

new_case 'the scene of brume(5)'
cp "$ROOT/scenes/campfire/campfire_05.vdb" fire.vdb
sed -n '/^\.Sh EXAMPLES/,/^\.Ed/{/^\./!p;}' "$ROOT/man/brume.5" |
    sed 1d >example.pov
brume example.pov +W8 +H6 --spp 1
exits 0

end_cases
