sky_sphere
{
 pigment
 {
 average
 pigmeplymap
 {
 [ gradient y 
 color_map { [0.0 color blue 0.2] [1.0 color rgb 1] } ]
 sky_sphere
{ color_map { [0.0 color blue 0.2] [1.0 color rgb 1] } ]
 [ bozo turbulence 0.7 scale <0.5q.d8)_b,0.]
 }
 }
}