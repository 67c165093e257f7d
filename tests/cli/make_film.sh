#!/bin/sh
# `make film` joins the frames of the example film, small, into one file of 48.
. "$(dirname "$0")/lib"
for program in ffmpeg ffprobe make; do
    command -v $program >/dev/null || { echo "no $program"; exit 77; }
done
[ "${B:-build}" = build ] || { echo 'only for the plain build'; exit 77; }
unset MAKEFLAGS MAKELEVEL

new_case 'make film'
make -C "$ROOT" --no-print-directory do-film "FILM_TO=$PWD" \
    FILM_WORDS='+W64 +H48 --spp 1 --photons 1000 --backend cpu' >printed 2>said
took $?
exits 0
has campfire1.png campfire8.png
prints "The film is $PWD/campfire.mp4."

new_case 'its frames'
ffprobe -v error -count_frames -select_streams v -of csv=p=0 \
    -show_entries stream=width,height,nb_read_frames campfire.mp4 >printed
is "$(cat printed)" 64,48,48
ffmpeg -v error -i campfire.mp4 -vf 'select=eq(n\,0)+eq(n\,4)+eq(n\,40)' \
    -vsync 0 frame%d.ppm 2>said
cmp -s frame1.ppm frame2.ppm && complain 'nothing moves'

end_cases
