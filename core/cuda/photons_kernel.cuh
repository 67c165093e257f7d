/* photons_kernel.cuh - the kernels of the integrator photon. PHOTON_STAGE names
 * what is defined here, SCENE_MAY what it can do.
 *
 * Photons are born by a kernel of its own, and wait in a list. Warps that stay
 * take them from there: what a thread has to do next is its phase, and the warp
 * does what most of its threads wait for. Who takes which photon depends on
 * time; all sums are of whole numbers, so that none shows it. */
#include "core/cuda/count.cuh"
#include "core/cuda/phase.cuh"
#include "core/cuda/photons.cuh"
#include "core/physics/lit_cell.h"

namespace
{

/* Warps that a multiprocessor must have room for: 128 registers a thread. */
const int warps_at_once = 16;
const int births_at_once = 128;
enum phase {
    PHASE_EVENT,            /* at a flight's end, or without a photon      */
    PHASE_TRACK,
    PHASE_LAY,
    PHASES                  /* no photon is left                           */
};

struct tracer {
    photon_state photon;
    photon_flight flight;
    bool alive;
    int phase;
};

__device__ __forceinline__ int flight_phase(const photon_flight *f)
{
    return f->lays ? PHASE_LAY : f->flies ? PHASE_TRACK : PHASE_EVENT;
}

/* Gives threads that wait for one the next photons of the list. All threads
 * of the warp are here. */
__device__ __forceinline__ void take_photons(const trace_job *job, tracer *t,
                                             photon_counters *count)
{
    bool idle = t->phase == PHASE_EVENT && !t->alive;
    unsigned all = __ballot_sync(~0u, idle);
    unsigned first = 0;
    if (all == 0u)
        return;
    if (threadIdx.x == 0)
        first = atomicAdd(job->taken, __popc(all));
    first = __shfl_sync(~0u, first, 0) +
            __popc(all & ((1u << threadIdx.x) - 1u));
    if (!idle)
        return;
    if (first >= job->born) {
        t->phase = PHASES;
        return;
    }
    t->photon = static_cast<const photon_state *>(job->list)[first];
    t->photon.path.count = &count->track;
    t->alive = !rgb_is_black(t->photon.path.beta);
}

/* What follows a flight, and the next one. */
__device__ __forceinline__ void go_on(const trace_job *job, tracer *t,
                                      photon_counters *count)
{
    const flat_scene *s = &job->scene;
    if (t->phase == PHASE_EVENT && t->alive)
        t->alive = photon_land(s, &t->photon, count, &t->flight);
    take_photons(job, t, count);
    if (t->phase == PHASE_EVENT && t->alive) {
        photon_take_off(s, &t->photon, count, &t->flight);
        t->phase = flight_phase(&t->flight);
    }
}

__device__ __forceinline__ void write_counts(const trace_job *job,
                                             const photon_counters *c)
{
    photon_totals *total = job->total;
    count_add(&total->track, &c->track);
    count_warp(&total->photons, c->photons);
    count_warp(&total->events, c->events);
    count_warp(&total->bounces, c->bounces);
    count_warp(&total->stored, c->stored);
    count_warp(&total->clipped, c->tally.clipped);
#define X(name) count_warp(&total->name, static_cast<uint64_t>(c->books.name));
    PHOTON_BOOKS(X)
#undef X
}

__global__ void __launch_bounds__(births_at_once)
bear_photons(const __grid_constant__ trace_job job)
{
    unsigned i = blockIdx.x * births_at_once + threadIdx.x;
    photon_counters count = {};
    count.tally.sum = job.sum;
    if (i == 0)
        *job.taken = 0;
    if (i < job.born) {
        photon_state p;
        if (!photon_begin(&job.scene, &job.photons, job.first + i, &p, &count))
            p.path.beta = rgb_gray(0.0f);
        static_cast<photon_state *>(job.list)[i] = p;
    }
    write_counts(&job, &count);
}

__global__ void __launch_bounds__(warp_size, warps_at_once)
trace_photons(const __grid_constant__ trace_job job)
{
    __shared__ photon_counters counts[warp_size];
    photon_counters *count = &counts[threadIdx.x];
    tracer t;
    int phase;
    *count = {};
    count->tally.sum = job.sum;
    t.phase = PHASE_EVENT;
    t.alive = false;
    while ((phase = phase_busiest(t.phase, PHASES)) != PHASES) {
        if (phase == PHASE_EVENT) {
            go_on(&job, &t, count);
        } else if (t.phase == phase) {
            if (phase == PHASE_LAY)
                photon_lay(&job.scene, &t.photon, count, &t.flight);
            else
                photon_track(&job.scene, &t.photon, count, &t.flight);
            t.phase = flight_phase(&t.flight);
        }
    }
    write_counts(&job, count);
}

const int cells_at_once = 128; /* of a brick of 512, in one block */

/* The brick and the number in it of a thread's cell; false: it is not there. */
__device__ __forceinline__ bool find_cell(const cell_job *job, uint64_t *brick,
                                          int *cell)
{
    const int blocks = 512 / cells_at_once;
    *brick = blockIdx.x / blocks;
    *cell = static_cast<int>(blockIdx.x % blocks * cells_at_once + threadIdx.x);
    return job->scene.radiance_slots[*brick] >= 0;
}

__global__ void __launch_bounds__(cells_at_once, 4)
ball_cells(const __grid_constant__ cell_job job)
{
    uint64_t brick;
    int cell;
    if (find_cell(&job, &brick, &cell))
        ball_cell_run(&job.scene, brick, cell, job.cells);
}

__global__ void __launch_bounds__(cells_at_once, 4)
light_cells(const __grid_constant__ cell_job job)
{
    uint64_t brick;
    int cell;
    track_counters count = {};
    if (find_cell(&job, &brick, &cell))
        lit_cell_run(&job.scene, job.seed, job.frame, brick, cell, job.cells,
                     &count);
}

unsigned cell_blocks(const cell_job *job)
{
    return static_cast<unsigned>(job->scene.radiance_slots_count) *
           (512 / cells_at_once);
}

void bear(const trace_job *job)
{
    bear_photons<<<(job->born + births_at_once - 1) / births_at_once,
                   births_at_once>>>(*job);
}

void trace(const trace_job *job, unsigned warps)
{
    trace_photons<<<warps, warp_size>>>(*job);
}

void balls(const cell_job *job)
{
    ball_cells<<<cell_blocks(job), cells_at_once>>>(*job);
}

void light(const cell_job *job)
{
    light_cells<<<cell_blocks(job), cells_at_once>>>(*job);
}

}

const photon_stage PHOTON_STAGE = {SCENE_MAY, sizeof(photon_state), bear,
                                   trace, balls, light};
