// Emission alone, of colored densities.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -5*z right 4/3*x up y direction 1.7*z }

sphere {
    0, 1 hollow
    pigment { rgbt 1 }
    interior {
        media {
            method 3 intervals 1 samples 20
            emission 0.6
            density {
                spherical
                color_map {
                    [0 rgb 0]
                    [0.3 rgb <0.8, 0.2, 0.05>]
                    [0.6 rgb <1, 0.7, 0.2>]
                    [1 rgb <0.6, 0.8, 1>]
                }
                turbulence 0.4
            }
        }
    }
}
