/* lone_kernel.cuh - the kernel that traces photons of one gray medium in one
 * container. LONE_STAGE names what is defined here; SCENE_MAY tells whether
 * power has colours.
 *
 * Each warp goes by itself. A thread's photon is at one of few steps, and
 * threads of a warp take the same one together where they can. Few wait for
 * others where what they need is long and seldom: a new photon, or a flight's
 * end. Cells are laid while many have some, and the others go on in between. */
#include "core/cuda/count.cuh"
#include "core/cuda/lone.cuh"
#include "core/physics/photon_lone.h"

namespace
{

/* A block's threads, and blocks that a multiprocessor has room for. */
const int lone_threads = 128, lone_blocks = 5;

/* Threads of a warp for which photons are taken and ends are sought, and for
 * which a cell more is laid. */
const int serve_threads = 8, lay_threads = 8;

/* Beside LONE_*: a photon is to be taken. */
enum { LONE_TAKES = LONE_ENDS + 1, LONE_WAITS };

/* A thread's photon, and where it is. */
struct lone_tracer {
    lone_photon photon;
    radiance_walk lays;
    int next;
    bool lays_on;           /* cells are left of its flight                */
};

__device__ __forceinline__ int threads_where(bool here)
{
    return __popc(__ballot_sync(~0u, here));
}

__device__ __forceinline__ lone_photon *lone_list(const trace_job *job,
                                                  int turn)
{
    return static_cast<lone_photon *>(job->list[turn]);
}

/* Gives threads without one the next photons of the list. */
__device__ __forceinline__ void lone_take(const trace_job *job, lone_tracer *t)
{
    bool idle = t->next == LONE_TAKES;
    unsigned i = take_numbers(&job->queue->taken, idle);
    if (idle && i >= job->queue->left[job->turn]) {
        t->next = LONE_WAITS;
    } else if (idle) {
        t->photon = lone_list(job, job->turn)[i];
        t->next = LONE_FLIES;
    }
}

/* Leaves photons at the beginning of a flight to the next launch. */
__device__ __forceinline__ void lone_leave(const trace_job *job,
                                           lone_tracer *t)
{
    bool leaves = t->next == LONE_FLIES;
    unsigned i = take_numbers(&job->queue->left[!job->turn], leaves);
    if (leaves) {
        lone_list(job, !job->turn)[i] = t->photon;
        t->next = LONE_WAITS;
    }
}

/* What few threads wait for. */
__device__ __forceinline__ void lone_serve(const trace_job *job,
                                           lone_tracer *t,
                                           track_counters *count)
{
    bool waits = t->next == LONE_TAKES || t->next == LONE_SEEKS;
    bool busy = !waits && t->next != LONE_WAITS;
    unsigned all = __ballot_sync(~0u, busy);
    if (threads_where(waits) >= serve_threads || all == 0u) {
        if (t->next == LONE_SEEKS) {
            lone_seek(&job->scene, &job->lone, &t->photon);
            t->next = lone_step(&job->lone, &t->photon, count);
        }
        lone_take(job, t);
    }
    if (!job->last && __any_sync(~0u, t->next == LONE_WAITS))
        lone_leave(job, t);
}

/* Cells of what has been flown. */
__device__ __forceinline__ void lay_cells(const trace_job *job, lone_tracer *t,
                                         radiance_tally *tally)
{
    if (t->next == LONE_LAYS && !t->lays_on) {
        t->lays_on = lone_lays(&job->scene, &job->lone, &t->photon, tally,
                               &t->lays);
        t->next = t->lays_on ? LONE_LAYS : LONE_LANDS;
    }
    for (;;) {
        int n = threads_where(t->lays_on);
        unsigned others = __ballot_sync(~0u, t->next == LONE_LANDS);
        if (n == 0 || (n < lay_threads && others != 0u))
            return;
        if (t->lays_on) {
            t->lays_on = lone_lay(&job->scene, &job->lone, tally, &t->lays,
                                  &t->photon);
            t->next = t->lays_on ? LONE_LAYS : LONE_LANDS;
        }
    }
}

__device__ __forceinline__ void lone_write(const trace_job *job,
                                           const photon_counters *c,
                                           const track_counters *count)
{
    photon_totals *total = job->total;
    count_warp(&total->track.rays, count->rays);
    count_warp(&total->track.lookups, count->lookups);
    count_warp(&total->track.majorant_exceeded, count->majorant_exceeded);
    count_warp(&total->events, c->events);
    count_warp(&total->clipped, c->tally.clipped);
    count_books(total, c);
}

__global__ void __launch_bounds__(lone_threads, lone_blocks)
trace_lone(const __grid_constant__ trace_job job)
{
    __shared__ photon_counters counters[lone_threads];
    photon_counters *c = &counters[threadIdx.x];
    track_counters count = {};
    radiance_tally tally = {};
    lone_tracer t;
    *c = {};
    tally.sum = job.sum;
    t.next = LONE_TAKES;
    t.lays_on = false;
    while (__any_sync(~0u, t.next != LONE_WAITS)) {
        lone_serve(&job, &t, &count);
        if (t.next == LONE_FLIES)
            t.next = lone_fly(&job.lone, &t.photon, &count);
        lay_cells(&job, &t, &tally);
        if (t.next == LONE_LANDS)
            t.next = lone_land(&job.scene, &job.lone, &t.photon, c, &count);
        if (t.next == LONE_ENDS)
            t.next = LONE_TAKES;
    }
    c->tally.clipped = tally.clipped;
    lone_write(&job, c, &count);
}

cudaError_t trace(const trace_job *job, unsigned blocks, int threads)
{
    trace_lone<<<blocks, threads>>>(*job);
    return cudaGetLastError();
}

}

const photon_stage LONE_STAGE = {
    SCENE_MAY, sizeof(lone_photon), 0, lone_threads, lone_blocks,
    lone_bear, trace, nullptr, nullptr};
