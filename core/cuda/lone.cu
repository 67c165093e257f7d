/* Births of photons of one gray medium in one container. */
#define SCENE_MAY (MAY_EMISSION | MAY_SKY | MAY_LAMPS | MAY_FIELD | MAY_TINTS)
#define HD_INLINE __forceinline__
#include "core/cuda/count.cuh"
#include "core/cuda/lone.cuh"

namespace
{

const int births_at_once = 128;

/* Two for each place that a large GPU has for them. */
const unsigned most_blocks = 1024;

__device__ __forceinline__ void write_counts(const trace_job *job,
                                             const photon_counters *c)
{
    photon_totals *total = job->total;
    count_add(&total->track, &c->track);
    count_warp(&total->photons, c->photons);
    count_warp(&total->clipped, c->tally.clipped);
    count_books(total, &c->books);
}

/* Those that come to the container wait in the list, in any order. */
__device__ __forceinline__ void bear_one(const trace_job *job, unsigned i,
                                         photon_counters *count)
{
    lone_born p;
    bool alive = i < job->born &&
                 lone_begin(&job->scene, &job->lone, &job->photons,
                            job->first + i, &p.photon, &p.rest, count);
    unsigned at = take_numbers(&job->queue->left[job->turn], alive);
    if (alive)
        static_cast<lone_born *>(job->list[job->turn])[at] = p;
}

/* A thread bears several, one after the other: what is counted of them is added
 * up once. */
__global__ void __launch_bounds__(births_at_once)
    bear_lone(const __grid_constant__ trace_job job)
{
    photon_counters count = {};
    count.tally.sum = job.sum;
    if (blockIdx.x == 0 && threadIdx.x == 0)
        job.queue->taken = job.queue->left[!job.turn] = 0;
    for (unsigned i = blockIdx.x * births_at_once; i < job.born;
         i += gridDim.x * births_at_once)
        bear_one(&job, i + threadIdx.x, &count);
    write_counts(&job, &count);
}

}

void lone_bear(const trace_job *job)
{
    unsigned blocks = (job->born + births_at_once - 1) / births_at_once;
    blocks = blocks > most_blocks ? most_blocks : blocks > 0 ? blocks : 1;
    bear_lone<<<blocks, births_at_once>>>(*job);
}
