/* Any scene. */
#define SCENE_MAY MAY_ALL
#define SAMPLE_STAGE sample_all
#include "core/cuda/sample_kernel.cuh"
