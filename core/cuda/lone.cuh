/* lone.cuh - the trace stage where one gray medium in one container is all
 * there is (photon_lone.h): what its kernels share. Each lone_NAME.cu is the
 * same kernel for other light. */
#ifndef CORE_CUDA_LONE_CUH
#define CORE_CUDA_LONE_CUH
#include "core/cuda/photons.cuh"
#include "core/physics/lone_lay.h"

/* A photon as it waits in a list: four words at a time go there. */
struct HD_ALIGNED(16) lone_born {
    lone_photon photon;
    lone_rest rest;
};

/* Photons of a job are born, and come to the container or end before. */
void lone_bear(const trace_job *job);

/* For light of any colours; without MAY_TINTS. */
extern const photon_stage lone_tints, lone_gray;

#endif
