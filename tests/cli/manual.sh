#!/bin/sh
# brume(1) tells of every option that --help lists.
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

end_cases
