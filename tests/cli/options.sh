#!/bin/sh
# The command line: switches, INI options, long options, and their errors.
. "$(dirname "$0")/lib"
write_scene s.pov

new_case 'a picture is written beside the scene'
quick s.pov
exits 0
has s.png
prints_nothing

new_case 'size and name are obeyed'
brume -Is.pov +W12 -H10 +Fp -Oout --spp 1
exits 0
is "$(ppm_size out.ppm)" '12 10'

new_case 'INI options stand on the command line too'
brume Input_File_Name=s.pov Width=9 Height=7.99 Output_File_Type=P \
    Output_File_Name=ini --spp 1
exits 0
is "$(ppm_size ini.ppm)" '9 7'

new_case 'the last of several counts'
brume nope.pov +W100 s.pov +W5 +H4 +FN +FP +Olast --spp 1
exits 0
is "$(ppm_size last.ppm)" '5 4'

new_case '--help prints every option and ends with 0'
brume --help
exits 0
prints '+Wn, Width=n'
prints '--threads n'
is_silent

new_case '-h alone is help, -H8 is a height'
brume -h
exits 0
prints 'usage: brume'
brume s.pov -h6 +W8 --spp 1
exits 0

new_case '--version prints the version'
brume --version
exits 0
is "$(cat printed)" "brume $(sed -n 's/^#define BRUME_VERSION "\(.*\)"/\1/p' \
    "$ROOT/core/brume.h")"

new_case 'no scene'
brume
exits 2
says 'no scene is given'
says '--help'

new_case 'an unknown option is named, with a suggestion'
brume s.pov --treads 3
exits 2
says "unknown option '--treads'"
says "did you mean '--threads'?"

new_case 'every error is told, not the first alone'
brume s.pov +W0 +Hx --spp 0 Widht=3
exits 2
says '+W: 0 is not in the range 1 to'
says "+H: 'x' is not a number"
says '--spp: 0 is not in the range 1 to'
says "did you mean 'Width'?"
lacks x.png

new_case 'a switch takes no blank'
brume s.pov +W 8
exits 2
says '+W: a value is missing'

new_case 'what is not supported yet says so'
for word in --preview +FJ +FT +UF Create_Ini=on; do
    brume s.pov "$word"
    exits 2
    says 'not supported yet'
done

new_case 'what has no effect is accepted'
quick s.pov +A0.1 +AM2 +R3 +J -D +P +X +Q9 +MB25 Display_Gamma=sRGB \
    -GS -GW -GD
exits 0
is_silent

new_case 'low quality and shell commands warn'
quick s.pov -GD +Q3 Post_Frame_Command='touch ran'
exits 0
says 'warning: +Q: no effect'
says 'warning: Post_Frame_Command: left out'
lacks ran

new_case 'numbers can be declared'
echo '#debug concat("N is ", str(N, 0, 2), "\n")' >declared.pov
brume declared.pov --check Declare=N=7.25
exits 0
says 'N is 7.25'
brume declared.pov --check Declare=N=seven
exits 2
says "Declare: 'seven' is not a number"

new_case 'a part is rendered, the rest is black'
brume s.pov +W8 +H6 +SC3 +EC0.5 +SR1 +ER2 +FP +Opart --spp 1
exits 0
is "$(ppm_size part.ppm)" '8 6'
is "$(ppm_pixel part.ppm 8 6 1 0)" '0 0 0'
is "$(ppm_pixel part.ppm 8 6 4 0)" '0 0 0'
is "$(ppm_pixel part.ppm 8 6 2 2)" '0 0 0'
[ "$(ppm_pixel part.ppm 8 6 2 0)" != '0 0 0' ] || complain 'part is black'

new_case 'a part that is none'
brume s.pov +W8 +H6 +SC9
exits 2
says 'start column 9 lies beyond the last, 8'
brume s.pov +W8 +H6 +SR5 +ER3
exits 2
says 'no row is left from 5 to 3'

new_case 'an endless medium that absorbs nothing is told'
endless='media { scattering { 1, rgb <0.1, 0.1, 0.2> }'
echo "camera {} light_source { 2, 1 } box { -9, 9 pigment { rgb 0 } }
      $endless }" >open.pov
quick open.pov
exits 0
is_silent
brume open.pov +W1 +H1 --spp 1 --transport full
exits 0
says 'scatter light without absorbing any'
echo "camera {} light_source { 9, 1 } sphere { 3*z, 1 }
      $endless absorption rgb 0.1 }" >dim.pov
brume dim.pov +W2 +H2 --spp 1 --transport full +Odim.png
exits 0
is_silent

end_cases
