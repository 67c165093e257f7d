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

/* With room for the tree behind those that the host has built. */
layout bvh_layout(const flat *f)
{
    size_t n = order_count(f);
    return {sizeof(bvh_node), f->bvh_count + 2 * n - 1, sizeof(uint32_t),
            f->bvh_items_count + n};
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

/* The host's part of the arrays is copied before. */
bool build_bvh(const cuda_state *s, const layout *l, void *base,
               resident_note *note, brume_error *err)
{
    const flat *f = s->frame.flat;
    uint32_t n = static_cast<uint32_t>(order_count(f));
    bvh_node *node = static_cast<bvh_node *>(base);
    uint32_t *name = names_of(l, base);
    device_arena scratch = {};
    tree_items items;
    tree_shape shape = {};
    tree_bvh to = {node + f->bvh_count, name + f->bvh_items_count,
                   static_cast<uint32_t>(f->bvh_count),
                   static_cast<uint32_t>(f->bvh_items_count)};
    size_t bytes = tree_bvh_bytes(n) +
                   device_round(f->order->shapes * sizeof(bvh_item));
    bool good = device_arena_new(&scratch, bytes, err) &&
                send_items(s, &scratch, &items, err) &&
                device_check(cudaMemcpy(node, f->bvh,
                                        f->bvh_count * sizeof *node,
                                        cudaMemcpyHostToDevice),
                             "uploading bvh", err) &&
                device_check(cudaMemcpy(name, f->bvh_items,
                                        f->bvh_items_count * sizeof *name,
                                        cudaMemcpyHostToDevice),
                             "uploading bvh_items", err) &&
                tree_build_bvh(&items, &to, BVH_STACK - 1, &scratch, &shape,
                               err);
    note->count[0] = f->bvh_count + shape.nodes;
    note->count[1] = l->names;
    device_arena_free(&scratch);
    return good;
}

bool build_kd(cuda_state *s, resident_note *note, brume_error *err)
{
    const flat *f = s->frame.flat;
    device_arena scratch = {};
    tree_items items;
    bool good = device_arena_new(
                    &scratch, device_round(f->order->shapes * sizeof(bvh_item)),
                    err) &&
                send_items(s, &scratch, &items, err) &&
                tree_build_kd(&items, &s->kd, err);
    device_arena_free(&scratch);
    note->count[0] = s->kd.nodes;
    note->count[1] = s->kd.items;
    note->box = s->kd.box;
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

/* Into memory that stays, or the frame's. */
bool place_bvh(cuda_state *s, bool stays, uint64_t key, brume_error *err)
{
    layout l = bvh_layout(s->frame.flat);
    resident_note note = {};
    void *base = stays ? resident_room(s->kept, key, bytes_of(&l), err)
                       : device_take(&s->arena, bytes_of(&l));
    if (!base || !build_bvh(s, &l, base, &note, err))
        return false;
    if (stays)
        resident_say(s->kept, key, &note);
    point_at(s, &l, base, &note);
    return true;
}

/* The frame's own tree is copied to memory that stays. */
bool place_kd(cuda_state *s, bool stays, uint64_t key, brume_error *err)
{
    resident_note note = {};
    if (!build_kd(s, &note, err))
        return false;
    layout l = {sizeof(kd_node), note.count[0], sizeof(uint32_t),
                note.count[1]};
    void *base = s->kd.arena.base;
    if (stays) {
        base = resident_room(s->kept, key, bytes_of(&l), err);
        if (!base ||
            !device_check(cudaMemcpy(base, s->kd.arena.base, bytes_of(&l),
                                     cudaMemcpyDeviceToDevice),
                          "keeping the kd-tree", err))
            return false;
        resident_say(s->kept, key, &note);
        device_arena_free(&s->kd.arena);
    }
    point_at(s, &l, base, &note);
    return true;
}

}

size_t tree_scene_bytes(const cuda_state *s)
{
    const flat *f = s->frame.flat;
    if (!f->order || f->order->tree == BRUME_TREE_KD)
        return 0;
    layout l = bvh_layout(f);
    return bytes_of(&l);
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
        layout l = kd ? layout{sizeof(kd_node), note.count[0], sizeof(uint32_t),
                               note.count[1]}
                      : bvh_layout(f);
        point_at(s, &l, there, &note);
        resident_tree(s->kept, false);
        return true;
    }
    resident_tree(s->kept, true);
    device_clock_mark(&s->clock, 0);
    bool good = kd ? place_kd(s, stays, key, err)
                   : place_bvh(s, stays, key, err);
    return good && device_clock_stop(&s->clock, 1, "building the tree", err) &&
           device_clock_add(&s->clock, 0, &s->spent.tree);
}
