// A density file that scatters and absorbs, and shades itself.
#version 3.7;
global_settings { assumed_gamma 1 }
background { rgb <0.05, 0.07, 0.1> }
camera { location <1.5, 1, -4> look_at <0, 0, 0> angle 36 }
light_source { <-6, 8, -3> rgb <1, 0.9, 0.8> }

box {
    0, 1 hollow
    pigment { rgbt 1 }
    interior {
        media {
            method 3 intervals 1 samples 20
            scattering { 1, 3 }
            absorption <0.5, 0.8, 1.2>
            density { density_file df3 "smoke.df3" interpolate 1 }
        }
    }
    translate -0.5 scale 2
}
