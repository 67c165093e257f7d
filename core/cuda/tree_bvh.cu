/* The BVH built on the device: H-PLOC (Benthin, Meister, Barczak, Mehalwal,
 * Tsakok, Kensler 2024), made so that the tree does not depend on which thread
 * comes first; leaves of several items where rays cost less by them. */
#include "core/cuda/tree.cuh"

namespace
{

const int block_size = 128, warp_size = LBVH_WARP;
const int warps = block_size / warp_size;
const uint32_t none = ~0u;
const unsigned all = ~0u;

/* A cluster as it lies in memory, in parts of 16 bytes. */
struct stored {
    float4 lo_cost, hi_place;
    uint4 rest; /* children, items and leaf, depth             */
};

struct build {
    uint32_t count;
    tree_bounds bounds;
    tree_extent *extent;
    uint64_t *code;
    uint32_t *order;  /* items by their codes                        */
    stored *cluster;  /* by id: 2 count                              */
    uint32_t *parent; /* per gap between items: who was here first   */
    uint32_t *row;    /* ids of what is left to a node, at its first */
    uint32_t *root;   /* its id                                      */
    uint8_t *dead;    /* inner nodes inside of leaves                */
    uint64_t *made;   /* per inner node: pairs, and items of leaves  */
    uint64_t *before; /* the sums of these                           */
    bool even;
};

__device__ __forceinline__ void put(stored *to, const lbvh_cluster *c,
                                    uint32_t left, uint32_t right)
{
    to->lo_cost = make_float4(c->box.lo[0], c->box.lo[1], c->box.lo[2],
                              c->cost);
    to->hi_place = make_float4(c->box.hi[0], c->box.hi[1], c->box.hi[2],
                               __uint_as_float(c->place));
    to->rest = make_uint4(
        left, right, static_cast<uint32_t>(c->items) | c->leaf << 8, c->depth);
}

/* Past the first cache, which may hold what was there before. */
__device__ __forceinline__ lbvh_cluster get(const stored *from, uint32_t id)
{
    lbvh_cluster c;
    float4 lo = __ldcg(&from->lo_cost), hi = __ldcg(&from->hi_place);
    uint4 rest = __ldcg(&from->rest);
    c.box.lo[0] = lo.x;
    c.box.lo[1] = lo.y;
    c.box.lo[2] = lo.z;
    c.box.hi[0] = hi.x;
    c.box.hi[1] = hi.y;
    c.box.hi[2] = hi.z;
    c.cost = lo.w;
    c.place = __float_as_uint(hi.w);
    c.items = static_cast<uint8_t>(rest.z);
    c.leaf = static_cast<uint8_t>(rest.z >> 8);
    c.depth = static_cast<uint16_t>(rest.w);
    c.id = id;
    return c;
}

__device__ __forceinline__ lbvh_box shuffle(const lbvh_box *b, int lane)
{
    lbvh_box out;
    for (int k = 0; k < 3; k++) {
        out.lo[k] = __shfl_sync(all, b->lo[k], lane);
        out.hi[k] = __shfl_sync(all, b->hi[k], lane);
    }
    return out;
}

__device__ __forceinline__ lbvh_cluster shuffle(const lbvh_cluster *c, int lane)
{
    lbvh_cluster out;
    uint32_t small = static_cast<uint32_t>(c->items) | c->leaf << 8 |
                     static_cast<uint32_t>(c->depth) << 16;
    out.box = shuffle(&c->box, lane);
    out.id = __shfl_sync(all, c->id, lane);
    out.place = __shfl_sync(all, c->place, lane);
    out.cost = __shfl_sync(all, c->cost, lane);
    small = __shfl_sync(all, small, lane);
    out.items = static_cast<uint8_t>(small);
    out.leaf = static_cast<uint8_t>(small >> 8);
    out.depth = static_cast<uint16_t>(small >> 16);
    return out;
}

/* ---- before the hierarchy ----------------------------------------------- */

__global__ void __launch_bounds__(block_size) find_codes(build b)
{
    uint32_t i = blockIdx.x * block_size + threadIdx.x;
    if (i >= b.count)
        return;
    float lo[3], hi[3], centre[3];
    const lbvh_box *box = &b.bounds.box[i];
    for (int k = 0; k < 3; k++) {
        lo[k] = tree_from_ordered(b.extent->lo[k]);
        hi[k] = tree_from_ordered(b.extent->hi[k]);
        centre[k] = 0.5f * (box->lo[k] + box->hi[k]);
    }
    b.code[i] = lbvh_code(centre, lo, lbvh_scale(lo, hi));
    b.order[i] = i;
}

/* Items become clusters in the order of their codes; codes that are numbers
 * halve what is below every node. */
__global__ void __launch_bounds__(block_size) begin(build b)
{
    uint32_t i = blockIdx.x * block_size + threadIdx.x;
    if (i >= b.count)
        return;
    lbvh_box box = b.bounds.box[b.order[i]];
    lbvh_cluster c = lbvh_item(&box, i);
    put(&b.cluster[i], &c, none, none);
    b.row[i] = i;
    b.parent[i] = none;
    b.made[i] = 0;
    b.dead[i] = 0;
    if (b.even)
        b.code[i] = i;
    if (i == 0)
        *b.root = 0;
}

/* ---- hierarchy ---------------------------------------------------------- */

struct range {
    uint32_t left, right, split; /* items; the right part's first          */
};

/* The ids that a node of items first ... end - 1 left to the one above it come
 * behind the `have` that are there. */
__device__ __forceinline__ int take_row(const build *b, uint32_t first,
                                        uint32_t end, int have, uint32_t *id)
{
    int i = static_cast<int>(threadIdx.x % warp_size) - have;
    int most = min(end - first, static_cast<uint32_t>(LBVH_LEFT));
    bool mine = i >= 0 && i < most;
    if (mine)
        *id = __ldcg(&b->row[first + i]);
    return have + __popc(__ballot_sync(all, mine && *id != none));
}

/* The best partner of a thread's cluster among those nearby. */
__device__ __forceinline__ int find_partner(const lbvh_box *box, int count,
                                            bool even)
{
    int lane = threadIdx.x % warp_size;
    uint64_t best = ~UINT64_C(0);
    for (int k = 1; k <= LBVH_REACH; k++) {
        lbvh_box other = shuffle(box, lane + k);
        uint64_t d = ~UINT64_C(0);
        if (lane + k < count)
            d = lbvh_distance(box, &other, lane, lane + k, even);
        best = d < best ? d : best;
        d = __shfl_up_sync(all, d, k);
        if (lane >= k)
            best = d < best ? d : best;
    }
    return lane < count ? static_cast<int>(lbvh_partner(best, lane)) : lane;
}

/* Merges those that are each other's best, and moves up the rest. */
__device__ __forceinline__ int merge_pairs(const build *b, lbvh_cluster *c,
                                           int count, uint8_t *from)
{
    int lane = threadIdx.x % warp_size;
    int partner = find_partner(&c->box, count, b->even);
    bool mutual = __shfl_sync(all, partner, partner) == lane && lane < count;
    lbvh_cluster other = shuffle(c, partner);
    if (mutual && lane < partner) {
        uint32_t left = c->id;
        *c = lbvh_merge(c, &other, b->count);
        put(&b->cluster[c->id], c, left, other.id);
    }
    bool stays = lane < count && !(mutual && partner < lane);
    unsigned stay = __ballot_sync(all, stays);
    if (stays)
        from[__popc(stay & ((1u << lane) - 1u))] = static_cast<uint8_t>(lane);
    __syncwarp();
    int kept = __popc(stay);
    *c = shuffle(c, lane < kept ? from[lane] : lane);
    __syncwarp();
    return kept;
}

/* What both parts of a node have left becomes LBVH_LEFT clusters or fewer, or
 * one, the root. */
__device__ __forceinline__ void merge_node(const build *b, const range *r,
                                           uint8_t *from)
{
    int lane = threadIdx.x % warp_size;
    uint32_t id = none;
    int begun = take_row(b, r->left, r->split, 0, &id);
    if (lane >= begun)
        id = none;
    begun = take_row(b, r->split, r->right + 1, begun, &id);
    bool whole = r->right - r->left == b->count - 1;
    int count = begun, most = whole ? 1 : LBVH_LEFT;
    lbvh_cluster c = get(&b->cluster[lane < count ? id : 0], id);
    while (count > most)
        count = merge_pairs(b, &c, count, from);
    if (lane < begun)
        b->row[r->left + lane] = lane < count ? c.id : none;
    if (whole && lane == 0)
        *b->root = c.id;
    __threadfence();
    __syncwarp();
}

/* Goes to the parent; false: its other part is not done yet, whose thread will
 * go on instead. */
__device__ __forceinline__ bool go_up(const build *b, range *r)
{
    uint32_t other;
    if (lbvh_is_left(b->code, b->count, r->left, r->right)) {
        other = atomicExch(&b->parent[r->right], r->left);
        r->split = r->right + 1;
        if (other != none)
            r->right = other;
    } else {
        other = atomicExch(&b->parent[r->left - 1], r->right);
        r->split = r->left;
        if (other != none)
            r->left = other;
    }
    __threadfence();
    return other != none;
}

/* A thread goes up from its item; all of a warp merge what one of them finds
 * to be large enough. */
__global__ void __launch_bounds__(block_size) merge_all(build b)
{
    __shared__ uint8_t from[warps][warp_size];
    uint32_t i = blockIdx.x * block_size + threadIdx.x;
    range r = {i, i, i};
    bool active = i < b.count;
    while (__any_sync(all, active)) {
        active = active && go_up(&b, &r);
        uint32_t size = r.right - r.left + 1;
        bool ready = active && (size > LBVH_LEFT || size == b.count);
        unsigned wait = __ballot_sync(all, ready);
        for (; wait != 0u; wait &= wait - 1u) {
            int lane = __ffs(wait) - 1;
            range at = {__shfl_sync(all, r.left, lane),
                        __shfl_sync(all, r.right, lane),
                        __shfl_sync(all, r.split, lane)};
            merge_node(&b, &at, from[threadIdx.x / warp_size]);
        }
        active = active && size < b.count;
    }
}

/* ---- nodes -------------------------------------------------------------- */

__device__ __forceinline__ bool is_leaf(const build *b, uint32_t id)
{
    return (b->cluster[id].rest.z >> 8) != 0;
}

/* The items below a leaf, in order, at most LBVH_LEAF; `dead`, if there is
 * one, gets a mark for the inner nodes among them. */
__device__ __forceinline__ uint32_t list_items(const build *b, uint32_t id,
                                               uint32_t *item, uint8_t *dead)
{
    uint32_t stack[LBVH_LEAF], found = 0;
    int held = 0;
    for (;;) {
        if (id >= b->count) {
            uint4 rest = b->cluster[id].rest;
            stack[held++] = rest.y;
            id = rest.x;
            if (dead && id >= b->count)
                dead[id - b->count] = 1;
            if (dead && rest.y >= b->count)
                dead[rest.y - b->count] = 1;
            continue;
        }
        item[found++] = id;
        if (held == 0)
            return found;
        id = stack[--held];
    }
}

/* A place that no merge took holds no node: its cluster is no one's. */
__global__ void __launch_bounds__(block_size) find_dead(build b)
{
    uint32_t i = blockIdx.x * block_size + threadIdx.x;
    uint32_t place = __float_as_uint(b.cluster[*b.root].hi_place.w);
    uint32_t item[LBVH_LEAF];
    if (i >= b.count || i == place || !is_leaf(&b, b.count + i))
        return;
    list_items(&b, b.count + i, item, b.dead);
}

/* How many names the leaves have that are this node's children. */
__global__ void __launch_bounds__(block_size) count_made(build b)
{
    uint32_t i = blockIdx.x * block_size + threadIdx.x;
    uint32_t place = __float_as_uint(b.cluster[*b.root].hi_place.w);
    if (i >= b.count || i == place || b.dead[i] || is_leaf(&b, b.count + i))
        return;
    uint4 rest = b.cluster[b.count + i].rest;
    uint64_t items = 0;
    uint32_t child[2] = {rest.x, rest.y};
    for (int k = 0; k < 2; k++)
        if (is_leaf(&b, child[k]))
            items += b.cluster[child[k]].rest.z & 255u;
    b.made[i] = UINT64_C(1) << 32 | items;
}

/* Makes the node of a cluster, whose names, if it is a leaf, begin at *name. */
__device__ __forceinline__ void make_node(const build *b, const tree_bvh *to,
                                          uint32_t id, bvh_node *node,
                                          uint32_t *name)
{
    const stored *c = &b->cluster[id];
    float4 lo = c->lo_cost, hi = c->hi_place;
    bvh_node out = {{lo.x, lo.y, lo.z}, 0, {hi.x, hi.y, hi.z}, 0};
    if (is_leaf(b, id)) {
        uint32_t item[LBVH_LEAF];
        out.count = list_items(b, id, item, nullptr);
        out.first = to->first + *name;
        for (uint32_t i = 0; i < out.count; i++)
            to->item[(*name)++] = b->bounds.name[b->order[item[i]]];
    } else {
        uint64_t before = b->before[id - b->count];
        out.first = to->root + 1 + 2 * static_cast<uint32_t>(before >> 32);
    }
    *node = out;
}

__global__ void __launch_bounds__(block_size)
    make_nodes(build b, tree_bvh to, tree_shape *shape)
{
    uint32_t i = blockIdx.x * block_size + threadIdx.x, root = *b.root;
    if (i >= b.count)
        return;
    uint64_t before = b.before[i];
    uint32_t name = static_cast<uint32_t>(before);
    if (b.made[i] != 0) {
        bvh_node *pair = to.node + 1 + 2 * (before >> 32);
        uint4 rest = b.cluster[b.count + i].rest;
        make_node(&b, &to, rest.x, &pair[0], &name);
        make_node(&b, &to, rest.y, &pair[1], &name);
    }
    if (i == b.count - 1) {
        uint32_t pairs = static_cast<uint32_t>((before + b.made[i]) >> 32);
        name = 0;
        make_node(&b, &to, root, to.node, &name);
        shape->depth = b.cluster[root].rest.w;
        shape->nodes = 1 + 2 * pairs;
    }
}

/* ---- all of it ---------------------------------------------------------- */

unsigned blocks(uint32_t count)
{
    return (count + block_size - 1) / block_size;
}

void link(const build *b)
{
    begin<<<blocks(b->count), block_size>>>(*b);
    if (b->count > 1)
        merge_all<<<blocks(b->count), block_size>>>(*b);
    find_dead<<<blocks(b->count), block_size>>>(*b);
    count_made<<<blocks(b->count), block_size>>>(*b);
}

template <typename type> type *take(device_arena *from, size_t count)
{
    return static_cast<type *>(device_take(from, count * sizeof(type)));
}

/* What is done to items again where their tree is too deep. */
bool finish(build *b, const tree_bvh *to, void *scratch, size_t bytes,
            tree_shape *shape, tree_shape *there, brume_error *err)
{
    link(b);
    if (!device_check(tree_sum(b->made, b->before, b->count, scratch, bytes),
                      "building the BVH", err))
        return false;
    make_nodes<<<blocks(b->count), block_size>>>(*b, *to, there);
    return device_check(cudaGetLastError(), "building the BVH", err) &&
           device_check(
               cudaMemcpy(shape, there, sizeof *shape, cudaMemcpyDeviceToHost),
               "building the BVH", err);
}

}

size_t tree_bvh_bytes(uint32_t count)
{
    size_t n = count;
    return device_round(n * sizeof(lbvh_box)) + 5 * device_round(4 * n) +
           4 * device_round(8 * n) + device_round(2 * n * sizeof(stored)) +
           device_round(n) + device_round(sizeof(tree_extent)) +
           device_round(sizeof(tree_shape)) + device_round(4) +
           device_round(tree_sort_bytes(count));
}

bool tree_build_bvh(const tree_items *items, const tree_bvh *to, int depth,
                    device_arena *scratch, tree_shape *shape, brume_error *err)
{
    uint32_t n = tree_count(items);
    size_t bytes = tree_sort_bytes(n);
    build b = {};
    b.count = n;
    b.bounds = {take<lbvh_box>(scratch, n), take<uint32_t>(scratch, n)};
    b.extent = take<tree_extent>(scratch, 1);
    uint64_t *code[2] = {take<uint64_t>(scratch, n),
                         take<uint64_t>(scratch, n)};
    uint32_t *order[2] = {take<uint32_t>(scratch, n),
                          take<uint32_t>(scratch, n)};
    b.cluster = take<stored>(scratch, 2 * static_cast<size_t>(n));
    b.parent = take<uint32_t>(scratch, n);
    b.row = take<uint32_t>(scratch, n);
    b.root = take<uint32_t>(scratch, 1);
    b.dead = take<uint8_t>(scratch, n);
    b.made = take<uint64_t>(scratch, n);
    b.before = take<uint64_t>(scratch, n);
    tree_shape *there = take<tree_shape>(scratch, 1);
    void *room = device_take(scratch, bytes);
    b.code = code[0];
    b.order = order[0];
    tree_clear_extent(b.extent);
    tree_find_bounds(items, &b.bounds, b.extent, true);
    find_codes<<<blocks(n), block_size>>>(b);
    if (!device_check(tree_sort(code, order, n, room, bytes),
                      "building the BVH", err))
        return false;
    b.code = code[0];
    b.order = order[0];
    if (!finish(&b, to, room, bytes, shape, there, err))
        return false;
    b.even = static_cast<int>(shape->depth) > depth;
    if (b.even && !finish(&b, to, room, bytes, shape, there, err))
        return false;
    shape->even = b.even;
    return true;
}
