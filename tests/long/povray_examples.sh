#!/bin/sh
# POV-Ray's own example scenes through --check, with Brume's include files and
# with POV-Ray's: all but those named below are without error. The scenes of
# portfolio/ need their INI files.
. "$(dirname "$0")/../cli/lib"
examples=/usr/share/doc/povray/examples
theirs=/usr/share/povray-3.7/include
[ -d "$examples" ] || { echo 'povray-examples is not installed'; exit 77; }

# Why each is not accepted yet:
#   benchmark     a function of a pigment whose pattern is not drawn yet
#   __empty cliche sort   cannot be used with POV-Ray either
known='/(benchmark|__empty|cliche|sort)\.(pov|ini)$'

cp -r "$examples" copy
find copy -name '*.pov' ! -path '*/portfolio/*' >list
find copy/portfolio -name '*.ini' >>list

# accepts FOLDER: of include files.
accepts()
{
    grep -vE "$known" list | while read -r scene; do
        (cd "$(dirname "$scene")" &&
            timeout 60 "$BRUME" "$(basename "$scene")" --check +SF1 +EF1 \
                "+L$1" >/dev/null 2>&1 </dev/null) || echo "$scene"
    done >refused
    is "$(cat refused)" ''
}

new_case "with Brume's include files"
accepts "$ROOT/scenes/include"

new_case "with POV-Ray's include files"
accepts "$theirs"

end_cases
