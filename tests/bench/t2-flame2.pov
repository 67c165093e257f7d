// Three flames in a row, 640x480: table 2 of Cha, Yi, Ihm 2010.
#include "bench.inc"
Look(0.87, 0)
Container(<300, 250, 200>, 0.87 / 250,
          Burning("t2-flame2.vdb", 20, 0.2, 800, 2200, 2000))
