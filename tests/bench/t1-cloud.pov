// A cumulus with a knot in it, 640x480: table 1 of Cha, Yi, Ihm 2010.
// Declare=Geometry=0 leaves the knot out, Declare=Medium=0 the cloud.
#include "bench.inc"
#ifndef (Geometry) #declare Geometry = 1; #end
#ifndef (Medium) #declare Medium = 1; #end

#declare Side = 1.15 / 128;
Look(1.15, 0)

#if (Medium)
    Container(<128, 128, 128>, Side, Cloudy("t1-cloud.vdb", 60, 0.999))
#end
#if (Geometry)
    mesh {
        ply "t1-cloud-knot.ply"
        rotate -50 * x
        translate -0.08 * y
        pigment { rgb <0.75, 0.45, 0.3> }
        finish { diffuse 1 ambient 0 }
    }
#end
