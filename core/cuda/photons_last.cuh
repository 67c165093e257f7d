/* photons_last.cuh - the kernel for the last photons, which live long.
 *
 * Few are left, and what counts is the time that a flight takes. Each is a
 * warp's, whose threads all do the same: it waits for no other, at no barrier.
 * What its flights leave is laid by another warp of the block. */
#include "core/cuda/photons_list.cuh"

namespace
{

/* Warps of a block that have a photon each, beside the one that lays; blocks
 * that a multiprocessor has room for. */
const int last_warps = 3, last_blocks = 3;
const int last_threads = (last_warps + 1) * warp_size;

/* So many are put into a ring before the other warp is told. */
const unsigned told_at_once = 8;

/* Counts of a ring of warp_size: what was told to be in it, what was taken. */
struct last_ring {
    unsigned told, taken;
};

/* What a warp's photons leave: not in memory that the block shares, where tools
 * that look for races know no order but that of barriers. */
struct last_memory {
    radiance_event event[warp_size];
    stretch laid[warp_size];
    last_ring events, stretches;
    unsigned ends;          /* no more will come                           */
};

const size_t last_bytes = last_blocks * last_warps * sizeof(last_memory);

/* A warp, and how much it put into its rings. */
struct last_warp {
    last_memory *memory;
    unsigned events, stretches;
};

__device__ __forceinline__ unsigned look_at(const unsigned *at)
{
    return __shfl_sync(~0u, *static_cast<const volatile unsigned *>(at), 0);
}

/* Tells the other warp a number, and with it all that was written before. */
__device__ __forceinline__ void tell(unsigned *at, unsigned value)
{
    __syncwarp();
    __threadfence_block();
    if (threadIdx.x % warp_size == 0)
        *static_cast<volatile unsigned *>(at) = value;
    __syncwarp();
}

/* The place of the next in a ring, once there is room for it. */
__device__ __forceinline__ unsigned ring_place(last_ring *r, unsigned put)
{
    if (put % told_at_once == 0) {
        tell(&r->told, put);
        while (put + told_at_once - look_at(&r->taken) >
               static_cast<unsigned>(warp_size))
            __nanosleep(100);
    }
    return put % warp_size;
}

/* Whether the ring has something at this thread's place; *told: all that was
 * told. */
__device__ __forceinline__ bool ring_has(const last_ring *r, unsigned *told)
{
    unsigned taken = look_at(&r->taken);
    *told = look_at(&r->told);
    __threadfence_block();
    return (threadIdx.x - taken) % warp_size < *told - taken;
}

/* Lays what waits of a warp. */
__device__ __forceinline__ void lay_last(const flat_scene *s, last_memory *m,
                                         photon_counters *count)
{
    unsigned told;
    radiance_walk w;
    if (ring_has(&m->stretches, &told)) {
        const stretch *x = &m->laid[threadIdx.x % warp_size];
        bool more = radiance_begin(s, x->o, x->d, x->from, x->to, &w);
        while (more)
            more = radiance_lay(s, &count->tally, &w, x->o, x->d, x->power);
    }
    tell(&m->stretches.taken, told);
    count->tally.waits = ring_has(&m->events, &told);
    store(s, m->event, count);
    tell(&m->events.taken, told);
}

/* Lays until the other warps of a block end. */
__device__ __forceinline__ void lay_lasts(const flat_scene *s, last_memory *m,
                                          photon_counters *count)
{
    unsigned ends;
    do {
        ends = 0;
        for (int i = 0; i < last_warps; i++) {
            ends += look_at(&m[i].ends);
            __threadfence_block();
            lay_last(s, &m[i], count);
        }
    } while (ends < static_cast<unsigned>(last_warps));
}

/* Puts a stretch that a flight has into the ring. */
__device__ __forceinline__ void leave_stretch(last_warp *w,
                                              const photon_state *p,
                                              photon_flight *f)
{
    if (!f->lays)
        return;
    last_memory *m = w->memory;
    m->laid[ring_place(&m->stretches, w->stretches)] = {
        p->path.o, p->path.d, f->stretch.t, f->stretch.end, f->lays_power};
    w->stretches++;
    f->lays = PHOTON_LAYS_NONE;
}

/* A flight, by the steps that photon_next tells. */
__device__ __forceinline__ void pass_last(const flat_scene *s, last_warp *w,
                                          photon_state *p,
                                          photon_counters *count,
                                          photon_flight *f)
{
    photon_take_off(s, p, count, f);
    do {
        if (f->seeks == PHOTON_SEEKS)
            photon_seek(s, p, f);
        if (f->departs)
            photon_depart(s, p, count, f);
        else if (f->collides)
            photon_collide(s, p, count, f);
        else
            photon_track(s, p, count, f);
        leave_stretch(w, p, f);
    } while (f->flies);
}

/* What follows it. False: the photon has ended. */
__device__ __forceinline__ bool land_last(const flat_scene *s, last_warp *w,
                                          photon_state *p,
                                          photon_counters *count,
                                          const photon_flight *f)
{
    last_memory *m = w->memory;
    if (scene_may(MAY_BALLS) && s->field.ball)
        count->tally.later = &m->event[ring_place(&m->events, w->events)];
    count->tally.waits = 0;
    bool alive = photon_land(s, p, count, f);
    w->events += static_cast<unsigned>(count->tally.waits);
    return alive;
}

/* Follows photons of the list, one after the other, to their ends. */
__device__ __forceinline__ void follow_list(const trace_job *job,
                                            last_memory *m,
                                            photon_counters *count)
{
    const flat_scene *s = &job->scene;
    bool first = threadIdx.x % warp_size == 0;
    unsigned left = job->queue->left[!job->turn];
    last_warp w = {m, 0, 0};
    for (;;) {
        unsigned i = take_numbers(&job->queue->followed, first);
        i = __shfl_sync(~0u, i, 0);
        if (i >= left)
            break;
        photon_state p = get_photon(job, !job->turn, i);
        photon_flight f;
        p.path.count = &count->track;
        p.path.boost = 1.0f;
        f.event = PATH_THROUGH;
        do
            pass_last(s, &w, &p, count, &f);
        while (land_last(s, &w, &p, count, &f));
    }
    tell(&m->stretches.told, w.stretches);
    tell(&m->events.told, w.events);
    tell(&m->ends, 1);
}

__global__ void __launch_bounds__(last_threads, last_blocks)
follow_photons(const __grid_constant__ trace_job job)
{
    last_memory *memory = static_cast<last_memory *>(job.rings) +
                          blockIdx.x * last_warps;
    int warp = threadIdx.x / warp_size;
    photon_counters count = {};
    count.tally.sum = job.sum;
    if (threadIdx.x < last_warps) {
        last_memory *m = &memory[threadIdx.x];
        m->events = m->stretches = {0, 0};
        m->ends = 0;
    }
    __syncthreads();
    if (warp == last_warps)
        lay_lasts(&job.scene, memory, &count);
    else
        follow_list(&job, &memory[warp], &count);
    if (warp < last_warps && threadIdx.x % warp_size != 0)
        count = {};     /* as the first thread's: once is enough */
    write_counts(&job, &count);
}

}
