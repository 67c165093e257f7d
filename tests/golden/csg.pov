// reference 4096 spp, runs of 64 spp
// Composites: cut, nested, clipped, transparent, and full of media.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.1 diffuse 0.7 } }
camera { location <0, 5, -11> look_at <0, 0, 0> angle 50 }
light_source { <-8, 14, -10>, rgb 1 }
background { rgb <0.3, 0.4, 0.6> }
plane { y, -1.01 pigment { rgb 0.6 } }

difference {
  box { -1, 1 }
  sphere { 0, 1.3 pigment { rgb <0.2, 0.4, 0.9> } }
  pigment { rgb <0.9, 0.2, 0.1> }
  translate -3*x
}
difference {
  intersection { box { -1, 1 } sphere { 0, 1.3 pigment { rgb <0.2, 0.4, 0.9> } } }
  cylinder { -3*y, 3*y, 0.5 pigment { rgb <0.9, 0.8, 0.1> } }
  pigment { rgb <0.2, 0.8, 0.3> }
}
sphere {
  0, 1
  pigment { rgb <0.9, 0.8, 0.1> }
  clipped_by { plane { <0.5, 1, -0.7>, 0.2 } }
  translate 3*x
}
intersection {
  union { sphere { -0.4*x, 0.6 } sphere { 0.4*x, 0.6 } }
  box { <-2, -1, -2>, <2, 0.3, 0.2> }
  pigment { rgbt <0.8, 0.9, 1, 0.6> }
  translate <-1.5, -0.3, -4>
}
difference {
  sphere { 0, 0.9 }
  cylinder { -2*z, 2*z, 0.4 }
  hollow
  pigment { rgbt 1 }
  interior { media { absorption 1.5 emission <0.6, 0.2, 0.1> } }
  translate <1.5, -0.1, -4>
}
merge {
  torus { 0.8, 0.3 }
  blob { threshold 0.6 sphere { 0.5*y, 1.2, 2 } cylinder { -y, y, 0.6, 1.5 } }
  pigment { rgb <0.3, 0.6, 0.9> }
  rotate -30*x
  translate <-1.5, 0, 3>
}
lathe {
  cubic_spline 6, <0.2, -1.5>, <0.6, -1>, <0.9, -0.3>, <0.3, 0.4>, <0.5, 1>, <0.4, 1.6>
  pigment { rgb <0.9, 0.6, 0.2> }
  translate <2, 0, 3>
}
