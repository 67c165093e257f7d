/* photons_kernel.cuh - the kernels of the integrator photon. PHOTON_STAGE names
 * what is defined here, SCENE_MAY what it can do.
 *
 * Photons are born by a kernel of its own, and wait in a list, from which
 * threads that stay take them. All threads of a multiprocessor go round
 * together, from the end of a flight through the next one: so each instruction
 * that is fetched is used by many. Long ways are cut short where few threads
 * are left on them, which go on in the next round. As some photons live a
 * thousand times as long as most, they are left to the next launch where the
 * list ends, and those of the last launch to a kernel for few photons. Who
 * takes which photon depends on time; all sums are of whole numbers, so that
 * none shows it. */
#include "core/cuda/photons_last.cuh"
#include "core/physics/lit_cell.h"

namespace
{

const int births_at_once = 128;

/* Blocks of births that a multiprocessor must have room for: 168 registers a
 * thread. */
const int blocks_of_births = 3;

/* Steps of a flight in a round, at most; threads of a warp for which one more
 * is made, for which surfaces are sought, and for which a cell more is laid. */
const int most_steps = 16, step_threads = 4;
const int seek_threads = 4, lay_threads = 24;

/* So few of a warp wait for each other no more; so few of a block are left to
 * others. */
const int few_of_warp = 8, few_of_block = 32;

/* What is next of a thread's photon, beside photon_next: to get one, and that
 * there is none left. */
enum { TRACER_TAKES = PHOTON_LAYS + 1, TRACER_ENDS };

struct tracer {
    photon_state photon;
    photon_flight flight;
    int next;
};

/* Of stretches, which wait in a ring that a warp's threads share: each lays one
 * after the other, whosever photon it was. */
const int ring_size = 2 * warp_size;

struct warp_memory {
    photon_counters count[warp_size];
    radiance_event event[warp_size];    /* that wait, see store            */
    stretch ring[ring_size];
    stretch laid[warp_size];    /* of each thread                          */
};

struct layer {
    radiance_walk walk;
    bool busy;
    int first, count;       /* of the ring; alike in all threads           */
};

/* Gives threads that wait for one the next photons of the list. */
__device__ __forceinline__ void take_photons(const trace_job *job, tracer *t,
                                             photon_counters *count)
{
    bool idle = t->next == TRACER_TAKES;
    unsigned i = take_numbers(&job->queue->taken, idle);
    if (idle && i >= job->queue->left[job->turn] + job->born) {
        t->next = TRACER_ENDS;
    } else if (idle) {
        t->photon = get_photon(job, job->turn, i);
        t->photon.path.count = &count->track;
        t->photon.path.boost = 1.0f;
        t->flight.event = PATH_THROUGH;
        if (!rgb_is_black(t->photon.path.beta))
            t->next = PHOTON_LANDS;
    }
}

/* Leaves photons between two flights to others. */
__device__ __forceinline__ void leave_photons(const trace_job *job, tracer *t)
{
    bool leaves = t->next == PHOTON_LANDS;
    unsigned i = take_numbers(&job->queue->left[!job->turn], leaves);
    if (leaves) {
        put_photon(job, !job->turn, i, &t->photon);
        t->next = TRACER_ENDS;
    }
}

/* What follows a flight, and the next one. */
__device__ __forceinline__ void land(const trace_job *job, tracer *t,
                                     const radiance_event *event,
                                     photon_counters *count, bool few)
{
    const flat_scene *s = &job->scene;
    if (t->next == PHOTON_LANDS &&
        !photon_land(s, &t->photon, count, &t->flight))
        t->next = TRACER_TAKES;
    store(s, event, count);
    take_photons(job, t, count);
    if (few || (!job->last && __any_sync(~0u, t->next == TRACER_ENDS)))
        leave_photons(job, t);
    if (t->next == PHOTON_LANDS) {
        photon_take_off(s, &t->photon, count, &t->flight);
        t->next = photon_next(&t->flight);
    }
}

/* Few threads wait for others, unless all of them do. */
__device__ __forceinline__ void seek(const trace_job *job, tracer *t)
{
    bool on = t->next == PHOTON_LOOKS;
    unsigned rest = __ballot_sync(~0u, !on && t->next != TRACER_ENDS);
    if (__popc(__ballot_sync(~0u, on)) < seek_threads && rest != 0u)
        return;
    if (on) {
        photon_seek(&job->scene, &t->photon, &t->flight);
        t->next = photon_next(&t->flight);
    }
}

/* Whether few of a warp's photons are left. */
__device__ __forceinline__ bool hurries(const tracer *t)
{
    return __popc(__ballot_sync(~0u, t->next != TRACER_ENDS)) <= few_of_warp;
}

__device__ __forceinline__ bool goes_on(const tracer *t, int what, int step)
{
    unsigned on = __ballot_sync(~0u, t->next == what);
    return __popc(on) >= (step == 0 || hurries(t) ? 1 : step_threads);
}

__device__ __forceinline__ void track(const trace_job *job, tracer *t,
                                      photon_counters *count)
{
    for (int i = 0; i < most_steps && goes_on(t, PHOTON_TRACKS, i); i++)
        if (t->next == PHOTON_TRACKS) {
            photon_track(&job->scene, &t->photon, count, &t->flight);
            t->next = photon_next(&t->flight);
        }
}

__device__ __forceinline__ void collide(const trace_job *job, tracer *t,
                                        photon_counters *count)
{
    if (t->next == PHOTON_COLLIDES) {
        photon_collide(&job->scene, &t->photon, count, &t->flight);
        t->next = photon_next(&t->flight);
    }
}

/* From tentative collision to tentative collision. */
__device__ __forceinline__ void fly(const trace_job *job, tracer *t,
                                    photon_counters *count)
{
    do {
        track(job, t, count);
        collide(job, t, count);
    } while (hurries(t) && __any_sync(~0u, t->next == PHOTON_TRACKS));
}

/* Puts a stretch that a thread has into the ring, in which is room. */
__device__ __forceinline__ void put_stretches(warp_memory *m, layer *l,
                                              tracer *t)
{
    bool has = t->next == PHOTON_LAYS;
    unsigned all = __ballot_sync(~0u, has);
    int i = l->first + l->count +
            __popc(all & ((1u << threadIdx.x % warp_size) - 1u));
    l->count += __popc(all);
    if (has) {
        const photon_flight *f = &t->flight;
        m->ring[i % ring_size] = {t->photon.path.o, t->photon.path.d,
                                  f->stretch.t, f->stretch.end, f->lays_power};
        t->flight.lays = PHOTON_LAYS_NONE;
        t->next = photon_next(&t->flight);
    }
    __syncwarp();
}

/* Gives threads that lay nothing the next stretches. */
__device__ __forceinline__ void get_stretches(const flat_scene *s,
                                              warp_memory *m, layer *l)
{
    int lane = threadIdx.x % warp_size;
    unsigned idle = __ballot_sync(~0u, !l->busy);
    int i = __popc(idle & ((1u << lane) - 1u)), n = __popc(idle);
    if (!l->busy && i < l->count) {
        stretch x = m->ring[(l->first + i) % ring_size];
        m->laid[lane] = x;
        l->busy = radiance_begin(s, x.o, x.d, x.from, x.to, &l->walk);
    }
    n = n < l->count ? n : l->count;
    l->first = (l->first + n) % ring_size;
    l->count -= n;
    __syncwarp();
}

/* Lays cells while there is work for that many threads. What is left waits, so
 * that stretches are begun by many threads together, too; there is room for
 * one of each thread then. */
__device__ __forceinline__ void lay(const flat_scene *s, warp_memory *m,
                                    layer *l, photon_counters *count,
                                    int threads)
{
    const stretch *x = &m->laid[threadIdx.x % warp_size];
    for (;;) {
        int busy = __popc(__ballot_sync(~0u, l->busy));
        if (busy + l->count < threads)
            return;
        if (busy < lay_threads && l->count > 0)
            get_stretches(s, m, l);
        if (l->busy)
            l->busy = radiance_lay(s, &count->tally, &l->walk, x->o, x->d,
                                   x->power);
    }
}

__global__ void __launch_bounds__(births_at_once, blocks_of_births)
bear_photons(const __grid_constant__ trace_job job)
{
    unsigned i = blockIdx.x * births_at_once + threadIdx.x;
    __shared__ radiance_event event[births_at_once];
    photon_counters count = {};
    count.tally.sum = job.sum;
    count.tally.later = &event[threadIdx.x];
    if (i == 0)
        job.queue->taken = job.queue->followed = job.queue->left[!job.turn] =
            0;
    if (i < job.born) {
        photon_state p;
        if (!photon_begin(&job.scene, &job.photons, job.first + i, &p, &count))
            p.path.beta = rgb_gray(0.0f);
        put_photon(&job, job.turn, job.queue->left[job.turn] + i, &p);
    }
    store(&job.scene, event + threadIdx.x / warp_size * warp_size, &count);
    write_counts(&job, &count);
}

/* A block goes round until no photon is left to it, and once more to lay what
 * waits; if few are left, it leaves them. They are counted at the end of a
 * round: ptxas takes a minute longer, for sm_75, over a loop that begins with
 * the count. */
__global__ void __launch_bounds__(most_trace_threads, 1)
trace_photons(const __grid_constant__ trace_job job)
{
    extern __shared__ warp_memory memory[];
    warp_memory *m = &memory[threadIdx.x / warp_size];
    photon_counters *count = &m->count[threadIdx.x % warp_size];
    const flat_scene *s = &job.scene;
    tracer t;
    layer l;
    *count = {};
    count->tally.sum = job.sum;
    count->tally.later = &m->event[threadIdx.x % warp_size];
    t.next = TRACER_TAKES;
    l.busy = false;
    l.first = l.count = 0;
    int left = most_trace_threads;
    bool ends;
    do {
        ends = left == 0;
        land(&job, &t, m->event, count, left <= few_of_block);
        seek(&job, &t);
        if (t.next == PHOTON_DEPARTS) {
            photon_depart(s, &t.photon, count, &t.flight);
            t.next = photon_next(&t.flight);
        }
        fly(&job, &t, count);
        put_stretches(m, &l, &t);
        lay(s, m, &l, count, ends ? 1 : lay_threads);
        left = __syncthreads_count(t.next != TRACER_ENDS);
    } while (!ends);
    write_counts(&job, count);
}

const int cells_of_brick = 512;
const int cells_at_once = 128; /* of them, in one block */

/* No fewer than a multiprocessor has room for. */
const int blocks_of_balls = 6;

/* As many as a multiprocessor has room for: 128 registers a thread. */
const int blocks_of_light = 4;

/* The brick and the number in it of a thread's cell; false: it is not there. */
__device__ __forceinline__ bool find_cell(const cell_job *job, uint64_t *brick,
                                          int *cell)
{
    const int blocks = cells_of_brick / cells_at_once;
    *brick = blockIdx.x / blocks;
    *cell = static_cast<int>(blockIdx.x % blocks * cells_at_once + threadIdx.x);
    return *brick < job->scene.radiance_slots_count &&
           job->scene.radiance_slots[*brick] >= 0;
}

/* Lists the cells whose balls have something. */
__global__ void __launch_bounds__(cells_at_once)
list_cells(const __grid_constant__ cell_job job)
{
    uint64_t brick;
    int cell;
    bool has = find_cell(&job, &brick, &cell) &&
               ball_cell_has(&job.scene, brick, cell, job.cells);
    unsigned at = take_numbers(&job.queue->listed, has);
    if (has)
        job.list[at] = brick * cells_of_brick + static_cast<unsigned>(cell);
}

/* The threads that find what is in a ball: a warp. Of several media, which are
 * found by lists of them, each thread has a ball of its own. */
__device__ __forceinline__ team ball_team()
{
    int lane = threadIdx.x % warp_size;
    return SCENE_SOLE ? team{lane, warp_size} : team_alone();
}

/* The next of the list for each team. */
__device__ __forceinline__ unsigned take_ball(const cell_job *job, team t)
{
    unsigned i = take_numbers(&job->queue->taken, t.place == 0);
    return t.size > 1 ? __shfl_sync(~0u, i, 0) : i;
}

/* Threads that stay take them: their work is uneven, and what lies beside is
 * often empty. */
__global__ void __launch_bounds__(cells_at_once, 4)
ball_cells(const __grid_constant__ cell_job job)
{
    unsigned i, n = job.queue->listed;
    team t = ball_team();
    do {
        i = take_ball(&job, t);
        if (i < n)
            ball_cell_run(&job.scene, job.list[i] / cells_of_brick,
                          static_cast<int>(job.list[i] % cells_of_brick),
                          job.cells, t);
    } while (__any_sync(~0u, i < n));
}

/* Whether balls around cells have some of the only medium: that of each thread
 * that asks, of which one point tells most often, else those of all threads. */
__device__ __forceinline__ bool find_media(const flat_scene *s, vec3 x,
                                           bool asks)
{
    bool has = asks && ball_finds(s, x, 0, BALL_PAIRS);
    unsigned rest = __ballot_sync(~0u, asks && !has);
    int lane = threadIdx.x % warp_size;
    for (; rest != 0u; rest &= rest - 1u) {
        int owner = __ffs(rest) - 1;
        vec3 at = vec3_make(__shfl_sync(~0u, x.x, owner),
                            __shfl_sync(~0u, x.y, owner),
                            __shfl_sync(~0u, x.z, owner));
        bool found = __any_sync(~0u, ball_finds(s, at, lane, warp_size));
        has = has || (found && lane == owner);
    }
    return has;
}

/* Numbers in a count for those threads of a block that ask, in their order; all
 * are here. */
__device__ __forceinline__ unsigned take_in_order(unsigned *count, bool asks)
{
    __shared__ unsigned first[cells_of_brick / warp_size];
    int lane = threadIdx.x % warp_size, warp = threadIdx.x / warp_size;
    unsigned all = __ballot_sync(~0u, asks);
    if (lane == 0)
        first[warp] = __popc(all);
    __syncthreads();
    if (threadIdx.x == 0) {
        unsigned sum = 0;
        for (int i = 0; i < cells_of_brick / warp_size; i++) {
            unsigned own = first[i];
            first[i] = sum;
            sum += own;
        }
        unsigned from = sum > 0 ? atomicAdd(count, sum) : 0;
        for (int i = 0; i < cells_of_brick / warp_size; i++)
            first[i] += from;
    }
    __syncthreads();
    return first[warp] + __popc(all & ((1u << lane) - 1u));
}

/* Lists the cells that may have light, brick by brick: lines of cells that lie
 * side by side are about as long. */
__global__ void __launch_bounds__(cells_of_brick)
list_lit(const __grid_constant__ cell_job job)
{
    const flat_scene *s = &job.scene;
    uint64_t brick = blockIdx.x;
    int cell = static_cast<int>(threadIdx.x);
    bool has = brick < s->radiance_slots_count &&
               s->radiance_slots[brick] >= 0 && lit_cell_may(s, brick, cell);
    if (SCENE_SOLE && scene_may(MAY_BALLS) && s->field.ball) {
        vec3 x = vec3_make(0.0f, 0.0f, 0.0f);
        if (has)
            x = radiance_middle(s, brick, cell);
        has = find_media(s, x, has);
    }
    unsigned at = take_in_order(&job.queue->listed, has);
    if (has)
        job.list[at] = brick * cells_of_brick + static_cast<unsigned>(cell);
}

/* Gives threads that wait for one the next cells of the list. */
__device__ __forceinline__ void take_lit(const cell_job *job, lit_task *t,
                                         lit_liner *l)
{
    bool asks = l->next == LIT_TAKES;
    unsigned i = take_numbers(&job->queue->taken, asks);
    if (asks && i >= job->queue->listed)
        l->next = LIT_ENDS;
    else if (asks)
        lit_take(&job->scene, job->seed, job->frame,
                 job->list[i] / cells_of_brick,
                 static_cast<int>(job->list[i] % cells_of_brick), job->cells,
                 t, l);
}

/* Goes along the lines of a warp's threads, to the ends of their segments. All
 * meet between what is of pieces and what is along them. */
__device__ __forceinline__ void step_lit(const flat_scene *s, lit_liner *l)
{
    while (__any_sync(~0u, l->next == LIT_STEPS)) {
        if (l->next == LIT_STEPS)
            lit_skip(s, l);
        __syncwarp();
        if (l->next == LIT_STEPS)
            lit_step(s, l);
    }
}

/* Where each thread keeps what the steps of its line have nothing to do with:
 * the compiler is not to see that it could be in registers. */
__device__ __forceinline__ lit_task *apart(lit_task *task)
{
    asm volatile("" : "+l"(task));
    return task;
}

/* Threads that stay take the cells of the list, a warp those that lie together:
 * their lines are about as long. */
__global__ void __launch_bounds__(cells_at_once, blocks_of_light)
light_cells(const __grid_constant__ cell_job job)
{
    const flat_scene *s = &job.scene;
    lit_task task, *t = apart(&task);
    lit_liner l;
    l.next = LIT_TAKES;
    while (__any_sync(~0u, l.next != LIT_ENDS)) {
        if (l.next == LIT_LANDS)
            lit_land(s, t, &l);
        if (!__any_sync(~0u, l.next != LIT_TAKES && l.next != LIT_ENDS))
            take_lit(&job, t, &l);
        if (l.next == LIT_CHOOSES)
            lit_choose(s, t, &l);
        if (l.next == LIT_SEEKS)
            lit_seek(s, t, &l);
        step_lit(s, &l);
    }
}

unsigned bricks_of(const cell_job *job)
{
    unsigned bricks = static_cast<unsigned>(job->scene.radiance_slots_count);
    return bricks > 0 ? bricks : 1u;
}

unsigned cell_blocks(const cell_job *job)
{
    return bricks_of(job) * (cells_of_brick / cells_at_once);
}

void bear(const trace_job *job)
{
    unsigned blocks = (job->born + births_at_once - 1) / births_at_once;
    bear_photons<<<blocks > 0 ? blocks : 1, births_at_once>>>(*job);
}

cudaError_t trace(const trace_job *job, unsigned blocks, int threads)
{
    size_t bytes = static_cast<size_t>(threads / warp_size) *
                   sizeof(warp_memory);
    cudaError_t code = cudaFuncSetAttribute(
        trace_photons, cudaFuncAttributeMaxDynamicSharedMemorySize,
        static_cast<int>(bytes));
    if (code != cudaSuccess)
        return code;
    trace_photons<<<blocks, threads, bytes>>>(*job);
    if (job->last)
        follow_photons<<<last_blocks * job->processors, last_threads>>>(*job);
    return cudaGetLastError();
}

void balls(const cell_job *job)
{
    list_cells<<<cell_blocks(job), cells_at_once>>>(*job);
    ball_cells<<<blocks_of_balls * job->processors, cells_at_once>>>(*job);
}

void light(const cell_job *job)
{
    list_lit<<<bricks_of(job), cells_of_brick>>>(*job);
    light_cells<<<blocks_of_light * job->processors, cells_at_once>>>(*job);
}

}

const photon_stage PHOTON_STAGE = {
    SCENE_MAY, sizeof(photon_state), sizeof(warp_memory), last_bytes,
    most_trace_threads, 1, bear, trace, balls, light};
