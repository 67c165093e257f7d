/* The walks of tests/unit/truth_walk.h: the paths of all batches side by side,
 * sorted by batch and place. Sums are in a fixed order, those by which paths
 * are split are of whole numbers. */
#define SCENE_MAY (MAY_EMISSION | MAY_SKY | MAY_MANY | MAY_CLEAR)
#include "tests/unit/truth_step.h"
#include "core/cuda/device.cuh"
#include "tests/gpu/shoot.h"
#include "tests/gpu/walk.h"
#define CCCL_DISABLE_NVTX
#include <cub/block/block_reduce.cuh>
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
    GROWTH = 4       /* of which so many times as many have room    */
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
    uint32_t *exceeded;
    void *scratch;
    size_t scratch_bytes;
};

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

__global__ void __launch_bounds__(THREADS) step(const __grid_constant__ crowd c)
{
    uint32_t i = blockIdx.x * THREADS + threadIdx.x;
    if (i >= c.count)
        return;
    walk_path p = {};
    p.w = &c.w;
    p.scene = &c.scene;
    p.a = c.now[i];
    walk_shift(&p);
    bool goes_on = walk_step(&p, &c.now[i], i - c.first[p.a.batch]);
    c.now[i] = p.a;
    c.seen[i] = p.seen;
    c.key[0][i] = key_of(c, p.a, goes_on);
    c.order[0][i] = i;
    if (p.counters.majorant_exceeded)
        atomicAdd(c.exceeded, 1u);
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

/* Into `next`, sorted, with the weight of each copy. */
__global__ void judge(const __grid_constant__ crowd c)
{
    uint32_t i = blockIdx.x * THREADS + threadIdx.x;
    if (i >= c.count)
        return;
    walker a = c.now[c.order[0][i]];
    a.key = c.key[0][i];
    bool goes_on = a.key >> PLACE_BITS < static_cast<uint32_t>(c.batches);
    double share = 0.0;
    uint64_t whole = 0;
    if (goes_on && walk_is_split(&c.w, &a, &share)) {
        whole = static_cast<uint64_t>(fmin(share, 0x1p20) * 0x1p32) + 1;
        a.weight /= static_cast<double>(whole) * 0x1p-32;
    }
    c.next[i] = a;
    c.share[i] = whole;
    c.copies[i] = goes_on && whole == 0;
}

__global__ void count_copies(const __grid_constant__ crowd c)
{
    uint32_t i = blockIdx.x * THREADS + threadIdx.x;
    if (i >= c.count)
        return;
    uint64_t sum = c.share[i], before = i ? c.share[i - 1] : 0;
    if (sum == before)
        return;
    rng r = walk_random(&c.w, c.next[i].batch, 13, 0);
    uint64_t due = rng_u32(&r);
    c.copies[i] = static_cast<uint32_t>((sum + due) >> 32) -
                  static_cast<uint32_t>((before + due) >> 32);
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

/* ---- a walk -------------------------------------------------------------- */

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

void lay_out(crowd *c, device_arena *arena)
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
    c->exceeded = take<uint32_t>(arena, 1);
    c->scratch = take<char>(arena, c->scratch_bytes);
    c->w.map.due = take<double>(arena, entries);
    c->w.map.ahead = take<double>(arena, entries);
}

bool set_up(crowd *c, const walk *w, device_arena *arena, brume_error *err)
{
    size_t entries = walk_entries(&w->map), bytes = entries * sizeof(double);
    size_t each = 2 * sizeof(walker) + 48, parts = 20 * 256;
    c->w = *w;
    c->scratch_bytes = scratch_bytes_of(c->room);
    if (!device_arena_new(arena,
                          c->room * each + c->scratch_bytes + 2 * bytes +
                              c->batches * (SLICES + 1) * sizeof(double) +
                              parts,
                          err))
        return false;
    lay_out(c, arena);
    return device_check(cudaMemcpy(c->w.map.due, w->map.due, bytes,
                                   cudaMemcpyHostToDevice),
                        "a walk", err) &&
           device_check(cudaMemcpy(c->w.map.ahead, w->map.ahead, bytes,
                                   cudaMemcpyHostToDevice),
                        "a walk", err) &&
           device_check(
               cudaMemset(c->sum, 0, c->batches * SLICES * sizeof(double)),
               "a walk", err) &&
           device_check(cudaMemset(c->exceeded, 0, sizeof(uint32_t)), "a walk",
                        err);
}

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
                                    c->count, 0, bits);
    c->key[0] = keys.Current();
    c->key[1] = keys.Alternate();
    c->order[0] = orders.Current();
    c->order[1] = orders.Alternate();
}

/* All paths to their next events, but for those that end. */
bool generation(crowd *c, brume_error *err)
{
    uint32_t blocks = blocks_for(c->count);
    step<<<blocks, THREADS>>>(*c);
    add_seen<<<dim3(SLICES, c->batches), THREADS>>>(*c);
    sort(c);
    c->w.generation++;
    judge<<<blocks, THREADS>>>(*c);
    cub::DeviceScan::InclusiveSum(c->scratch, c->scratch_bytes, c->share,
                                  c->share, c->count);
    count_copies<<<blocks, THREADS>>>(*c);
    cub::DeviceScan::ExclusiveSum(c->scratch, c->scratch_bytes, c->copies,
                                  c->place, c->count);
    copy<<<blocks, THREADS>>>(*c);
    return device_check(cudaGetLastError(), "a walk", err) &&
           device_check(cudaMemcpy(&c->count, c->first + c->batches,
                                   sizeof c->count, cudaMemcpyDeviceToHost),
                        "a walk", err);
}

/* The pass-th n paths of each batch; their sums are added up on the device.
 * Few take as long as many: of the last, which bring little, ever fewer are
 * kept. */
bool walk_part(crowd *c, uint32_t pass, uint32_t n, brume_error *err)
{
    uint32_t all = n * static_cast<uint32_t>(c->batches);
    double share = c->w.share;
    c->w.pass = pass;
    c->w.generation = 0;
    c->count = all;
    begin<<<blocks_for(c->count + 1), THREADS>>>(*c, n);
    while (c->count > 0) {
        if (!generation(c, err))
            return false;
        if (c->count > c->room)
            return brume_fail(err, BRUME_ERR_DEVICE,
                              "paths of a walk have no room: %u", c->count);
        c->w.share *= c->count < all / 64 ? 1.01 : 1.0;
    }
    c->w.share = share;
    return true;
}

bool fetch_means(const crowd *c, double paths, double *mean, brume_error *err)
{
    std::vector<double> sum(c->batches * SLICES);
    uint32_t exceeded = 0;
    if (!device_check(cudaMemcpy(sum.data(), c->sum,
                                 sum.size() * sizeof(double),
                                 cudaMemcpyDeviceToHost),
                      "a walk", err) ||
        !device_check(cudaMemcpy(&exceeded, c->exceeded, sizeof exceeded,
                                 cudaMemcpyDeviceToHost),
                      "a walk", err))
        return false;
    for (int b = 0; b < c->batches; b++) {
        mean[b] = 0.0;
        for (int i = 0; i < SLICES; i++)
            mean[b] += sum[b * SLICES + i] / paths;
    }
    return exceeded == 0 ||
           brume_fail(err, BRUME_ERR_DEVICE, "a majorant was exceeded");
}

}

bool walk_on_gpu(const walk *w, const flat *f, size_t n, int batches,
                 double *mean, brume_error *err)
{
    crowd c = {};
    device_arena arena = {};
    size_t parts = (n * batches + MOST - 1) / MOST;
    size_t each = (n + parts - 1) / parts;
    c.batches = batches;
    c.room = static_cast<uint32_t>(GROWTH * each * batches);
    shoot *scene = shoot_new(f, err);
    bool good = scene && set_up(&c, w, &arena, err);
    if (good)
        c.scene = *shoot_scene(scene);
    for (size_t i = 0; good && i < parts; i++)
        good = walk_part(&c, static_cast<uint32_t>(i),
                         static_cast<uint32_t>(each), err);
    good = good &&
           fetch_means(&c, static_cast<double>(each * parts), mean, err);
    device_arena_free(&arena);
    if (scene)
        shoot_free(scene);
    return good;
}
