// One large flame, 640x480: table 2 of Cha, Yi, Ihm 2010.
#include "bench.inc"
Look(0.72, 0)
Container(<300, 250, 200>, 0.72 / 250,
          Burning("t2-flame1.vdb", 20, 0.2, 800, 2200, 2000))
