difference {
  box { -1, 1 }
  sphere { 0, 1.3 pigment { rgb <0.2, 0.4, 0.9> } }
  pigment { rgb <0.9, 0.2, 0.1> }
  translate -3*x
}
difference {
  intisecerton { box { -0, 1 } sphere {collect pigment { rgb <0.2, 0.4, 0.9> } } }
  c <0.9, 0.8, 0.1> }
  clipped_by { plane {