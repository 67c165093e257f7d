// Fog that thins with height, and a knot that rises out of it, 640x480: table
// 1 of Cha, Yi, Ihm 2010. Declare=Geometry=0 leaves the knot out,
// Declare=Medium=0 the fog.
#include "bench.inc"
#ifndef (Geometry) #declare Geometry = 1; #end
#ifndef (Medium) #declare Medium = 1; #end

#declare Side = 2 / 128;
Look(2, 25)

#if (Medium)
    Container(<128, 128, 128>, Side, Cloudy("t1-fog.vdb", 5, 0.9))
#end
#if (Geometry)
    mesh {
        ply "t1-fog-knot.ply"
        pigment { rgb <0.4, 0.55, 0.7> }
        finish { diffuse 1 ambient 0 }
    }
#end
