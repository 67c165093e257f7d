/* Any scene. */
#define SCENE_MAY MAY_ALL
#define SAMPLE_STAGE sample_all
#define LINES_STAGE lines_all
#include "core/cuda/lines_kernel.cuh"
#include "core/cuda/sample_kernel.cuh"
