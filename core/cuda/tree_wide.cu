/* Nodes of four children out of a binary tree on the device, as wide.h says. */
#include "core/cuda/tree.cuh"

namespace
{

const int block_size = 128;

unsigned blocks(uint32_t count)
{
    return (count + block_size - 1) / block_size;
}

/* The part of which a place's node is made: a root that is a leaf is the one
 * child of the node in the place that is free. */
__device__ __forceinline__ uint32_t part_of(const tree_binary *b, uint32_t i)
{
    return i == b->free ? b->root : b->count + i;
}

__device__ __forceinline__ uint32_t top_of(const tree_binary *b)
{
    return b->part[b->root].leaf ? b->free : b->root - b->count;
}

/* The way from the root down to a part, right turns as bits from the lowest on;
 * how many turns, or -1: it lies in a leaf. */
__device__ __forceinline__ int find_way(const tree_binary *b, uint32_t at,
                                        uint64_t *way)
{
    int turns = 0;
    *way = 0;
    for (; at != b->root; turns++) {
        uint32_t above = b->above[at];
        if (b->part[above].leaf)
            return -1;
        *way = *way << 1 | (b->part[above].child[1] == at ? 1u : 0u);
        at = above;
    }
    return turns;
}

__device__ __forceinline__ bool is_among(const uint32_t *child, int n,
                                         uint32_t at)
{
    bool is = false;
    for (int i = 0; i < BVH_WIDTH; i++)
        is = is || (i < n && child[i] == at);
    return is;
}

/* Places that a search has at the node made of a part; -1: none is made. All
 * nodes on the way from the root are opened for that. */
__device__ __forceinline__ int find_room(const tree_binary *b, uint32_t part,
                                         int places)
{
    uint32_t at = b->root, child[BVH_WIDTH];
    uint64_t way;
    int turns = find_way(b, part, &way);
    if (turns < 0)
        return -1;
    while (turns > 0) {
        int n = wide_open(b->part, at, places, child);
        do {
            if (turns == 0)
                return -1;
            at = b->part[at].child[way & 1];
            way >>= 1;
            turns--;
        } while (!is_among(child, n, at));
        places -= n - 1;
    }
    return places;
}

__global__ void __launch_bounds__(block_size)
    find_nodes(tree_binary b, int places)
{
    uint32_t i = blockIdx.x * block_size + threadIdx.x, child[BVH_WIDTH];
    if (i == b.count)
        b.made[i] = 0;
    if (i >= b.count)
        return;
    uint32_t part = part_of(&b, i), items = 0;
    bool top = i == top_of(&b), is = !b.part[part].leaf && i != b.free;
    int room = top ? places : is ? find_room(&b, part, places) : -1;
    b.made[i] = 0;
    b.room[i] = static_cast<uint8_t>(1 + room);
    if (room < 0)
        return;
    int n = wide_open(b.part, part, room, child);
    for (int k = 0; k < n; k++)
        items += b.part[child[k]].leaf ? b.part[child[k]].items : 0u;
    b.made[i] = UINT64_C(1) << 32 | items;
}

/* The root comes first. */
__device__ __forceinline__ uint32_t number_of(const tree_binary *b, uint32_t i)
{
    uint32_t before = static_cast<uint32_t>(b->before[i] >> 32);
    uint32_t top = top_of(b);
    return i == top ? 0u : before + (i < top ? 1u : 0u);
}

/* Lists the items below a leaf, in order; returns how many. */
__device__ __forceinline__ uint32_t list_items(const tree_binary *b,
                                               uint32_t id, uint32_t *name)
{
    uint32_t stack[BVH_LEAF], found = 0;
    for (int held = 1; held > 0;) {
        while (id >= b->count) {
            stack[held++] = b->part[id].child[1];
            id = b->part[id].child[0];
        }
        name[found++] = b->bounds.name[b->order[id]];
        if (--held > 0)
            id = stack[held];
    }
    return found;
}

__global__ void __launch_bounds__(block_size)
    make_nodes(tree_binary b, tree_bvh to)
{
    uint32_t i = blockIdx.x * block_size + threadIdx.x, child[BVH_WIDTH];
    if (i >= b.count || b.made[i] == 0)
        return;
    uint32_t item = static_cast<uint32_t>(b.before[i]);
    int n = wide_open(b.part, part_of(&b, i), b.room[i] - 1, child);
    bvh_node node;
    wide_clear(&node);
    for (int k = 0; k < n; k++) {
        uint32_t id = child[k], first, count = 0;
        if (b.part[id].leaf) {
            first = to.first + item;
            count = list_items(&b, id, to.item + item);
            item += count;
        } else {
            first = to.root + number_of(&b, id - b.count);
        }
        wide_put(&node, k, &b.box[id], first, count);
    }
    to.node[number_of(&b, i)] = node;
}

}

cudaError_t tree_load_wide()
{
    return tree_load(find_nodes, make_nodes);
}

bool tree_find_wide(tree_binary *b, int places, void *scratch, size_t bytes,
                    brume_error *err)
{
    const char *what = "making the BVH wide";
    uint64_t sum = 0;
    find_nodes<<<blocks(b->count + 1), block_size>>>(*b, places);
    if (!device_check(
            tree_sum(b->made, b->before, b->count + 1, scratch, bytes), what,
            err) ||
        !device_check(cudaMemcpy(&sum, b->before + b->count, sizeof sum,
                                 cudaMemcpyDeviceToHost),
                      what, err))
        return false;
    b->nodes = static_cast<uint32_t>(sum >> 32);
    return true;
}

bool tree_make_wide(const tree_binary *b, const tree_bvh *to, brume_error *err)
{
    make_nodes<<<blocks(b->count), block_size>>>(*b, *to);
    return device_check(cudaGetLastError(), "making the BVH wide", err);
}
