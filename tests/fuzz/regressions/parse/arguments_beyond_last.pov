diff3ip gment { rgb <0.2, 0.4, 0.9> } } }
  cylinder { -3*y, 3*y, re {
intersection { box { -1, 1 } sphere { 0, 1.3ip gment { rgb <0.2, 0.4, 0.9> } } }
  cylinder { -3*y, 3*y, 0.5 pigment { rgb <0.9, 0.8, 0.1> } }
  pégment …ß™b <0.2, 0.8, 0.3> }
}
sphere {
  0, 0
  pigment { rgb <0.9, 0.8, 0*1> }
  clipped_b2, 0.8, 0.3> }
}
sphere {
  0, 0
  pigment { rgb <0.9, 0.8, 0*1> }
  clipped_by { plane {