/* The tree of a scene that is left to the device: built once its triangles are
 * there, or that of a frame before where they are the same. */
#include "core/cuda/backend.cuh"
#include "core/cuda/resident.cuh"
#include "core/cuda/tree.cuh"
extern "C" {
#include "core/order.h"
#include "lib/hash.h"
}

namespace
{

/* Nodes and names, as they lie one behind the other. */
struct layout {
    size_t node, nodes, name, names; /* bytes of one, and how many         */
};

size_t bytes_of(const layout *l)
{
    return device_round(l->node * l->nodes) + device_round(l->name * l->names);
}

uint32_t *names_of(const layout *l, void *base)
{
    return reinterpret_cast<uint32_t *>(static_cast<char *>(base) +
                                        device_round(l->node * l->nodes));
}

/* What a tree is of; false: its triangles do not stay, so it is not kept. */
bool find_key(const cuda_state *s, uint64_t *key)
{
    const flat *f = s->frame.flat;
    const tree_order *order = f->order;
    if (!resident_hash(s->kept, s->job.scene.triangles, key))
        return false;
    *key = hash_bytes(*key, order->shape, order->shapes * sizeof *order->shape);
    *key = hash_bytes(*key, f->bvh, f->bvh_count * sizeof *f->bvh);
    *key = hash_bytes(*key, f->bvh_items,
                      f->bvh_items_count * sizeof *f->bvh_items);
    *key = hash_bytes(*key, &order->tree, sizeof order->tree);
    return true;
}

/* The items, their shapes on the device behind what the builder takes. */
bool send_items(const cuda_state *s, device_arena *scratch, tree_items *items,
                brume_error *err)
{
    const flat *f = s->frame.flat;
    size_t bytes = f->order->shapes * sizeof *f->order->shape;
    bvh_item *shape = static_cast<bvh_item *>(device_take(scratch, bytes));
    *items = {shape, s->job.scene.triangles,
              static_cast<uint32_t>(f->order->shapes),
              static_cast<uint32_t>(f->triangles_count),
              static_cast<uint32_t>(f->shapes_count)};
    return device_check(
        cudaMemcpy(shape, f->order->shape, bytes, cudaMemcpyHostToDevice),
        "uploading the shapes of a tree", err);
}

/* Memory for a tree: what stays, or the frame's own. NULL with err set. */
void *tree_memory(cuda_state *s, bool stays, uint64_t key, const layout *l,
                  brume_error *err)
{
    if (stays)
        return resident_room(s->kept, key, bytes_of(l), err);
    return device_arena_new(&s->tree, bytes_of(l), err) ? s->tree.base
                                                        : nullptr;
}

/* The host's trees, behind which the device's goes. */
bool send_trees(const flat *f, bvh_node *node, uint32_t *name, brume_error *err)
{
    return device_check(cudaMemcpy(node, f->bvh, f->bvh_count * sizeof *node,
                                   cudaMemcpyHostToDevice),
                        "uploading bvh", err) &&
           device_check(cudaMemcpy(name, f->bvh_items,
                                   f->bvh_items_count * sizeof *name,
                                   cudaMemcpyHostToDevice),
                        "uploading bvh_items", err);
}

bool build_kd(const cuda_state *s, tree_kd *to, resident_note *note,
              brume_error *err)
{
    const flat *f = s->frame.flat;
    device_arena scratch = {};
    tree_items items;
    bool good = device_arena_new(
                    &scratch, device_round(f->order->shapes * sizeof(bvh_item)),
                    err) &&
                send_items(s, &scratch, &items, err) &&
                tree_build_kd(&items, to, err);
    device_arena_free(&scratch);
    note->count[0] = to->nodes;
    note->count[1] = to->items;
    note->box = to->box;
    return good;
}

void point_at(cuda_state *s, const layout *l, void *base,
              const resident_note *note)
{
    flat_scene *to = &s->job.scene;
    if (s->frame.flat->order->tree == BRUME_TREE_KD) {
        to->kd = static_cast<const kd_node *>(base);
        to->kd_items = names_of(l, base);
        to->kd_count = note->count[0];
        to->kd_items_count = note->count[1];
        to->kd_box = note->box;
        return;
    }
    to->bvh = static_cast<const bvh_node *>(base);
    to->bvh_items = names_of(l, base);
    to->bvh_root = static_cast<int32_t>(s->frame.flat->bvh_count);
    to->bvh_count = note->count[0];
    to->bvh_items_count = note->count[1];
}

/* Where the tree goes is taken when it is known how large it is. */
bool make_bvh(cuda_state *s, bool stays, uint64_t key, const tree_binary *b,
              brume_error *err)
{
    const flat *f = s->frame.flat;
    layout l = {sizeof(bvh_node), f->bvh_count + b->nodes, sizeof(uint32_t),
                f->bvh_items_count + b->count};
    resident_note note = {};
    note.count[0] = l.nodes;
    note.count[1] = l.names;
    void *base = tree_memory(s, stays, key, &l, err);
    if (!base)
        return false;
    bvh_node *node = static_cast<bvh_node *>(base);
    uint32_t *name = names_of(&l, base);
    tree_bvh to = {node + f->bvh_count, name + f->bvh_items_count,
                   static_cast<uint32_t>(f->bvh_count),
                   static_cast<uint32_t>(f->bvh_items_count)};
    if (!send_trees(f, node, name, err) || !tree_make_wide(b, &to, err))
        return false;
    if (stays)
        resident_say(s->kept, key, &note);
    point_at(s, &l, base, &note);
    return true;
}

bool place_bvh(cuda_state *s, bool stays, uint64_t key, brume_error *err)
{
    const flat *f = s->frame.flat;
    uint32_t n = static_cast<uint32_t>(order_count(f));
    device_arena scratch = {};
    tree_items items;
    tree_binary binary;
    size_t bytes = tree_bvh_bytes(n) +
                   device_round(f->order->shapes * sizeof(bvh_item));
    bool good = device_arena_new(&scratch, bytes, err) &&
                send_items(s, &scratch, &items, err) &&
                tree_build_binary(&items, BVH_STACK - 1, &scratch, &binary,
                                  err) &&
                make_bvh(s, stays, key, &binary, err);
    device_arena_free(&scratch);
    return good;
}

/* The builder's own memory, or a copy that stays. */
bool place_kd(cuda_state *s, bool stays, uint64_t key, brume_error *err)
{
    resident_note note = {};
    tree_kd kd = {};
    if (!build_kd(s, &kd, &note, err)) {
        device_arena_free(&kd.arena);
        return false;
    }
    layout l = {sizeof(kd_node), note.count[0], sizeof(uint32_t),
                note.count[1]};
    s->tree = kd.arena;
    void *base = s->tree.base;
    if (stays) {
        base = resident_room(s->kept, key, bytes_of(&l), err);
        if (!base || !device_check(cudaMemcpy(base, s->tree.base, bytes_of(&l),
                                              cudaMemcpyDeviceToDevice),
                                   "keeping the kd-tree", err))
            return false;
        resident_say(s->kept, key, &note);
        device_arena_free(&s->tree);
    }
    point_at(s, &l, base, &note);
    return true;
}

cudaError_t load(const flat *f)
{
    uint32_t n = static_cast<uint32_t>(order_count(f));
    if (f->order->tree == BRUME_TREE_KD)
        return tree_load_kd(n);
    cudaError_t code = tree_load_binary(n);
    return code ? code : tree_load_wide();
}

}

bool tree_scene_build(cuda_state *s, brume_error *err)
{
    const flat *f = s->frame.flat;
    uint64_t key = 0;
    resident_note note;
    if (!f->order)
        return true;
    bool kd = f->order->tree == BRUME_TREE_KD, stays = find_key(s, &key);
    void *there = stays ? resident_find(s->kept, key, &note) : nullptr;
    if (there) {
        layout l = {kd ? sizeof(kd_node) : sizeof(bvh_node), note.count[0],
                    sizeof(uint32_t), note.count[1]};
        point_at(s, &l, there, &note);
        resident_tree(s->kept, false);
        return true;
    }
    resident_tree(s->kept, true);
    if (!device_check(load(f), "opening", err))
        return false;
    device_clock_mark(&s->clock, 0);
    bool good = kd ? place_kd(s, stays, key, err)
                   : place_bvh(s, stays, key, err);
    return good && device_clock_stop(&s->clock, 1, "building the tree", err) &&
           device_clock_add(&s->clock, 0, &s->spent.tree);
}
