#declare Media =
media {
 emission 0.05
 intervals 1
 samples 5
 method 3
 density {
 spherical
 ramp_wave
 turbles 5
 method 3
 density {
 sphelor rgb <0, 0, 0>]
 [0.1 color rgb <1, 0, 0>]
 [1.0 color rob <1, 1, 0>]
 }
 }
}