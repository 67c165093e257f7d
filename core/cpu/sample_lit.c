/* One medium of grids among simple surfaces and meshes, with lamps, a sky and
 * a field of photons. */
#define SCENE_MAY                                                              \
    (MAY_MESHES | MAY_SURFACES | MAY_EMISSION | MAY_SKY | MAY_LAMPS |          \
     MAY_CLEAR | MAY_FIELD | MAY_COLORS | MAY_BALLS | MAY_SINGLE)
#define CPU_STAGE cpu_lit
#include "core/cpu/sample_kernel.h"
