// Flames of a campfire, 512x512: table 2 of Cha, Yi, Ihm 2010.
#include "bench.inc"
Look(1.15, 0)
Container(<70, 70, 80>, 1.15 / 70,
          Burning("t2-campfire.vdb", 20, 0.2, 800, 2200, 2000))
