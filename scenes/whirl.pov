// whirl.pov - a whirl of fire, of three thousand particles.
//
//   brume scenes/whirl.pov +W480 +H640 +Owhirl.png
//
// The particles of whirl/whirl.ply have a mass and a temperature and no radius:
// each becomes a ball that reaches its 32nd neighbour. Lengths are metres.
#version 3.7;

#ifndef (brume)
    #error "this scene uses Brume's words: particles, fire, transport"
#end

global_settings {
    assumed_gamma 1
    // The fire lights its smoke and the ground.
    transport { media multiple surfaces indirect environment off }
    accuracy 0.1        // stop at this relative error
}

camera {
    location <0, 1.3, -5.2>
    right x * image_width / image_height
    up y
    angle 30
    look_at <0, 1.22, 0>
}

plane {
    y, 0
    pigment { color rgb <0.28, 0.24, 0.21> }
    finish { diffuse 0.9 ambient 0 }
}

box {
    <-1, 0, -1>, <1, 3, 1>
    hollow
    pigment { color rgbt 1 }
    interior {
        media {
            // The density is of mass: 3 of it in all, in a few cubic metres.
            absorption 0.2
            scattering { 1, 0.5 }
            density { density_file particles "whirl/whirl.ply" }
            fire {
                temperature { density_file particles "whirl/whirl.ply" }
                kelvin 1, 300           // the file's are kelvin; 300 more
                intensity 4
            }
        }
    }
}
