#!/bin/sh
# INI files: sections, comments, quotes, INI files in INI files, errors.
. "$(dirname "$0")/lib"
write_scene s.pov

cat >film.ini <<'END'
; a film
Input_File_Name = s.pov     # the scene
Output_File_Name="a; film"
Output_File_Type=P
+H6 --spp=1
Width=8
Final_Frame=2
[Draft]
Width=4
END

new_case 'an INI file makes a film'
brume film.ini
exits 0
has 'a; film1.ppm' 'a; film2.ppm'
is "$(ppm_size 'a; film1.ppm')" '8 6'

new_case 'a section is read when it is asked for'
brume 'film.ini[draft]' +Odraft
exits 0
is "$(ppm_size draft1.ppm)" '4 6'

new_case 'a section that is not there'
brume 'film.ini[final]'
exits 2
says "'film.ini' has no section [final]"

new_case 'an error has file, line, column and the line'
printf 'Width=8\n  Hieght=6\n' >wrong.ini
brume wrong.ini
exits 2
says "wrong.ini:2:3: error: unknown option 'Hieght'"
says 'Hieght=6'
says "did you mean 'Height'?"

new_case 'an empty INI file names no scene'
: >empty.ini
brume empty.ini
exits 2
says 'no scene is given'

new_case 'an INI file may name another, and a loop is found'
printf 'film.ini\nOutput_File_Name=nested\n' >outer.ini
brume outer.ini
exits 0
has nested1.ppm nested2.ppm
printf 'loop2.ini\n' >loop1.ini
printf '+W3\nloop1.ini\n' >loop2.ini
brume loop1.ini
exits 2
says "loop2.ini:2:1: error: 'loop1.ini' would be read within itself"

new_case 'a missing one'
brume missing.ini
exits 5
says "can't open 'missing.ini'"

new_case 'a folder, a binary file and a long one are no INI files'
mkdir folder.ini
brume folder.ini
exits 5
head -c 3000 /dev/zero >zero.ini
brume zero.ini
exits 2
says 'zero.ini:1:1: error: a NUL byte'
yes '; comment' | head -c 2000000 >long.ini
brume long.ini
exits 3

new_case 'the scene may lie beside the INI file'
mkdir sub
write_scene sub/beside.pov
printf 'Input_File_Name=beside.pov\n+W4 +H3 --spp=1\n' >sub/sub.ini
brume sub/sub.ini
exits 0
has beside.png

new_case 'brume.ini, povray.ini and the user'\''s are read first'
mkdir -p home/.config/brume
printf 'Width=7\nHeight=5\nOutput_File_Type=P\n' >home/.config/brume/brume.ini
brume s.pov +Ouser --spp 1
exits 0
is "$(ppm_size user.ppm)" '7 5'
printf '+W6 +H4 +FP\n' >povray.ini
brume s.pov +Olocal --spp 1 +W3
is "$(ppm_size local.ppm)" '3 4'
printf 'Widht=3\n' >brume.ini
brume s.pov --spp 1
exits 2
says 'brume.ini:1:1: error'
rm brume.ini povray.ini home/.config/brume/brume.ini

new_case 'an INI file as ASE writes it'
cat >ase.ini <<'END'
Input_File_Name=s.pov
Output_to_File=True
Output_File_Type=N
Output_Alpha=on
; if you adjust Height, and width, you must preserve the ratio
; Width / Height = 1.338191
Width=20
Height=14.9456926
Antialias=True
Antialias_Threshold=0.1
Display=False
Display_Gamma=sRGB
Pause_When_Done=True
Verbose=False
END
brume ase.ini --spp 1
exits 0
has s.png

end_cases
