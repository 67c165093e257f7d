/* All scenes. */
#define CPU_STAGE cpu_all
#include "core/cpu/sample_kernel.h"
