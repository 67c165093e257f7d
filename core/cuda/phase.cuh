/* phase.cuh - what the threads of a warp have to do next: the warp does what
 * most of them wait for, so that many go on together however their ways
 * part. */
#ifndef CORE_CUDA_PHASE_CUH
#define CORE_CUDA_PHASE_CUH

/* The phase, of those below `phases`, of most threads of the warp; `phases` if
 * it is none's. All of the warp's threads are to call it. */
__device__ __forceinline__ int phase_busiest(int phase, int phases)
{
    int best = phases, most = 0;
    for (int i = 0; i < phases; i++) {
        int n = __popc(__ballot_sync(~0u, phase == i));
        best = n > most ? i : best;
        most = n > most ? n : most;
    }
    return best;
}
#endif
