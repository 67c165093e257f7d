// Each type of scattering, lit from the side and from behind.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -10*z right 4/3*x up y direction 1.4*z }
light_source { <-20, 12, -4> rgb <0.9, 0.6, 0.3> }
light_source { <8, 3, 20> rgb <0.1, 0.25, 0.4> }

#macro Ball(Type, X, Y)
    sphere {
        <X, Y, 0>, 1 hollow
        pigment { rgbt 1 }
        interior {
            media {
                method 3 intervals 1 samples 20
                scattering { Type, rgb <0.5, 0.7, 0.6>
                    #if (Type = 5) eccentricity 0.6 #end }
            }
        }
    }
#end

Ball(1, -2.4, 1.2)
Ball(2, 0, 1.2)
Ball(3, 2.4, 1.2)
Ball(4, -1.2, -1.2)
Ball(5, 1.2, -1.2)
