/* The kd-tree built on the device, level by level (Zhou, Hou, Wang, Guo 2008),
 * where each node is split as kd_build does: so both find the same tree. A
 * thread for each reference to an item, a warp for each node; the places of
 * what they make are sums over all before, in the order of the level. */
#include "core/cuda/tree.cuh"
#include "core/physics/kd_step.h"

namespace
{

const int block_size = 256, warp_size = 32, warps = block_size / warp_size;
const unsigned all = ~0u;

/* References from which on a node's bins are filled by many blocks, so many
 * references each. */
const uint32_t large = 2048;
const int bins = 6 * KD_BINS; /* of begins and ends along each axis          */

/* A node of the level, with its references. */
struct part {
    kd_task task;
    uint32_t node, first;
};

/* What there is of the level, and of the tree so far. */
struct level {
    uint32_t parts, refs, nodes, items, largest;
};

struct room {
    size_t parts, refs, nodes, items;
};

struct build {
    tree_bounds bounds;
    tree_extent *extent;
    uint32_t count;
    int deepest;
    room most;
    part *now, *next;
    uint32_t *ref, *ref_next;     /* items                                 */
    uint32_t *owner, *owner_next; /* parts                                 */
    kd_split *split;
    uint32_t *bin;
    uint64_t *side, *side_sum; /* per reference: below, and above          */
    uint64_t *made, *made_sum; /* per part: splits, and names of leaves    */
    level *state, *state_next;
    kd_node *node;
    uint32_t *name;
};

/* ---- bins --------------------------------------------------------------- */

/* A coordinate of an item in the node. */
__device__ __forceinline__ float clip(const kd_task *t, int axis, float x)
{
    return fminf(fmaxf(x, t->lo[axis]), t->hi[axis]);
}

__device__ __forceinline__ void fill(const kd_task *t, const bvh_box *box,
                                     uint32_t *bin)
{
    for (int axis = 0; axis < 3; axis++) {
        if (!(t->hi[axis] > t->lo[axis]))
            continue;
        int lo = kd_bin(t, axis, clip(t, axis, box->lo[axis]));
        int hi = kd_bin(t, axis, clip(t, axis, box->hi[axis]));
        atomicAdd(&bin[2 * axis * KD_BINS + lo], 1u);
        atomicAdd(&bin[(2 * axis + 1) * KD_BINS + hi], 1u);
    }
}

/* The bins of a large node: none other's first reference is in its stretch. */
__device__ __forceinline__ uint32_t *bins_of(const build *b, const part *p)
{
    return b->bin + static_cast<size_t>(p->first / large) * bins;
}

/* A block takes so many references: if they are of one node, by way of bins of
 * its own. */
__global__ void __launch_bounds__(block_size) fill_large(build b, level now)
{
    __shared__ uint32_t own[bins];
    uint32_t first = blockIdx.x * large, end = min(first + large, now.refs);
    uint32_t owner = b.owner[first];
    bool one = owner == b.owner[end - 1];
    for (int i = threadIdx.x; i < bins; i += block_size)
        own[i] = 0;
    __syncthreads();
    for (uint32_t i = first + threadIdx.x; i < end; i += block_size) {
        const part *p = &b.now[b.owner[i]];
        if (p->task.count >= large)
            fill(&p->task, &b.bounds.box[b.ref[i]], one ? own : bins_of(&b, p));
    }
    __syncthreads();
    for (int i = threadIdx.x; i < bins; i += block_size)
        if (own[i] != 0)
            atomicAdd(&bins_of(&b, &b.now[owner])[i], own[i]);
}

/* ---- splits ------------------------------------------------------------- */

__device__ __forceinline__ uint32_t sum_up(uint32_t x)
{
    int lane = threadIdx.x % warp_size;
    for (int i = 1; i < warp_size; i *= 2) {
        uint32_t before = __shfl_up_sync(all, x, i);
        x += lane >= i ? before : 0;
    }
    return x;
}

/* Each bin gets the sum up to it. */
__device__ __forceinline__ void sum_bins(uint32_t *bin)
{
    const int rest = KD_BINS - warp_size;
    int lane = threadIdx.x % warp_size;
    for (int row = 0; row < 6; row++, bin += KD_BINS) {
        uint32_t low = sum_up(bin[lane]);
        uint32_t high = sum_up(lane < rest ? bin[warp_size + lane] : 0);
        high += __shfl_sync(all, low, warp_size - 1);
        bin[lane] = low;
        if (lane < rest)
            bin[warp_size + lane] = high;
    }
    __syncwarp();
}

/* The best of all planes; of equals the first. */
__device__ __forceinline__ kd_split best_split(const kd_task *t,
                                               const uint32_t *bin)
{
    uint64_t best = ~UINT64_C(0);
    for (int i = threadIdx.x % warp_size; i < 3 * KD_BINS; i += warp_size) {
        int axis = i / KD_BINS, plane = i % KD_BINS;
        if (plane == 0 || !(t->hi[axis] > t->lo[axis]))
            continue;
        const uint32_t *begin = bin + 2 * axis * KD_BINS;
        float cost = kd_cost(t, axis, plane, begin[plane - 1],
                             t->count - begin[KD_BINS + plane - 1]);
        uint64_t key = static_cast<uint64_t>(__float_as_uint(cost)) << 32 | i;
        if (cost < INFINITY && key < best)
            best = key;
    }
    for (int i = warp_size / 2; i > 0; i /= 2) {
        uint64_t other = __shfl_xor_sync(all, best, i);
        best = other < best ? other : best;
    }
    kd_split s = {-1, 0.0f, INFINITY};
    if (best == ~UINT64_C(0))
        return s;
    int i = static_cast<int>(best & 0xffffffffu);
    s.axis = i / KD_BINS;
    s.at = kd_plane(t, s.axis, i % KD_BINS);
    s.cost = __uint_as_float(static_cast<uint32_t>(best >> 32));
    return s;
}

/* A warp's node: its bins, filled unless many blocks have done so. */
__device__ __forceinline__ void take_bins(const build *b, const part *p,
                                          uint32_t *bin)
{
    int lane = threadIdx.x % warp_size;
    bool filled = p->task.count >= large;
    for (int i = lane; i < bins; i += warp_size)
        bin[i] = filled ? bins_of(b, p)[i] : 0;
    __syncwarp();
    for (uint32_t i = lane; !filled && i < p->task.count; i += warp_size)
        fill(&p->task, &b->bounds.box[b->ref[p->first + i]], bin);
    __syncwarp();
}

__global__ void __launch_bounds__(block_size) find_splits(build b, level now)
{
    __shared__ uint32_t bin[warps][bins];
    uint32_t i = blockIdx.x * warps + threadIdx.x / warp_size;
    if (i > now.parts)
        return;
    if (i == now.parts) {
        b.made[i] = 0;
        return;
    }
    part p = b.now[i];
    kd_split s = {-1, 0.0f, INFINITY};
    if (kd_may_split(&p.task, b.deepest)) {
        uint32_t *own = bin[threadIdx.x / warp_size];
        take_bins(&b, &p, own);
        sum_bins(own);
        s = best_split(&p.task, own);
        kd_decide(&p.task, &s);
    }
    if (threadIdx.x % warp_size == 0) {
        b.split[i] = s;
        b.now[i].task.worse = p.task.worse;
        b.made[i] = s.axis >= 0 ? UINT64_C(1) << 32 : p.task.count;
    }
}

/* ---- the next level ----------------------------------------------------- */

/* On which sides of its node's split an item is: what touches it on both. */
__device__ __forceinline__ void find_sides(const build *b, uint32_t i,
                                           bool *below, bool *above)
{
    const kd_split *s = &b->split[b->owner[i]];
    const bvh_box *box = &b->bounds.box[b->ref[i]];
    *below = s->axis >= 0 && box->lo[s->axis] <= s->at;
    *above = s->axis >= 0 && box->hi[s->axis] >= s->at;
}

__global__ void __launch_bounds__(block_size) count_sides(build b, level now)
{
    uint32_t i = blockIdx.x * block_size + threadIdx.x;
    if (i > now.refs)
        return;
    bool below = false, above = false;
    if (i < now.refs)
        find_sides(&b, i, &below, &above);
    b.side[i] = static_cast<uint64_t>(below) << 32 | above;
}

__device__ __forceinline__ uint32_t high(uint64_t sum)
{
    return static_cast<uint32_t>(sum >> 32);
}

__device__ __forceinline__ uint32_t low(uint64_t sum)
{
    return static_cast<uint32_t>(sum);
}

/* Where references of a node's parts begin: those below come first. */
__device__ __forceinline__ void find_firsts(const build *b, const part *p,
                                            uint32_t *below, uint32_t *above,
                                            uint32_t *end)
{
    uint64_t from = b->side_sum[p->first];
    uint64_t to = b->side_sum[p->first + p->task.count];
    *below = high(from) + low(from);
    *above = *below + high(to) - high(from);
    *end = high(to) + low(to);
}

__device__ __forceinline__ void put(const build *b, uint32_t at, uint32_t item,
                                    uint32_t owner)
{
    if (at >= b->most.refs)
        return;
    b->ref_next[at] = item;
    b->owner_next[at] = owner;
}

__global__ void __launch_bounds__(block_size) move_refs(build b, level now)
{
    uint32_t i = blockIdx.x * block_size + threadIdx.x;
    if (i >= now.refs)
        return;
    uint32_t owner = b.owner[i], item = b.ref[i], below, above, end;
    const part *p = &b.now[owner];
    uint64_t made = b.made_sum[owner];
    if (b.split[owner].axis < 0) {
        size_t at = static_cast<size_t>(now.items) + low(made) + i - p->first;
        if (at < b.most.items)
            b.name[at] = b.bounds.name[item];
        return;
    }
    bool is_below, is_above;
    find_sides(&b, i, &is_below, &is_above);
    find_firsts(&b, p, &below, &above, &end);
    uint64_t sum = b.side_sum[i], from = b.side_sum[p->first];
    uint32_t child = 2 * high(made);
    if (is_below)
        put(&b, below + high(sum) - high(from), item, child);
    if (is_above)
        put(&b, above + low(sum) - low(from), item, child + 1);
}

__device__ __forceinline__ void make_node(const build *b, const level *now,
                                          uint32_t i)
{
    const part *p = &b->now[i];
    const kd_split *s = &b->split[i];
    uint64_t made = b->made_sum[i];
    kd_node *node = &b->node[p->node];
    if (s->axis < 0) {
        node->split = 0.0f;
        node->first = now->items + low(made);
        node->kind = KD_LEAF + static_cast<uint32_t>(p->task.count);
        return;
    }
    uint32_t child = 2 * high(made), end;
    part below, above;
    below.node = now->nodes + child;
    above.node = below.node + 1;
    node->split = s->at;
    node->first = below.node;
    node->kind = s->axis;
    kd_cut(&p->task, s, &below.task, &above.task);
    find_firsts(b, p, &below.first, &above.first, &end);
    below.task.count = above.first - below.first;
    above.task.count = end - above.first;
    if (child + 1 >= b->most.parts || above.node >= b->most.nodes)
        return;
    b->next[child] = below;
    b->next[child + 1] = above;
    uint64_t most = below.task.count > above.task.count ? below.task.count
                                                        : above.task.count;
    if (most >= large)
        atomicMax(&b->state_next->largest, static_cast<uint32_t>(most));
}

__global__ void __launch_bounds__(block_size) make_level(build b, level now)
{
    uint32_t i = blockIdx.x * block_size + threadIdx.x;
    if (i < now.parts)
        make_node(&b, &now, i);
    if (i != now.parts)
        return;
    level *next = b.state_next;
    uint64_t made = b.made_sum[i], sides = b.side_sum[now.refs];
    next->parts = 2 * high(made);
    next->refs = high(sides) + low(sides);
    next->nodes = now.nodes + next->parts;
    next->items = now.items + low(made);
}

/* The level of the root. */
__global__ void __launch_bounds__(block_size) begin(build b)
{
    uint32_t i = blockIdx.x * block_size + threadIdx.x;
    if (i < b.count) {
        b.ref[i] = i;
        b.owner[i] = 0;
    }
    if (i != 0)
        return;
    part root;
    for (int k = 0; k < 3; k++) {
        root.task.lo[k] = tree_from_ordered(b.extent->lo[k]);
        root.task.hi[k] = tree_from_ordered(b.extent->hi[k]);
    }
    root.task.count = b.count;
    root.task.depth = root.task.worse = 0;
    root.node = root.first = 0;
    b.now[0] = root;
}

/* ---- all of it ---------------------------------------------------------- */

unsigned blocks(size_t count, size_t size)
{
    return static_cast<unsigned>((count + size - 1) / size);
}

template <typename type> void swap(type *a, type *b)
{
    type old = *a;
    *a = *b;
    *b = old;
}

template <typename type> type *take(device_arena *from, size_t count)
{
    return static_cast<type *>(device_take(from, count * sizeof(type)));
}

/* Hands out the builder's arrays; without an arena counts their bytes. */
size_t lay_out(build *b, device_arena *from, size_t sum_bytes, void **sums)
{
    size_t parts = b->most.parts + 1, refs = b->most.refs + 1;
    b->bounds = {take<bvh_box>(from, b->count), take<uint32_t>(from, b->count)};
    b->extent = take<tree_extent>(from, 1);
    b->now = take<part>(from, parts);
    b->next = take<part>(from, parts);
    b->ref = take<uint32_t>(from, refs);
    b->ref_next = take<uint32_t>(from, refs);
    b->owner = take<uint32_t>(from, refs);
    b->owner_next = take<uint32_t>(from, refs);
    b->split = take<kd_split>(from, parts);
    b->bin = take<uint32_t>(from, (refs / large + 1) * bins);
    b->side = take<uint64_t>(from, refs);
    b->side_sum = take<uint64_t>(from, refs);
    b->made = take<uint64_t>(from, parts);
    b->made_sum = take<uint64_t>(from, parts);
    b->state_next = take<level>(from, 1);
    b->node = take<kd_node>(from, b->most.nodes);
    b->name = take<uint32_t>(from, b->most.items);
    *sums = device_take(from, sum_bytes);
    return from->used;
}

bool sum(build *b, const level *now, void *room, size_t bytes, brume_error *err)
{
    return device_check(
               tree_sum(b->side, b->side_sum, now->refs + 1, room, bytes),
               "building the kd-tree", err) &&
           device_check(
               tree_sum(b->made, b->made_sum, now->parts + 1, room, bytes),
               "building the kd-tree", err);
}

bool go_down(build *b, level *now, void *room, size_t bytes, brume_error *err)
{
    cudaMemsetAsync(b->state_next, 0, sizeof(level));
    if (now->largest >= large) {
        cudaMemsetAsync(b->bin, 0, (now->refs / large + 1) * bins * 4);
        fill_large<<<blocks(now->refs, large), block_size>>>(*b, *now);
    }
    find_splits<<<blocks(now->parts + 1, warps), block_size>>>(*b, *now);
    count_sides<<<blocks(now->refs + 1, block_size), block_size>>>(*b, *now);
    if (!sum(b, now, room, bytes, err))
        return false;
    if (now->refs > 0)
        move_refs<<<blocks(now->refs, block_size), block_size>>>(*b, *now);
    make_level<<<blocks(now->parts + 1, block_size), block_size>>>(*b, *now);
    swap(&b->now, &b->next);
    swap(&b->ref, &b->ref_next);
    swap(&b->owner, &b->owner_next);
    return device_check(cudaGetLastError(), "building the kd-tree", err) &&
           device_check(cudaMemcpy(now, b->state_next, sizeof *now,
                                   cudaMemcpyDeviceToHost),
                        "building the kd-tree", err);
}

bool has_room(const room *most, const level *now)
{
    return now->parts <= most->parts && now->refs <= most->refs &&
           now->nodes <= most->nodes && now->items <= most->items;
}

/* The tree where there was room for it, in an allocation of its size. */
bool keep(const build *b, const level *done, tree_kd *to, brume_error *err)
{
    tree_extent box;
    size_t nodes = done->nodes * sizeof(kd_node), items = done->items * 4;
    if (!device_arena_new(&to->arena, device_round(nodes) + device_round(items),
                          err))
        return false;
    to->node = take<kd_node>(&to->arena, done->nodes);
    to->item = take<uint32_t>(&to->arena, done->items);
    to->nodes = done->nodes;
    to->items = done->items;
    bool good = device_check(cudaMemcpy(to->node, b->node, nodes,
                                        cudaMemcpyDeviceToDevice),
                             "building the kd-tree", err) &&
                device_check(cudaMemcpy(to->item, b->name, items,
                                        cudaMemcpyDeviceToDevice),
                             "building the kd-tree", err) &&
                device_check(cudaMemcpy(&box, b->extent, sizeof box,
                                        cudaMemcpyDeviceToHost),
                             "building the kd-tree", err);
    for (int k = 0; good && k < 3; k++) {
        to->box.lo[k] = tree_from_ordered(box.lo[k]);
        to->box.hi[k] = tree_from_ordered(box.hi[k]);
    }
    return good;
}

/* Down to the last level; *fits: there was room for it. */
bool build_all(const tree_items *items, build *b, tree_kd *to, bool *fits,
               brume_error *err)
{
    device_arena count = {}, scratch = {};
    size_t bytes = tree_sort_bytes(static_cast<uint32_t>(b->most.refs) + 1);
    void *room;
    if (!device_arena_new(&scratch, lay_out(b, &count, bytes, &room), err))
        return false;
    lay_out(b, &scratch, bytes, &room);
    tree_clear_extent(b->extent);
    tree_find_bounds(items, &b->bounds, b->extent, false);
    begin<<<blocks(b->count, block_size), block_size>>>(*b);
    level now = {1, b->count, 1, 0, b->count};
    bool good = true;
    *fits = true;
    while (good && *fits && now.parts > 0) {
        good = go_down(b, &now, room, bytes, err);
        *fits = has_room(&b->most, &now);
    }
    good = good && (!*fits || keep(b, &now, to, err));
    device_arena_free(&scratch);
    return good;
}

}

cudaError_t tree_load_kd(uint32_t count)
{
    tree_sort_bytes(count);
    cudaError_t code = tree_load_bounds();
    return code ? code
                : tree_load(fill_large, find_splits, count_sides, move_refs,
                            make_level, begin);
}

bool tree_build_kd(const tree_items *items, tree_kd *to, brume_error *err)
{
    build b = {};
    bool fits = false;
    b.count = tree_count(items);
    b.deepest = kd_deepest(b.count);
    for (size_t times = 1; !fits; times *= 2) {
        size_t n = b.count * times + 1024;
        b.most = {2 * n, 4 * n, 6 * n, 8 * n};
        if (8 * n > UINT32_MAX)
            return brume_fail(err, BRUME_ERR_LIMIT,
                              "the kd-tree has more than 2^32 references");
        if (!build_all(items, &b, to, &fits, err))
            return false;
    }
    return true;
}
