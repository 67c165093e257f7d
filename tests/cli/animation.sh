#!/bin/sh
# Films: clocks, numbers, subsets, and what is left of a film that fails.
. "$(dirname "$0")/lib"
write_scene s.pov

new_case 'each frame reads the scene with its clock'
quick s.pov +KFF3 +Ofilm
exits 0
has film1.png film2.png film3.png
is "$(grep -c frame said)" 3
says 'frame 1 clock 0.000 of 3'
says 'frame 2 clock 0.500 of 3'
says 'frame 3 clock 1.000 of 3'

new_case 'a cyclic film'
brume s.pov --check +KFI2 +KFF4 +KC +KI1 +KF4
exits 0
says 'frame 2 clock 1.000 of 5'
says 'frame 4 clock 3.000 of 5'

new_case 'one frame of 1 to 1 is a still'
quick s.pov +KFI1 +KFF1 +Ostill
exits 0
has still.png
says 'frame 0 clock 0.000 of 0'
brume s.pov --check +K0.25
says 'frame 0 clock 0.250 of 0'

new_case 'a subset has the names and clocks of the whole'
quick s.pov +KFF12 +SF11 +EF1.0 +EF11 +Osub.png
exits 0
has sub11.png
is "$(echo sub*)" 'sub.frames.jsonl sub11.png'
brume s.pov --check +KFF10 +SF0.5 +EF0.75
is "$(grep -c frame said)" 3
says 'frame 5 clock 0.444 of 10'

new_case 'a frame is the same alone and in the film'
quick s.pov +KFF3 +SF2 +EF2 +Oalone
exits 0
same alone2.png film2.png
cmp -s film1.png film2.png && complain 'the clock has no effect'

new_case 'a film down a pipe'
quick s.pov +KFF3 +FP +O-
exits 0
quick s.pov +KFF3 +FP +Opart
cat part1.ppm part2.ppm part3.ppm >all.ppm
"$BRUME" s.pov +W8 +H6 --spp 2 +KFF3 +FP +O- >printed 2>/dev/null
same printed all.ppm

new_case 'frames before one that fails stay'
{
    cat s.pov
    echo '#if (frame_number = 2) #error "no second frame" #end'
} >fails.pov
quick fails.pov +KFF3 +Ofails --stats stats.json
exits 1
says 'no second frame'
has fails1.png stats.json
lacks fails2.png fails3.png
grep -q '"exit_code": 1' stats.json || complain 'stats tell of no error'

new_case 'a warning is told once, not for each frame'
{
    cat s.pov
    echo '#warning "mind the gap"'
} >warns.pov
brume warns.pov --check +KFF4
exits 0
is "$(grep -c 'warning: mind the gap' said)" 1

new_case '--gpus where there is none, or for what the CPU renders'
rm -f s*.png
brume s.pov +W4 +H4 --spp 1 +KFF2 --backend cpu --gpus 2
exits 7
says '--gpus: no GPU can be used: the CPU is asked for'
lacks s1.png
brume s.pov --gpus 0
exits 2
brume s.pov --gpus some
exits 2

end_cases
