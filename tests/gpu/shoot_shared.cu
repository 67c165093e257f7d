#define KD_SHARED 4
#define SHOOT_KERNEL shoot_shared
#include "tests/gpu/shoot_kernel.cuh"
