/* Simple surfaces and media that are functions or even, one at a place, under
 * any lights. */
#define SCENE_MAY                                                              \
    (MAY_FUNCTIONS | MAY_SURFACES | MAY_EMISSION | MAY_LAMPS | MAY_CLEAR |     \
     MAY_COLORS | MAY_SINGLE)
#define CPU_STAGE cpu_plain
#include "core/cpu/sample_kernel.h"
