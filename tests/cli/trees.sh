#!/bin/sh
# Pictures do not depend on the tree in which surfaces are found.
. "$(dirname "$0")/lib"

cat >film.pov <<'END1'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 }
light_source { <10, 10, -10> rgb 1 }
plane { y, -1 pigment { checker rgb 0.9 rgb 0.4 } }
sphere { <2 * clock - 1, 0, -1>, 0.5 pigment { rgb <1, 0.5, 0.25> } }
difference {
    box { -0.7, 0.7 }
    sphere { 0.3, 0.7 }
    pigment { rgb <0.3, 0.5, 1> }
}
mesh { ply "spot.ply" scale 0.8 translate <-1, 0, 1> pigment { rgb 0.8 } }
END1
cp "$ROOT/scenes/campfire/spot.ply" .

new_case 'the frames of a film are the same by all'
for tree in bvh kd both; do
    quick film.pov +KFF3 --tree $tree +O$tree.exr +W64 +H48
    exits 0
    is_silent
    for frame in 1 2 3; do
        same bvh$frame.exr $tree$frame.exr
    done
done

new_case 'and by any stack'
for stack in 1 2 32; do
    quick film.pov --tree kd --stack $stack +Ostack$stack.exr +W64 +H48
    exits 0
    same stack1.exr stack$stack.exr
done

new_case 'the plan tells of it'
for tree in 'bvh a BVH' 'kd a kd-tree'; do
    brume film.pov --explain --backend cpu --tree "${tree%% *}"
    grep -q "accel .*geometry, in ${tree#* }\$" printed ||
        complain "not: ${tree#* }"
done

new_case 'a stack that there is not'
for stack in 0 33 many; do
    quick film.pov --tree kd --stack $stack
    exits 2
done
quick film.pov --tree oak
exits 2

new_case 'where it is built'
quick film.pov +KFF3 --tree-on cpu +Oon.exr +W64 +H48
exits 0
same bvh2.exr on2.exr
quick film.pov --tree-on mars
exits 2

end_cases
