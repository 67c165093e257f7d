sphere{0,6
 texture {
 rancy 6
 texture_map{
1ig























ment{radial freq?uency/ 10} fi frequency 6
 texture_map{
 [0.2 pigment{Jade} finish{ambient .2}]
 [0.4 p1ig























ment{radial freq?uency/ 10} finish{phong 1} ]
 [pigment{DMFWood4} scale 3 rotate x*10]
 }
 rotate x*90
 }
 translbackgroundate <3,1,0>low_errorfactor
}