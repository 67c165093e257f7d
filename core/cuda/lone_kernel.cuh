/* lone_kernel.cuh - the kernel that traces photons of one gray medium in one
 * container. LONE_STAGE names what is defined here; SCENE_MAY tells whether
 * power has colours.
 *
 * Each warp goes by itself: its photons fly together, from event to event, or
 * its threads lay cells. A thread that lays what its photon has flown lets it
 * fly once more; so those whose flights have few cells do not wait for those
 * that have many. Few wait for others where what they need is long and seldom:
 * a new photon, or where a flight ends. */
#include "core/cuda/count.cuh"
#include "core/cuda/lone.cuh"

namespace
{

/* A block's threads, and blocks that a multiprocessor has room for. */
const int lone_threads = LONE_STRIDE;
const int lone_blocks = scene_may(MAY_TINTS) ? 4 : 5;

/* Threads of a warp for which photons are taken and ends are sought; so many
 * lay cells before others fly; and how many of those that have photons, in
 * eighths, are enough for a flight. */
const int serve_threads = 8, lay_threads = 19, fly_eighths = 5;

/* Beside LONE_*: a photon is to be taken. */
enum { LONE_TAKES = LONE_ENDS + 1, LONE_WAITS };

/* A thread's photon, and where it is. */
struct lone_tracer {
    lone_photon photon;
    int next;
};

/* What a thread lays: one of two places in memory, while what is in the other
 * may wait. */
struct lone_layer {
    lone_walk walk;
    int place;
    bool busy, waits;
};

/* Four words are one access to memory. */
struct HD_ALIGNED(16) lone_four {
    float x, y, z, w;
};

/* Where in fours a line is, and its walk as it begins. */
enum { FOUR_O, FOUR_D, FOUR_AT, FOUR_INVERSE, FOUR_NEXT, FOUR_TINTS };

struct lone_memory {
    lone_four four[2][scene_may(MAY_TINTS) ? 6 : 5][lone_threads];
    uint32_t word[LONE_WORDS][lone_threads];
    lone_rest rest[lone_threads];
    lone_counts count[lone_threads];
};

__device__ __forceinline__ int threads_where(bool here)
{
    return __popc(__ballot_sync(~0u, here));
}

__device__ __forceinline__ lone_born *lone_list(const trace_job *job, int turn)
{
    return static_cast<lone_born *>(job->list[turn]);
}

/* Gives threads without one the next photons of the list. */
__device__ __forceinline__ void take_photons(const trace_job *job,
                                             lone_tracer *t, lone_rest *w)
{
    bool idle = t->next == LONE_TAKES;
    unsigned i = take_numbers(&job->queue->taken, idle);
    if (idle && i >= job->queue->left[job->turn]) {
        t->next = LONE_WAITS;
    } else if (idle) {
        const lone_born *from = &lone_list(job, job->turn)[i];
        t->photon = from->photon;
        t->photon.numbers.drawn = t->photon.numbers.next / 4u;
        *w = from->rest;
        t->next = LONE_FLIES;
    }
}

/* Leaves photons at the beginning of a flight to the next launch. */
__device__ __forceinline__ void leave_photons(const trace_job *job,
                                              lone_tracer *t,
                                              const lone_rest *w)
{
    bool leaves = t->next == LONE_FLIES;
    unsigned i = take_numbers(&job->queue->left[!job->turn], leaves);
    if (leaves) {
        lone_list(job, !job->turn)[i] = {t->photon, *w};
        t->next = LONE_WAITS;
    }
}

/* What few threads wait for. */
__device__ __forceinline__ void serve(const trace_job *job, lone_tracer *t,
                                      lone_rest *w)
{
    bool waits = t->next == LONE_TAKES || t->next == LONE_SEEKS;
    unsigned fly = __ballot_sync(~0u, t->next == LONE_FLIES);
    if (threads_where(waits) >= serve_threads || fly == 0u) {
        if (t->next == LONE_SEEKS) {
            lone_seek(&job->scene, &job->lone, &t->photon, w);
            t->next = LONE_FLIES;
        }
        take_photons(job, t, w);
    }
    if (!job->last && __any_sync(~0u, t->next == LONE_WAITS))
        leave_photons(job, t, w);
}

__device__ __forceinline__ vec3 three_of(const lone_four *v)
{
    return vec3_make(v->x, v->y, v->z);
}

/* A thread's words of a place, and what they are. */
__device__ __forceinline__ lone_four *words_at(lone_memory *m, int place,
                                               int what)
{
    return &m->four[place][what][threadIdx.x];
}

__device__ __forceinline__ void put_words(lone_memory *m, int place, int what,
                                          vec3 v, float w)
{
    *words_at(m, place, what) = {v.x, v.y, v.z, w};
}

/* Numbers of cells have 16 bits. */
__device__ __forceinline__ void put_stretch(lone_memory *m, int place,
                                            const lone_line *y,
                                            const lone_walk *w)
{
    const float *n = y->inverse;
    put_words(m, place, FOUR_O, y->o, y->power.r);
    put_words(m, place, FOUR_D, y->d, w->t);
    put_words(m, place, FOUR_AT, y->at, w->end);
    put_words(m, place, FOUR_INVERSE, vec3_make(n[0], n[1], n[2]),
              __int_as_float(w->cell[0] | w->cell[1] << 16));
    put_words(m, place, FOUR_NEXT,
              vec3_make(w->next[0], w->next[1], w->next[2]),
              __int_as_float(w->cell[2]));
    if (scene_may(MAY_TINTS))
        put_words(m, place, FOUR_TINTS,
                  vec3_make(y->power.g, y->power.b, 0.0f), 0.0f);
}

__device__ __forceinline__ lone_line get_line(lone_memory *m, int place)
{
    lone_four o = *words_at(m, place, FOUR_O), d = *words_at(m, place, FOUR_D);
    lone_four at = *words_at(m, place, FOUR_AT);
    lone_four n = *words_at(m, place, FOUR_INVERSE);
    rgb power = rgb_gray(o.w);
    if (scene_may(MAY_TINTS)) {
        power.g = words_at(m, place, FOUR_TINTS)->x;
        power.b = words_at(m, place, FOUR_TINTS)->y;
    }
    return {three_of(&o), three_of(&d), power, three_of(&at), {n.x, n.y, n.z}};
}

__device__ __forceinline__ lone_walk get_walk(lone_memory *m, int place)
{
    lone_four next = *words_at(m, place, FOUR_NEXT);
    int cells = __float_as_int(words_at(m, place, FOUR_INVERSE)->w);
    return {words_at(m, place, FOUR_D)->w, words_at(m, place, FOUR_AT)->w,
            {next.x, next.y, next.z},
            {cells & 0xffff, cells >> 16, __float_as_int(next.w)}};
}

/* A cell of what a thread lays; then what waits is begun. */
__device__ __forceinline__ void lay_cell(const trace_job *job, lone_memory *m,
                                         lone_layer *y)
{
    lone_line line = get_line(m, y->place);
    y->busy = lone_lay(&job->scene, &job->lone, job->sum,
                       &m->count[threadIdx.x], &line, &y->walk);
    if (!y->busy && y->waits) {
        y->place = !y->place;
        y->walk = get_walk(m, y->place);
        y->busy = true;
        y->waits = false;
    }
}

/* Lays cells until there are photons enough to fly, or all is laid. */
__device__ __forceinline__ void lay_cells(const trace_job *job, lone_memory *m,
                                          const lone_tracer *t, lone_layer *y)
{
    int all = threads_where(t->next == LONE_FLIES);
    for (;;) {
        int lay = threads_where(y->busy);
        int fly = threads_where(t->next == LONE_FLIES && !y->waits);
        bool enough = fly > 0 && 8 * fly >= fly_eighths * all;
        if (lay == 0 || (enough && lay < lay_threads))
            return;
        if (y->busy)
            lay_cell(job, m, y);
    }
}

/* Draws numbers for flights; while at it, for those to come. */
__device__ __forceinline__ void draw(const trace_job *job, lone_memory *m,
                                     lone_tracer *t)
{
    lone_stream *n = &t->photon.numbers;
    bool flies = t->next == LONE_FLIES;
    while (__any_sync(~0u, flies && lone_ready(n) < LONE_NEEDS))
        if (flies && lone_ready(n) + 4 <= static_cast<int>(LONE_WORDS))
            lone_draw(&job->lone, m->rest[threadIdx.x].path, n,
                      &m->word[0][threadIdx.x]);
}

/* A flight of each photon that is at the beginning of one. */
__device__ __forceinline__ void fly(const trace_job *job, lone_memory *m,
                                    lone_tracer *t, lone_layer *y)
{
    lone_counts *count = &m->count[threadIdx.x];
    lone_rest *w = &m->rest[threadIdx.x];
    const uint32_t *words = &m->word[0][threadIdx.x];
    lone_end f;
    if (t->next == LONE_FLIES && !y->waits)
        t->next = lone_fly(&job->lone, &t->photon, w, words, &f, count);
    if (t->next == LONE_LAYS) {
        int place = y->busy ? !y->place : y->place;
        lone_line line;
        lone_walk walk;
        if (lone_lays(&job->scene, &job->lone, &t->photon, &f, &line, &walk)) {
            put_stretch(m, place, &line, &walk);
            y->waits = y->busy;
            y->walk = y->busy ? y->walk : walk;
            y->busy = true;
        }
        t->next = lone_land(&job->scene, &job->lone, &t->photon, w, words, &f,
                            count);
    }
    if (t->next == LONE_ENDS)
        t->next = LONE_TAKES;
}

__device__ __forceinline__ void write_counts(const trace_job *job,
                                             const lone_counts *count)
{
    photon_totals *total = job->total;
    count_warp(&total->track.rays, count->rays);
    count_warp(&total->track.lookups, count->lookups);
    count_warp(&total->events, count->events);
    count_warp(&total->clipped, count->clipped);
#define X(name) count_warp(&total->name, static_cast<uint64_t>(count->name));
    LONE_BOOKS(X)
#undef X
}

__global__ void __launch_bounds__(lone_threads, lone_blocks)
trace_lone(const __grid_constant__ trace_job job)
{
    __shared__ lone_memory m;
    lone_tracer t;
    lone_layer y = {};
    m.count[threadIdx.x] = {};
    t.next = LONE_TAKES;
    while (__any_sync(~0u, t.next != LONE_WAITS || y.busy)) {
        serve(&job, &t, &m.rest[threadIdx.x]);
        lay_cells(&job, &m, &t, &y);
        draw(&job, &m, &t);
        fly(&job, &m, &t, &y);
    }
    write_counts(&job, &m.count[threadIdx.x]);
}

cudaError_t trace(const trace_job *job, unsigned blocks, int threads)
{
    trace_lone<<<blocks, threads>>>(*job);
    return cudaGetLastError();
}

}

const photon_stage LONE_STAGE = {
    SCENE_MAY, sizeof(lone_born), 0, 0, lone_threads, lone_blocks,
    lone_bear, trace, nullptr, nullptr};
