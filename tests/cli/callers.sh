#!/bin/sh
# The command lines of programs that call povray.
. "$(dirname "$0")/lib"
write_scene F.pov
mkdir dir

new_case 'vapory'
brume F.pov +H12 +W16 +Q9 +A0.100000 Output_Alpha=on -D +Ldir \
    Output_File_Type=N +OF.png --spp 1
exits 0
has F.png
prints_nothing

new_case 'vapory, to an array'
brume F.pov +H12 +W16 -D Output_File_Type=P +O- --spp 1
exits 0
is "$(head -c 2 printed)" P6
is "$(ppm_size printed)" '16 12'

new_case 'PyMOL'
rm F.png
brume -D +IF.pov +OF.png +W16 +H12 +A --spp 1
exits 0
has F.png

new_case 'parts by fractions'
brume F.pov +Q9 +SC0.25 +EC0.75 +SR0.25 +ER0.75 -D +FN +W16 +H12 --spp 1
exits 0

new_case 'a header and a body'
echo '#declare Head = 3;' >header.pov
echo '#debug concat("Head ", str(Head, 0, 0), "\n")' >body.pov
brume +HIheader.pov +Ibody.pov --check
exits 0
says 'Head 3'

new_case 'a clock, and a film by its end alone'
brume F.pov +K07 --check
says 'clock 7.000'
brume F.pov +kff50 +kf2 +kc --check
exits 0
says 'frame 50 clock 1.960 of 51'

new_case 'VMD asks for TGA, which is not there yet'
brume +W16 +H12 -IF.pov -OF.tga +D +X +A +FT
exits 2
says "file type 'T' is not supported yet"

end_cases
