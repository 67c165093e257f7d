#!/bin/sh
# Particles as a user meets them: a scene of them, and the depth of one.
. "$(dirname "$0")/lib"
compare=$ROOT/${B:-build}/tests/tools/compare

# glow FILE X0 Y0 X1 Y1: mean radiance of a part.
glow()
{
    "$compare" mean "$@"
}

new_case 'the whirl glows, and lights the ground'
brume "$ROOT/scenes/whirl.pov" +W48 +H64 --spp 8 +Owhirl.exr
exits 0
for part in '20 24 28 48' '4 56 44 62'; do
    # shellcheck disable=SC2086
    mean=$(glow whirl.exr $part)
    awk -v mean="$mean" 'BEGIN { exit !(mean > 0.01 && mean < 50) }' ||
        complain "$part: $mean"
done

new_case 'the plan tells of them'
brume "$ROOT/scenes/whirl.pov" --explain
exits 0
prints 'of 3000 particles of radius'
prints "grid 1 'temperature'"

# One particle of mass 2 and radius 1, seen through its centre: an optical
# depth of 0.5 * 9 * 2 / (2 pi), and with half the extinction half of it.
cat >one.ply <<END
ply
format ascii 1.0
element vertex 1
property float x
property float y
property float z
property float mass
end_header
0 0 0 2
END
for extinction in 0.5 0.25; do
    new_case "one particle is as deep as it should be: $extinction"
    cat >one.pov <<END
#version 3.7;
camera { orthographic location <0, 0, -5> right 0.01*x up 0.01*y look_at 0 }
background { rgb 1 }
box { -2, 2 hollow pigment { rgbt 1 }
    interior { media { absorption $extinction
        density { density_file particles "one.ply" radius 1 voxel 0.05 } } } }
END
    brume one.pov +W4 +H4 --spp 4000 +Oone.exr
    exits 0
    mean=$(glow one.exr 0 0 4 4)
    awk -v mean="$mean" -v sigma="$extinction" 'BEGIN {
        truth = exp(-sigma * 9 * 2 / (2 * 3.14159265))
        exit !((mean / truth - 1) ^ 2 < 0.01 ^ 2) }' || complain "$mean"
done

end_cases
