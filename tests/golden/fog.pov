// reference 2048 spp, runs of 8 spp
// Light in fog, scattered once, with its shadow: what POV-Ray shows.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -6> right x * 4 / 3 angle 45 look_at <0, 1, 0> }
light_source {
    <-2, 5, 0> rgb <4, 3.5, 3>
    spotlight point_at <0.2, 0, 0> radius 14 falloff 20 tightness 0
}
plane { y, 0 pigment { rgb 0.7 } finish { ambient 0 } }
sphere { <-0.7, 1.8, 0>, 0.35 pigment { rgb 0.8 } finish { ambient 0 } }
box {
    <-3, 0.001, -2>, <3, 4, 2>
    hollow
    pigment { rgbt 1 }
    interior {
        media {
            scattering { 5, rgb <0.10, 0.14, 0.18> eccentricity 0.6 }
            absorption rgb 0.03
            emission rgb <0, 0.002, 0.004>
        }
    }
}
