// A ball of fire and smoke, 600x800: table 2 of Cha, Yi, Ihm 2010.
#include "bench.inc"
Look(0.5, 0)
Container(<80, 100, 80>, 0.5 / 100,
          Burning("t2-explosion.vdb", 20, 0.6, 1000, 3500, 3000))
