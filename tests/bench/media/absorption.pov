// Absorption alone, in front of a bright background.
#version 3.7;
global_settings { assumed_gamma 1 }
background { rgb <0.9, 0.8, 0.7> }
camera { location -5*z right 4/3*x up y direction 1.7*z }

box {
    -1, 1 hollow
    pigment { rgbt 1 }
    interior {
        media {
            method 3 intervals 1 samples 20
            absorption <0.6, 1.2, 2.4>
            density { bozo scale 0.7 color_map { [0.3 rgb 0] [0.7 rgb 1] } }
        }
    }
    rotate <20, 35, 0>
}
