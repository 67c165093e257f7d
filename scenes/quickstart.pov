// quickstart.pov - a campfire at night, and a cow that has come to look.
//
//   brume scenes/quickstart.pov +W640 +H480 +Ofire.png       one picture
//   brume scenes/campfire.ini                                eight, animated
//
// Fire and smoke were simulated with Blender (README.md tells how); the rest
// is plain scene language. Lengths are metres, and y is up.
#version 3.7;

#ifndef (brume)
    #error "this scene uses Brume's words: vdb, fire, ply, transport"
#end

global_settings {
    assumed_gamma 1
    // Fire and moon light the smoke and the ground, and what these scatter
    // lights on; the night sky lights a little too.
    transport { media multiple surfaces indirect environment on }
    accuracy 0.09       // stop at this relative error of the picture
}

// In a film the clock goes from 0 to 1: the eye moves on, the moon sets, the
// guest turns. A still shows the middle of that.
#declare Time = (clock_on ? clock : 0.5);

camera {
    location <0.95, 0.85, -3.1> + 0.3 * (Time - 0.5) * x
    right x * image_width / image_height
    angle 42
    look_at <-0.26, 0.70, 0>
}

background { rgb <0.010, 0.016, 0.034> }

// The moon: far away, and no dimmer for it, since nothing says fade_distance.
light_source { <-400, 500, -250> rgb <0.6, 0.75, 1> * 0.13 * (1.5 - Time) }

// ---- the ground

plane {
    y, 0
    pigment { color rgb <0.30, 0.23, 0.17> }
    finish { diffuse 0.9 ambient 0 }
}

// Stones lie around the fire, pebbles anywhere.
#declare Chance = seed(7);

#macro Stone(Place, Size)
    sphere {
        0, 1
        scale Size * <1, 0.65 + 0.2 * rand(Chance), 0.8>
        rotate y * 360 * rand(Chance)
        translate Place
        pigment { color rgb <0.42, 0.40, 0.38> * (0.6 + 0.6 * rand(Chance)) }
        finish { diffuse 0.8 ambient 0 specular 0.15 roughness 0.05 }
    }
#end

#declare Stones = 15;
#for (I, 0, Stones - 1)
    Stone(vrotate(<0.62, 0.03, 0>, y * 360 * (I + 0.4 * rand(Chance)) / Stones),
          0.08 + 0.04 * rand(Chance))
#end

#for (I, 1, 220)
    Stone(vrotate(<0.8 + 3.5 * rand(Chance), 0, 0>, y * 360 * rand(Chance)),
          0.008 + 0.022 * pow(rand(Chance), 3))
#end

// ---- pines behind the clearing, and firewood

#macro Pine(Place, Height)
    union {
        cone { 0.10 * y, 0.28, 0.55 * y, 0.06 }
        cone { 0.35 * y, 0.22, 0.80 * y, 0.04 }
        cone { 0.60 * y, 0.15, 1.00 * y, 0.00 }
        cylinder { 0, 0.2 * y, 0.04 }
        scale Height
        translate Place
        pigment { color rgb <0.05, 0.08, 0.05> }
        finish { diffuse 0.8 ambient 0 }
    }
#end

#for (I, 0, 24)
    #local Angle = 4 * I - 52 + 3 * rand(Chance);
    #local Place = vrotate((8 + 9 * rand(Chance)) * z, Angle * y);
    Pine(Place, 1.6 + 1.8 * rand(Chance))
#end

#declare Bark = texture {
    pigment { color rgb <0.16, 0.09, 0.05> }
    finish { diffuse 0.8 ambient 0 }
}

#declare Logs = 6;
#for (I, 0, Logs - 1)
    cylinder {
        <0.50, 0.05, 0>, <0.03, 0.24, 0.05>, 0.045 + 0.015 * rand(Chance)
        rotate y * (360 * I / Logs + 20 * rand(Chance))
        texture { Bark }
    }
#end

// ---- the guest: Spot, by Keenan Crane

mesh {
    ply "campfire/spot.ply"
    translate 0.737 * y         // on her feet
    scale 0.62
    rotate (-128 + 16 * (Time - 0.5)) * y   // her face to the fire
    translate <-1.22, 0, 0.25>
    pigment { color rgb <0.80, 0.76, 0.70> }
    finish { diffuse 0.85 ambient 0 specular 0.2 roughness 0.03 }
}

// ---- fire and smoke

// frame_number is 0 in a still.
#declare Frame = (frame_number > 0 ? frame_number : 5);
#declare File = concat("campfire/campfire_", str(Frame, -2, 0), ".vdb");

// Blender's z is up: `up z` turns the grids. They fill the box from 0 to
// <1.6, 2.4, 1.6>, with the fire in the middle of its floor.
box {
    0, <1.6, 2.4, 1.6>
    hollow
    pigment { rgbt 1 }
    interior {
        media {
            density { density_file vdb File "density" up z }
            scattering { 5, rgb 3 eccentricity 0.3 }
            absorption rgb 1.5
            fire {
                temperature { density_file vdb File "temperature" up z }
                amount { density_file vdb File "flame" up z }
                kelvin 1000, 0          // the grid's 1 is 1000 K
                brightness total        // as T^4, milder than to the eye
                reference 2000          // kelvin at which it is `intensity`
                intensity 6
                coupling additive       // flames shine without smoke too
            }
        }
    }
    translate <-0.8, -0.03, -0.8>
}
