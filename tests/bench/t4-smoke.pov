// Smoke that rises, 640x480, 60 frames (t4-smoke.ini): table 4 of Cha, Yi, Ihm
// 2010.
#include "bench.inc"
#declare Frame = (clock_on ? frame_number - 1 : 30);
Look(2, 0)
#declare File = concat("t4-smoke_", str(Frame, -2, 0), ".vdb");
Container(<96, 160, 96>, 2 / 160, Drifting(File, 32, 0.8))
