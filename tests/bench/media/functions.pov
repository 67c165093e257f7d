// Densities that are functions of the place: a torus of haze, and fog in
// layers that waver.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.6, -6> look_at <0, -0.1, 0> angle 32 }
light_source { <5, 6, -4> rgb <0.5, 0.6, 0.7> }

sphere {
    0, 1.6 hollow
    pigment { rgbt 1 }
    interior {
        media {
            method 3 intervals 1 samples 20
            scattering { 1, 1.5 }
            density {
                function {
                    max(0, 1 - 6*(pow(sqrt(x*x + z*z) - 1, 2) + y*y))
                }
            }
        }
        media {
            method 3 intervals 1 samples 20
            scattering { 1, <0.2, 0.3, 0.4> }
            density { function { 0.5 + 0.5*sin(6*y + sin(3*x)) } }
        }
    }
}
