/* The walks of tests/unit/truth_walk.h: the paths of all batches side by side,
 * sorted by batch and place; the last few of a batch by a block. Sums are in a
 * fixed order, those by which paths are split are of whole numbers. */
#define SCENE_MAY (MAY_EMISSION | MAY_SKY | MAY_MANY | MAY_CLEAR)
#include "tests/gpu/walk.h"
#include "core/cuda/device.cuh"
#include "tests/unit/truth_step.h"
#define CCCL_DISABLE_NVTX
#include <cub/block/block_reduce.cuh>
#include <cub/block/block_scan.cuh>
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>
#include <vector>

namespace
{

enum {
    THREADS = 128,
    SLICES = 32,     /* of a batch's sum                            */
    PLACE_BITS = 16, /* of walk_key                                 */
    MOST = 1 << 23,  /* paths at the start of a part                */
    GROWTH = 4,      /* of which so many times as many have room    */
    LAST = 256,      /* paths of a batch that a block takes over    */
    LAST_ROOM = 4096
};

/* What is on the device of a walk. */
struct crowd {
    walk w;
    flat_scene scene;
    int batches;
    uint32_t room, count;
    walker *now, *next;
    double *seen, *sum;
    uint32_t *key[2], *order[2];
    uint64_t *share; /* of usual walkers, in 2^-32, then their sums */
    uint32_t *copies, *place;
    uint32_t *first; /* of each batch, and how many in all          */
    uint32_t *fault; /* counts of FAULTS                            */
    void *scratch;
    size_t scratch_bytes;
    cudaStream_t stream;
};

enum { EXCEEDED, OVERFLOWED, FAULTS };

/* ---- kernels ------------------------------------------------------------- */

__global__ void begin(crowd c, uint32_t n)
{
    uint32_t i = blockIdx.x * THREADS + threadIdx.x;
    if (i < c.count)
        c.now[i] = walk_first(&c.w, static_cast<int>(i / n));
    if (i <= static_cast<uint32_t>(c.batches))
        c.first[i] = i * n;
}

/* In their order, of the paths that go on: `batches` stands for the others. */
__device__ uint32_t key_of(const crowd &c, const walker &a, bool goes_on)
{
    if (!goes_on)
        return static_cast<uint32_t>(c.batches) << PLACE_BITS;
    uint32_t batch = static_cast<uint32_t>(a.batch);
    double x = fmin(fmax(a.at / c.w.map.reach, 0.0), 1.0);
    return batch << PLACE_BITS |
           walk_key(&c.w, &a, x, c.first[batch + 1] - c.first[batch]);
}

/* The i-th of its batch makes a step; false if it was its last. */
__device__ bool advance(const crowd &c, const walk *w, walker *a, uint32_t i,
                        double *seen)
{
    walk_path p = {};
    p.w = w;
    p.scene = &c.scene;
    p.a = *a;
    walk_shift(&p);
    bool goes_on = walk_step(&p, a, i);
    *a = p.a;
    *seen = p.seen;
    if (p.counters.majorant_exceeded)
        atomicAdd(&c.fault[EXCEEDED], 1u);
    return goes_on;
}

__global__ void __launch_bounds__(THREADS) step(const __grid_constant__ crowd c)
{
    uint32_t i = blockIdx.x * THREADS + threadIdx.x;
    if (i >= c.count)
        return;
    walker a = c.now[i];
    bool goes_on = advance(c, &c.w, &a, i - c.first[a.batch], &c.seen[i]);
    c.now[i] = a;
    c.key[0][i] = key_of(c, a, goes_on);
    c.order[0][i] = i;
}

/* A block adds up a slice of what a batch's paths brought. */
__global__ void add_seen(const __grid_constant__ crowd c)
{
    typedef cub::BlockReduce<double, THREADS> reduce;
    __shared__ typename reduce::TempStorage room;
    double sum = 0.0;
    uint32_t to = c.first[blockIdx.y + 1], by = SLICES * THREADS;
    for (uint32_t i = c.first[blockIdx.y] + blockIdx.x * THREADS + threadIdx.x;
         i < to; i += by)
        sum += c.seen[i];
    sum = reduce(room).Sum(sum);
    if (threadIdx.x == 0)
        c.sum[blockIdx.y * SLICES + blockIdx.x] += sum;
}

/* The share of a path that is split or ended, for which its weight is that of
 * each copy from now on; 0: it is left as it is. */
__device__ uint64_t split(const crowd &c, walker *a)
{
    double share = 0.0;
    if (!walk_is_split(&c.w, a, &share))
        return 0;
    uint64_t whole = static_cast<uint64_t>(fmin(share, 0x1p20) * 0x1p32) + 1;
    a->weight /= static_cast<double>(whole) * 0x1p-32;
    return whole;
}

/* Copies of one, by the sum of the shares with its own and of those before. */
__device__ uint32_t copies_of(const walk *w, int batch, uint64_t sum,
                              uint64_t share)
{
    rng r = walk_random(w, batch, 13, 0);
    uint64_t due = rng_u32(&r);
    return static_cast<uint32_t>((sum + due) >> 32) -
           static_cast<uint32_t>((sum - share + due) >> 32);
}

/* Into `next`, sorted, with the weight of each copy. */
__global__ void judge(const __grid_constant__ crowd c)
{
    uint32_t i = blockIdx.x * THREADS + threadIdx.x;
    if (i >= c.count)
        return;
    walker a = c.now[c.order[0][i]];
    a.key = c.key[0][i];
    bool goes_on = a.key >> PLACE_BITS < static_cast<uint32_t>(c.batches);
    c.share[i] = goes_on ? split(c, &a) : 0;
    c.copies[i] = goes_on && c.share[i] == 0;
    c.next[i] = a;
}

__global__ void count_copies(const __grid_constant__ crowd c)
{
    uint32_t i = blockIdx.x * THREADS + threadIdx.x;
    if (i >= c.count)
        return;
    uint64_t share = c.share[i] - (i ? c.share[i - 1] : 0);
    if (share > 0)
        c.copies[i] = copies_of(&c.w, c.next[i].batch, c.share[i], share);
}

/* A path tells where the batches that begin with it lie; the last one, those
 * after it. */
__global__ void copy(const __grid_constant__ crowd c)
{
    uint32_t i = blockIdx.x * THREADS + threadIdx.x;
    if (i >= c.count)
        return;
    walker a = c.next[i];
    uint32_t at = c.place[i], end = at + c.copies[i];
    uint32_t batch = a.key >> PLACE_BITS;
    uint32_t before = i ? (c.next[i - 1].key >> PLACE_BITS) + 1 : 0;
    for (uint32_t b = before; b <= batch; b++)
        c.first[b] = at;
    if (i == c.count - 1)
        for (uint32_t b = batch + 1; b <= static_cast<uint32_t>(c.batches); b++)
            c.first[b] = end;
    for (; at < end && at < c.room; at++)
        c.now[at] = a;
}

/* ---- the last paths ------------------------------------------------------ */

/* A block has those of a batch, in the order they came in: to sort them would
 * spare no noise that counts. */
struct last_paths {
    typedef cub::BlockScan<uint64_t, THREADS> shares;
    typedef cub::BlockScan<uint32_t, THREADS> copies;
    union {
        typename shares::TempStorage share;
        typename copies::TempStorage copy;
        typename cub::BlockReduce<double, THREADS>::TempStorage sum;
    } room;
};

/* A path for each thread from `i` on: a step, then its copies behind the *kept
 * of `to`. *shares is the sum of those before. What its line saw. */
__device__ double last_step(const crowd &c, const walk *w, last_paths *l,
                            const walker *from, uint32_t count, uint32_t i,
                            walker *to, uint32_t *kept, uint64_t *shares)
{
    walker a;
    double seen = 0.0;
    uint64_t share = 0, sum = 0, all = 0;
    uint32_t copies = 0, place = 0, added = 0;
    if (i < count) {
        a = from[i];
        if (advance(c, w, &a, i, &seen)) {
            share = split(c, &a);
            copies = share == 0;
        }
    }
    last_paths::shares(l->room.share).InclusiveSum(share, sum, all);
    __syncthreads();
    if (share > 0) {
        walk next = *w;
        next.generation++;
        copies = copies_of(&next, a.batch, *shares + sum, share);
    }
    last_paths::copies(l->room.copy).ExclusiveSum(copies, place, added);
    __syncthreads();
    for (uint32_t k = *kept + place; copies > 0; k++, copies--)
        if (k < LAST_ROOM)
            to[k] = a;
    *kept += added;
    *shares += all;
    return seen;
}

/* All generations of what is left of a batch. */
__global__ void __launch_bounds__(THREADS)
    finish(const __grid_constant__ crowd c)
{
    __shared__ last_paths l;
    uint32_t b = blockIdx.x, count = c.first[b + 1] - c.first[b];
    const walker *from = c.now + c.first[b];
    walker *to = c.next + 2 * b * LAST_ROOM, *other = to + LAST_ROOM;
    double seen = 0.0;
    for (walk w = c.w; count > 0; w.generation++) {
        uint32_t kept = 0;
        uint64_t shares = 0;
        for (uint32_t i = threadIdx.x; i - threadIdx.x < count; i += THREADS)
            seen += last_step(c, &w, &l, from, count, i, to, &kept, &shares);
        if (kept > LAST_ROOM) {
            atomicAdd(&c.fault[OVERFLOWED], 1u);
            return;
        }
        __syncthreads();
        count = kept;
        from = to;
        to = other;
        other = const_cast<walker *>(from);
    }
    seen = cub::BlockReduce<double, THREADS>(l.room.sum).Sum(seen);
    if (threadIdx.x == 0)
        c.sum[b * SLICES] += seen;
}

/* ---- memory -------------------------------------------------------------- */

size_t scratch_bytes_of(uint32_t room)
{
    size_t sort = 0, shares = 0, copies = 0;
    cub::DoubleBuffer<uint32_t> none(nullptr, nullptr);
    uint64_t *share = nullptr;
    uint32_t *count = nullptr;
    cub::DeviceRadixSort::SortPairs(nullptr, sort, none, none, room);
    cub::DeviceScan::InclusiveSum(nullptr, shares, share, share, room);
    cub::DeviceScan::ExclusiveSum(nullptr, copies, count, count, room);
    size_t most = sort > shares ? sort : shares;
    return most > copies ? most : copies;
}

template <typename type> type *take(device_arena *arena, size_t count)
{
    return static_cast<type *>(device_take(arena, count * sizeof(type)));
}

/* Where all lies; what it takes, where the arena has no memory yet. */
size_t lay_out(crowd *c, device_arena *arena)
{
    size_t room = c->room, entries = walk_entries(&c->w.map);
    c->now = take<walker>(arena, room);
    c->next = take<walker>(arena, room);
    c->seen = take<double>(arena, room);
    for (int i = 0; i < 2; i++) {
        c->key[i] = take<uint32_t>(arena, room);
        c->order[i] = take<uint32_t>(arena, room);
    }
    c->share = take<uint64_t>(arena, room);
    c->copies = take<uint32_t>(arena, room);
    c->place = take<uint32_t>(arena, room);
    c->first = take<uint32_t>(arena, c->batches + 1);
    c->sum = take<double>(arena, c->batches * SLICES);
    c->fault = take<uint32_t>(arena, FAULTS);
    c->scratch = take<char>(arena, c->scratch_bytes);
    c->w.map.due = take<double>(arena, entries);
    c->w.map.ahead = take<double>(arena, entries);
#define X(type, name) c->scene.name = take<type>(arena, c->scene.name##_count);
    SCENE_ARRAYS(X)
#undef X
    return arena->used;
}

template <typename type>
bool send(const crowd *c, const type *to, const type *from, size_t count,
          brume_error *err)
{
    return count == 0 ||
           device_check(cudaMemcpyAsync(const_cast<type *>(to), from,
                                        count * sizeof(type),
                                        cudaMemcpyHostToDevice, c->stream),
                        "a walk", err);
}

template <typename type>
bool clear(const crowd *c, type *what, size_t count, brume_error *err)
{
    return device_check(
        cudaMemsetAsync(what, 0, count * sizeof(type), c->stream), "a walk",
        err);
}

template <typename type>
bool fetch(const crowd *c, type *to, const type *from, size_t count,
           brume_error *err)
{
    return device_check(cudaMemcpyAsync(to, from, count * sizeof(type),
                                        cudaMemcpyDeviceToHost, c->stream),
                        "a walk", err) &&
           device_check(cudaStreamSynchronize(c->stream), "a walk", err);
}

bool set_up(crowd *c, const walk *w, const flat *f, device_arena *arena,
            brume_error *err)
{
    size_t entries = walk_entries(&w->map);
    void *base = nullptr;
    c->w = *w;
    c->scene = f->view;
    c->scratch_bytes = scratch_bytes_of(c->room);
    size_t bytes = lay_out(c, arena);
    device_keep_memory();
    if (!device_check(
            cudaStreamCreateWithFlags(&c->stream, cudaStreamNonBlocking),
            "a walk", err) ||
        !device_check(cudaMallocAsync(&base, bytes, c->stream), "a walk", err))
        return false;
    *arena = {static_cast<char *>(base), bytes, 0};
    lay_out(c, arena);
    bool good = send(c, c->w.map.due, w->map.due, entries, err) &&
                send(c, c->w.map.ahead, w->map.ahead, entries, err) &&
                clear(c, c->sum, c->batches * SLICES, err) &&
                clear(c, c->fault, FAULTS, err);
#define X(type, name)                                                          \
    good = good &&                                                             \
           send(c, c->scene.name, f->view.name, f->view.name##_count, err);
    SCENE_ARRAYS(X)
#undef X
    return good;
}

/* ---- a walk -------------------------------------------------------------- */

uint32_t blocks_for(uint32_t count)
{
    return (count + THREADS - 1) / THREADS;
}

void sort(crowd *c)
{
    cub::DoubleBuffer<uint32_t> keys(c->key[0], c->key[1]);
    cub::DoubleBuffer<uint32_t> orders(c->order[0], c->order[1]);
    int bits = PLACE_BITS;
    while (c->batches >> (bits - PLACE_BITS))
        bits++;
    cub::DeviceRadixSort::SortPairs(c->scratch, c->scratch_bytes, keys, orders,
                                    c->count, 0, bits, c->stream);
    c->key[0] = keys.Current();
    c->key[1] = keys.Alternate();
    c->order[0] = orders.Current();
    c->order[1] = orders.Alternate();
}

/* All paths to their next events, but for those that end. */
bool generation(crowd *c, brume_error *err)
{
    uint32_t blocks = blocks_for(c->count);
    step<<<blocks, THREADS, 0, c->stream>>>(*c);
    add_seen<<<dim3(SLICES, c->batches), THREADS, 0, c->stream>>>(*c);
    sort(c);
    c->w.generation++;
    judge<<<blocks, THREADS, 0, c->stream>>>(*c);
    cub::DeviceScan::InclusiveSum(c->scratch, c->scratch_bytes, c->share,
                                  c->share, c->count, c->stream);
    count_copies<<<blocks, THREADS, 0, c->stream>>>(*c);
    cub::DeviceScan::ExclusiveSum(c->scratch, c->scratch_bytes, c->copies,
                                  c->place, c->count, c->stream);
    copy<<<blocks, THREADS, 0, c->stream>>>(*c);
    return device_check(cudaGetLastError(), "a walk", err) &&
           fetch(c, &c->count, c->first + c->batches, 1, err);
}

/* The pass-th n paths of each batch; their sums are added up on the device. */
bool walk_part(crowd *c, uint32_t pass, uint32_t n, brume_error *err)
{
    uint32_t batches = static_cast<uint32_t>(c->batches);
    c->w.pass = pass;
    c->w.generation = 0;
    c->count = n * batches;
    begin<<<blocks_for(c->count + 1), THREADS, 0, c->stream>>>(*c, n);
    do {
        if (!generation(c, err))
            return false;
        if (c->count > c->room)
            return brume_fail(err, BRUME_ERR_DEVICE,
                              "paths of a walk have no room: %u", c->count);
    } while (c->count > LAST * batches);
    finish<<<batches, THREADS, 0, c->stream>>>(*c);
    return device_check(cudaGetLastError(), "a walk", err);
}

bool fetch_means(const crowd *c, double paths, double *mean, brume_error *err)
{
    std::vector<double> sum(c->batches * SLICES);
    uint32_t fault[FAULTS] = {};
    if (!fetch(c, sum.data(), c->sum, sum.size(), err) ||
        !fetch(c, fault, c->fault, FAULTS, err))
        return false;
    for (int b = 0; b < c->batches; b++) {
        mean[b] = 0.0;
        for (int i = 0; i < SLICES; i++)
            mean[b] += sum[b * SLICES + i] / paths;
    }
    return (fault[EXCEEDED] == 0 && fault[OVERFLOWED] == 0) ||
           brume_fail(err, BRUME_ERR_DEVICE,
                      "majorants were exceeded: %u; batches had no room: %u",
                      fault[EXCEEDED], fault[OVERFLOWED]);
}

}

bool walk_on_gpu(const walk *w, const flat *f, size_t n, int batches,
                 double *mean, brume_error *err)
{
    crowd c = {};
    device_arena arena = {};
    size_t parts = (n * batches + MOST - 1) / MOST;
    size_t each = (n + parts - 1) / parts;
    size_t room = GROWTH * each > 2 * LAST_ROOM ? GROWTH * each : 2 * LAST_ROOM;
    c.batches = batches;
    c.room = static_cast<uint32_t>(room * batches);
    bool good = set_up(&c, w, f, &arena, err);
    for (size_t i = 0; good && i < parts; i++)
        good = walk_part(&c, static_cast<uint32_t>(i),
                         static_cast<uint32_t>(each), err);
    good = good &&
           fetch_means(&c, static_cast<double>(each * parts), mean, err);
    if (arena.base)
        cudaFreeAsync(arena.base, c.stream);
    if (c.stream)
        cudaStreamDestroy(c.stream);
    return good;
}
