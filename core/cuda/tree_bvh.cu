/* The binary BVH built on the device: H-PLOC (Benthin, Meister, Barczak,
 * Mehalwal, Tsakok, Kensler 2024), made so that the tree does not depend on
 * which thread comes first; leaves of several items where rays cost less by
 * them. */
#include "core/cuda/tree.cuh"

namespace
{

const int block_size = 128, warp_size = LBVH_WARP;
const int warps = block_size / warp_size;
const uint32_t none = ~0u;
const unsigned all = ~0u;

/* What clusters have beside boxes and parts. */
struct alignas(16) rest {
    wide_cost cost;
    uint32_t place;
};

/* The root, which the host asks for. */
struct found_root {
    uint32_t id, place, depth;
};

struct build {
    tree_binary tree;
    tree_extent *extent;
    uint64_t *code;
    rest *more;       /* by id                                       */
    uint32_t *parent; /* per gap between items: who was here first   */
    uint32_t *row;    /* ids of what is left to a node, at its first */
    found_root *root;
    bool even;
};

/* Copies in as few words; what is read is past the first cache, which may hold
 * what was there before. */
template <typename word, typename type>
__device__ __forceinline__ void write(type *to, const type &from)
{
    word all[sizeof(type) / sizeof(word)];
    memcpy(all, &from, sizeof all);
    for (size_t i = 0; i < sizeof(type) / sizeof(word); i++)
        reinterpret_cast<word *>(to)[i] = all[i];
}

template <typename word, typename type>
__device__ __forceinline__ void read(type *to, const type *from)
{
    word all[sizeof(type) / sizeof(word)];
    for (size_t i = 0; i < sizeof(type) / sizeof(word); i++)
        all[i] = __ldcg(reinterpret_cast<const word *>(from) + i);
    memcpy(to, all, sizeof all);
}

__device__ __forceinline__ void put(const build *b, const lbvh_cluster *c,
                                    uint32_t left, uint32_t right)
{
    wide_part part = {{left, right}, c->items, c->leaf, c->split, c->depth};
    rest more = {c->cost, c->place};
    write<uint2>(&b->tree.box[c->id], c->box);
    write<uint32_t>(&b->tree.part[c->id], part);
    write<uint4>(&b->more[c->id], more);
}

__device__ __forceinline__ lbvh_cluster get(const build *b, uint32_t id)
{
    lbvh_cluster c;
    wide_part part;
    rest more;
    read<uint2>(&c.box, &b->tree.box[id]);
    read<uint32_t>(&part, &b->tree.part[id]);
    read<uint4>(&more, &b->more[id]);
    c.id = id;
    c.place = more.place;
    c.cost = more.cost;
    c.items = part.items;
    c.leaf = part.leaf;
    c.split = part.split;
    c.depth = part.depth;
    return c;
}

__device__ __forceinline__ bvh_box shuffle(const bvh_box *b, int lane)
{
    bvh_box out;
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
                     c->split << 16 | static_cast<uint32_t>(c->depth) << 24;
    out.box = shuffle(&c->box, lane);
    out.id = __shfl_sync(all, c->id, lane);
    out.place = __shfl_sync(all, c->place, lane);
    for (int i = 0; i < BVH_WIDTH - 1; i++)
        out.cost.as[i] = __shfl_sync(all, c->cost.as[i], lane);
    small = __shfl_sync(all, small, lane);
    out.items = static_cast<uint8_t>(small);
    out.leaf = static_cast<uint8_t>(small >> 8);
    out.split = static_cast<uint8_t>(small >> 16);
    out.depth = static_cast<uint8_t>(small >> 24);
    return out;
}

__device__ __forceinline__ void tell_root(const build *b, const lbvh_cluster *c)
{
    *b->root = {c->id, c->place, c->depth};
}

/* ---- before the hierarchy ----------------------------------------------- */

__global__ void __launch_bounds__(block_size) find_codes(build b)
{
    uint32_t i = blockIdx.x * block_size + threadIdx.x;
    if (i >= b.tree.count)
        return;
    float lo[3], hi[3], centre[3];
    const bvh_box *box = &b.tree.bounds.box[i];
    for (int k = 0; k < 3; k++) {
        lo[k] = tree_from_ordered(b.extent->lo[k]);
        hi[k] = tree_from_ordered(b.extent->hi[k]);
        centre[k] = 0.5f * (box->lo[k] + box->hi[k]);
    }
    b.code[i] = lbvh_code(centre, lo, lbvh_scale(lo, hi));
    b.tree.order[i] = i;
}

/* Items become clusters in the order of their codes; codes that are numbers
 * halve what is below every node. */
__global__ void __launch_bounds__(block_size) begin(build b)
{
    uint32_t i = blockIdx.x * block_size + threadIdx.x;
    if (i >= b.tree.count)
        return;
    bvh_box box = b.tree.bounds.box[b.tree.order[i]];
    lbvh_cluster c = lbvh_item(&box, i);
    put(&b, &c, none, none);
    b.row[i] = i;
    b.parent[i] = none;
    if (b.even)
        b.code[i] = i;
    if (b.tree.count == 1)
        tell_root(&b, &c);
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
__device__ __forceinline__ int find_partner(const bvh_box *box, int count,
                                            bool even)
{
    int lane = threadIdx.x % warp_size;
    uint64_t best = ~UINT64_C(0);
    for (int k = 1; k <= LBVH_REACH; k++) {
        bvh_box other = shuffle(box, lane + k);
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
        *c = lbvh_merge(c, &other, b->tree.count);
        put(b, c, left, other.id);
        b->tree.above[left] = b->tree.above[other.id] = c->id;
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
    bool whole = r->right - r->left == b->tree.count - 1;
    int count = begun, most = whole ? 1 : LBVH_LEFT;
    lbvh_cluster c = get(b, lane < count ? id : 0);
    while (count > most)
        count = merge_pairs(b, &c, count, from);
    if (lane < begun)
        b->row[r->left + lane] = lane < count ? c.id : none;
    if (whole && lane == 0)
        tell_root(b, &c);
    __threadfence();
    __syncwarp();
}

/* Goes to the parent; false: its other part is not done yet, whose thread will
 * go on instead. */
__device__ __forceinline__ bool go_up(const build *b, range *r)
{
    uint32_t other;
    if (lbvh_is_left(b->code, b->tree.count, r->left, r->right)) {
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
    bool active = i < b.tree.count;
    while (__any_sync(all, active)) {
        active = active && go_up(&b, &r);
        uint32_t size = r.right - r.left + 1;
        bool ready = active && (size > LBVH_LEFT || size == b.tree.count);
        unsigned wait = __ballot_sync(all, ready);
        for (; wait != 0u; wait &= wait - 1u) {
            int lane = __ffs(wait) - 1;
            range at = {__shfl_sync(all, r.left, lane),
                        __shfl_sync(all, r.right, lane),
                        __shfl_sync(all, r.split, lane)};
            merge_node(&b, &at, from[threadIdx.x / warp_size]);
        }
        active = active && size < b.tree.count;
    }
}

/* ---- all of it ---------------------------------------------------------- */

unsigned blocks(uint32_t count)
{
    return (count + block_size - 1) / block_size;
}

template <typename type> type *take(device_arena *from, size_t count)
{
    return static_cast<type *>(device_take(from, count * sizeof(type)));
}

/* What is done to items again where their tree is too deep. */
bool merge(const build *b, found_root *root, brume_error *err)
{
    uint32_t n = b->tree.count;
    begin<<<blocks(n), block_size>>>(*b);
    if (n > 1)
        merge_all<<<blocks(n), block_size>>>(*b);
    return device_check(cudaGetLastError(), "building the BVH", err) &&
           device_check(
               cudaMemcpy(root, b->root, sizeof *root, cudaMemcpyDeviceToHost),
               "building the BVH", err);
}

/* Its arrays, from the scratch. */
build take_build(device_arena *scratch, uint32_t n)
{
    build b = {};
    b.tree.count = n;
    b.tree.bounds = {take<bvh_box>(scratch, n), take<uint32_t>(scratch, n)};
    b.tree.box = take<bvh_box>(scratch, 2 * static_cast<size_t>(n));
    b.tree.part = take<wide_part>(scratch, 2 * static_cast<size_t>(n));
    b.tree.above = take<uint32_t>(scratch, 2 * static_cast<size_t>(n));
    b.tree.room = take<uint8_t>(scratch, n);
    b.tree.made = take<uint64_t>(scratch, n + UINT64_C(1));
    b.tree.before = take<uint64_t>(scratch, n + UINT64_C(1));
    b.extent = take<tree_extent>(scratch, 1);
    b.more = take<rest>(scratch, 2 * static_cast<size_t>(n));
    b.parent = take<uint32_t>(scratch, n);
    b.row = take<uint32_t>(scratch, n);
    b.root = take<found_root>(scratch, 1);
    return b;
}

}

size_t tree_bvh_bytes(uint32_t count)
{
    size_t n = count;
    return device_round(n * sizeof(bvh_box)) + 5 * device_round(4 * n) +
           2 * device_round(8 * n) + 2 * device_round(8 * (n + 1)) +
           device_round(n) + device_round(2 * n * sizeof(bvh_box)) +
           device_round(2 * n * sizeof(wide_part)) +
           device_round(2 * n * sizeof(rest)) + device_round(8 * n) +
           device_round(sizeof(tree_extent)) +
           device_round(sizeof(found_root)) +
           device_round(tree_sort_bytes(count + 1));
}

cudaError_t tree_load_binary(uint32_t count)
{
    tree_sort_bytes(count + 1);
    cudaError_t code = tree_load_bounds();
    return code ? code : tree_load(find_codes, begin, merge_all);
}

bool tree_build_binary(const tree_items *items, int places,
                       device_arena *scratch, tree_binary *to, brume_error *err)
{
    uint32_t n = tree_count(items);
    size_t bytes = tree_sort_bytes(n + 1);
    found_root root;
    build b = take_build(scratch, n);
    uint64_t *code[2] = {take<uint64_t>(scratch, n),
                         take<uint64_t>(scratch, n)};
    uint32_t *order[2] = {take<uint32_t>(scratch, n),
                          take<uint32_t>(scratch, n)};
    void *room = device_take(scratch, bytes);
    b.code = code[0];
    b.tree.order = order[0];
    tree_clear_extent(b.extent);
    tree_find_bounds(items, &b.tree.bounds, b.extent, true);
    find_codes<<<blocks(n), block_size>>>(b);
    if (!device_check(tree_sort(code, order, n, room, bytes),
                      "building the BVH", err))
        return false;
    b.code = code[0];
    b.tree.order = order[0];
    if (!merge(&b, &root, err))
        return false;
    b.even = static_cast<int>(root.depth) > places;
    if (b.even && !merge(&b, &root, err))
        return false;
    *to = b.tree;
    to->even = b.even;
    to->root = root.id;
    to->free = root.place;
    return tree_find_wide(to, places, room, bytes, err);
}
