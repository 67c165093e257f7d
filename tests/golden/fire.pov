// reference 4096 spp, runs of 16 spp
// Simulated fire as the only light: on the ground, on a ball, in its smoke.
#version 3.7;
global_settings {
    assumed_gamma 1
    transport { media multiple surfaces indirect environment on }
}
camera { location <0, 1, -3.4> right x * 4 / 3 angle 42 look_at <0, 0.8, 0> }
plane { y, 0 pigment { rgb <0.6, 0.5, 0.4> } finish { diffuse 0.8 ambient 0 } }
sphere {
    <-0.8, 0.25, 0.1>, 0.25
    pigment { rgb 0.9 }
    finish { diffuse 0.9 ambient 0 }
}
#declare File = "../../scenes/campfire/campfire_04.vdb";
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
                coupling additive
            }
        }
    }
    translate <-0.8, 0.001, -0.8>
}
