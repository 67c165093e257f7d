#!/bin/sh
# Code made for scenes that hold less makes the same picture as the code for any
# scene, which a torus asks for: it is within a body, where no light comes.
. "$(dirname "$0")/lib"
compare=$ROOT/${B:-build}/tests/tools/compare

cat >lean.pov <<'END1'
#version 3.7;
global_settings {
    assumed_gamma 1
    transport { media multiple surfaces indirect environment on }
}
camera { location <0, 1, -3.4> look_at <0, 0.8, 0> }
mesh { triangle { <-9, 0, -9>, <9, 0, -9>, <0, 0, 9> } pigment { rgb 0.6 } }
mesh { ply "spot.ply" scale 0.4 translate <-1.2, 0.5, 0.3> pigment { rgb 0.8 } }
#declare File = "campfire_04.vdb";
box {
    0, <1.6, 2.4, 1.6>
    hollow
    pigment { rgbt 1 }
    interior {
        media {
            density { density_file vdb File "density" up z }
            scattering { 5, rgb 10 eccentricity 0.3 }
            absorption rgb 3
            fire {
                temperature { density_file vdb File "temperature" up z }
                amount { density_file vdb File "flame" up z }
                kelvin 1000, 0
                intensity 20
                reference 2000
            }
        }
    }
    translate <-0.8, 0, -0.8>
}
END1
cp lean.pov any.pov
echo 'torus { 0.02, 0.01 translate <-1.2, 0.5, 0.3> pigment { rgb 0.5 } }' >>any.pov
cp "$ROOT/scenes/campfire/spot.ply" "$ROOT/scenes/campfire/campfire_04.vdb" .

for integrator in path photon progressive; do
    new_case "fire among meshes, by $integrator"
    for scene in lean any; do
        quick $scene.pov --integrator $integrator --photons 20000 --spp 8 \
            +O$integrator-$scene.exr +W64 +H48
        exits 0
    done
    "$compare" same $integrator-lean.exr $integrator-any.exr >&2 ||
        complain 'the pictures differ'
done
end_cases
