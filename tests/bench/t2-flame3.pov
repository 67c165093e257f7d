// A flame on a coarse grid, 640x480: table 2 of Cha, Yi, Ihm 2010.
#include "bench.inc"
Look(0.64, 0)
Container(<60, 60, 60>, 0.64 / 60,
          Burning("t2-flame3.vdb", 20, 0.2, 800, 2200, 2000))
