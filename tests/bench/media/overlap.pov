// Three containers that overlap, of different media; one holds two.
#version 3.7;
global_settings { assumed_gamma 1 }
background { rgb 0.1 }
camera { location -8*z right 4/3*x up y direction 1.8*z }
light_source { <-5, 10, -10> rgb 0.5 }
light_source {
    <6, 2, -2> rgb <0.5, 0.4, 0.3>
    spotlight point_at 0 radius 8 falloff 14
}

#declare Steps = media { method 3 intervals 1 samples 20 }

sphere {
    <-0.6, 0.3, 0>, 1 hollow
    pigment { rgbt 1 }
    interior { media { Steps scattering { 4, <0.3, 0.5, 0.9> } } }
}
sphere {
    <0.6, 0.3, 0.2>, 1 hollow
    pigment { rgbt 1 }
    interior {
        media { Steps scattering { 1, 0.4 extinction 0.5 } }
        media { Steps emission <0.15, 0.05, 0> absorption 0.2 }
    }
}
cylinder {
    -1.4*y, 0.8*y, 0.7 hollow
    pigment { rgbt 1 }
    interior {
        media {
            Steps absorption <0.2, 0.6, 0.6> scattering { 1, 0.3 }
            density { gradient y color_map { [0 rgb 0.2] [1 rgb 1] } }
        }
    }
}
