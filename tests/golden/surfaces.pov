// reference 2048 spp, runs of 8 spp
// Shapes, finishes and lights as POV-Ray has them; no medium.
#version 3.7;
global_settings { assumed_gamma 1 ambient_light rgb 1 }
camera { location <0, 2, -6> right x * 4 / 3 angle 45 look_at <0, 0.8, 0> }
background { rgb <0.1, 0.2, 0.4> }
light_source { <-4, 6, -5> rgb <1, 0.95, 0.9> }
light_source {
    <4, 5, -2> rgb <0.5, 0.5, 0.9>
    spotlight point_at <1, 0, 0> radius 8 falloff 14 tightness 2
    fade_distance 4 fade_power 2
}
plane {
    y, 0
    pigment { checker rgb <0.9, 0.9, 0.8> rgb <0.2, 0.3, 0.2> scale 0.7 }
    finish { ambient 0.1 diffuse 0.7 }
}
sphere {
    <-1.2, 0.8, 0>, 0.8
    pigment { rgb <0.9, 0.2, 0.1> }
    finish { phong 0.8 phong_size 30 }
}
box {
    <-0.5, 0, -0.5>, <0.5, 1.1, 0.5>
    rotate 30 * y
    translate <0.6, 0, 0.8>
    pigment { rgb <0.2, 0.7, 0.3> }
    finish { specular 0.5 roughness 0.02 }
}
cylinder { <1.6, 0, -0.6>, <1.6, 0.9, -0.3>, 0.35 pigment { rgb 0.8 } }
mesh {
    ply "../../scenes/campfire/spot.ply"
    scale 0.5
    rotate 160 * y
    translate <0.2, 0.37, -1.2>
    pigment { rgb <0.8, 0.75, 0.7> }
}
