// reference 4096 spp, runs of 16 spp
// Simulated smoke, lit from the side and from the ground, scattered often.
#version 3.7;
global_settings {
    assumed_gamma 1
    transport { media multiple surfaces indirect environment on }
}
camera { location <0, 1.1, -4> right x * 4 / 3 angle 42 look_at <0, 1, 0> }
background { rgb <0.1, 0.15, 0.25> }
light_source { <30, 30, -20> rgb <1, 0.9, 0.8> }
plane { y, 0 pigment { rgb <0.6, 0.5, 0.4> } finish { diffuse 0.8 ambient 0 } }
box {
    0, <1.6, 2.4, 1.6>
    hollow
    pigment { rgbt 1 }
    interior {
        media {
            density {
                density_file vdb "../../scenes/campfire/campfire_08.vdb"
                    "density" up z
            }
            scattering { 1, rgb <60, 55, 50> }
            absorption rgb <2, 3, 4>
        }
    }
    translate <-0.8, 0.001, -0.8>
}
