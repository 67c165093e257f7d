/* photons_kernel.cuh - the kernels of the integrator photon. PHOTON_STAGE names
 * what is defined here, SCENE_MAY what it can do.
 *
 * A warp takes a chunk of photons and its threads take them in turn. What a
 * thread has to do next is its phase; the warp does what most of them wait for.
 * Who takes which photon does not depend on time, so that the books come out
 * the same from run to run; the sums of cells are whole numbers. */
#include "core/cuda/count.cuh"
#include "core/cuda/phase.cuh"
#include "core/cuda/photons.cuh"
#include "core/physics/lit_cell.h"

namespace
{

const int warp_size = 32;
/* Warps that a multiprocessor must have room for: 128 registers a thread. */
const int warps_at_once = 16;
enum phase {
    PHASE_BIRTH,
    PHASE_TAKE_OFF,
    PHASE_TRACK,
    PHASE_LAY,
    PHASE_LAND,
    PHASES                  /* no photon is left                           */
};

struct tracer {
    photon_state photon;
    photon_flight flight;
    int phase;
};

/* Gives threads that wait for one the next photons; *next is the same in all
 * threads of the warp. */
__device__ __forceinline__ void take_photons(const trace_job *job, tracer *t,
                                             photon_counters *count,
                                             uint64_t *next, uint64_t end)
{
    bool idle = t->phase == PHASE_BIRTH;
    unsigned all = __ballot_sync(~0u, idle);
    uint64_t mine = *next + __popc(all & ((1u << threadIdx.x) - 1u));
    *next += __popc(all);
    *next = *next < end ? *next : end;
    if (idle && mine >= end)
        t->phase = PHASES;
    else if (idle && photon_begin(&job->scene, &job->photons, mine, &t->photon,
                                  count))
        t->phase = PHASE_TAKE_OFF;
}

__device__ __forceinline__ int flight_phase(const photon_flight *f)
{
    return f->lays ? PHASE_LAY : f->flies ? PHASE_TRACK : PHASE_LAND;
}

/* Does what the threads of that phase wait for. */
__device__ __forceinline__ void go_on(const trace_job *job, tracer *t,
                                      photon_counters *count, int phase)
{
    const flat_scene *s = &job->scene;
    if (t->phase != phase)
        return;
    if (phase == PHASE_LAND) {
        bool alive = photon_land(s, &t->photon, count, &t->flight);
        t->phase = alive ? PHASE_TAKE_OFF : PHASE_BIRTH;
        return;
    }
    if (phase == PHASE_TAKE_OFF)
        photon_take_off(s, &t->photon, count, &t->flight);
    else if (phase == PHASE_TRACK)
        photon_track(s, &t->photon, count, &t->flight);
    else
        photon_lay(s, &t->photon, count, &t->flight);
    t->phase = flight_phase(&t->flight);
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
    photon_books *books = &job->books[blockIdx.x];
#define X(name) count_book(&books->name, c->books.name);
    PHOTON_BOOKS(X)
#undef X
}

__global__ void __launch_bounds__(warp_size, warps_at_once)
trace_photons(const __grid_constant__ trace_job job)
{
    uint64_t next = job.first + blockIdx.x * job.chunk;
    uint64_t end = next + job.chunk < job.last ? next + job.chunk : job.last;
    photon_counters count = {};
    tracer t;
    int phase;
    count.tally.sum = job.sum;
    t.phase = PHASE_BIRTH;
    while ((phase = phase_busiest(t.phase, PHASES)) != PHASES)
        if (phase == PHASE_BIRTH)
            take_photons(&job, &t, &count, &next, end);
        else
            go_on(&job, &t, &count, phase);
    write_counts(&job, &count);
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

const photon_stage PHOTON_STAGE = {SCENE_MAY, trace, balls, light};
