#define SHOOT_KERNEL shoot_own
#include "tests/gpu/shoot_kernel.cuh"
#include "core/cuda/tree.cuh"
#include <algorithm>
#include <vector>

struct shoot {
    flat_scene scene; /* its pointers are the device's              */
    std::vector<void *> held;
    tree_kd kd;
    bool built;
};

namespace
{

/* Device memory that goes with the scene. */
template <typename type> type *hold(shoot *s, size_t count, brume_error *err)
{
    void *to = nullptr;
    if (!device_check(cudaMalloc(&to, count * sizeof(type) + 1), "a test", err))
        return nullptr;
    s->held.push_back(to);
    return static_cast<type *>(to);
}

template <typename type>
const type *send(shoot *s, const type *from, size_t count, brume_error *err)
{
    type *to = hold<type>(s, count, err);
    if (!to || !device_check(cudaMemcpy(to, from, count * sizeof(type),
                                        cudaMemcpyHostToDevice),
                             "a test", err))
        return nullptr;
    return to;
}

template <typename type>
type *fetch(const type *from, size_t count, brume_error *err)
{
    type *to = static_cast<type *>(malloc(count * sizeof(type) + 1));
    device_check(
        cudaMemcpy(to, from, count * sizeof(type), cudaMemcpyDeviceToHost),
        "a test", err);
    return to;
}

/* Runs what is given so many times; the median of its milliseconds. */
template <typename work>
bool time_it(int times, double *milliseconds, work what, brume_error *err)
{
    std::vector<float> took;
    cudaEvent_t from, to;
    cudaEventCreate(&from);
    cudaEventCreate(&to);
    for (int i = 0; i < times; i++) {
        float t = 0.0f;
        cudaEventRecord(from);
        if (!what())
            return false;
        cudaEventRecord(to);
        if (!device_check(cudaEventSynchronize(to), "a test", err))
            return false;
        cudaEventElapsedTime(&t, from, to);
        took.push_back(t);
    }
    cudaEventDestroy(from);
    cudaEventDestroy(to);
    std::sort(took.begin(), took.end());
    *milliseconds = took[took.size() / 2];
    return true;
}

tree_items items_of(const shoot *s)
{
    tree_items items = {};
    items.triangle = s->scene.triangles;
    items.triangles = static_cast<uint32_t>(s->scene.triangles_count);
    items.name = static_cast<uint32_t>(s->scene.shapes_count);
    return items;
}

bool build_bvh(shoot *s, int places, int times, double *milliseconds,
               bool *even, brume_error *err)
{
    tree_items items = items_of(s);
    uint32_t n = tree_count(&items);
    device_arena scratch = {};
    tree_binary binary;
    tree_bvh to = {hold<bvh_node>(s, n, err), hold<uint32_t>(s, n, err), 0, 0};
    if (!to.node || !to.item ||
        !device_arena_new(&scratch, tree_bvh_bytes(n), err))
        return false;
    bool good = time_it(
        times, milliseconds,
        [&] {
            scratch.used = 0;
            return tree_build_binary(&items, places, &scratch, &binary, err) &&
                   tree_make_wide(&binary, &to, err);
        },
        err);
    device_arena_free(&scratch);
    s->scene.bvh = to.node;
    s->scene.bvh_count = binary.nodes;
    s->scene.bvh_items = to.item;
    s->scene.bvh_items_count = n;
    s->scene.bvh_root = 0;
    *even = binary.even;
    return good;
}

bool build_kd(shoot *s, int times, double *milliseconds, brume_error *err)
{
    tree_items items = items_of(s);
    bool good = time_it(
        times, milliseconds,
        [&] {
            device_arena_free(&s->kd.arena);
            return tree_build_kd(&items, &s->kd, err);
        },
        err);
    s->scene.kd = s->kd.node;
    s->scene.kd_items = s->kd.item;
    s->scene.kd_count = s->kd.nodes;
    s->scene.kd_items_count = s->kd.items;
    s->scene.kd_box = s->kd.box;
    return good;
}

}

shoot *shoot_new(const flat *flat, brume_error *err)
{
    shoot *s = new shoot();
    s->scene = flat->view;
#define X(type, name)                                                          \
    s->scene.name = send(s, flat->view.name, flat->view.name##_count, err);
    SCENE_ARRAYS(X)
#undef X
    if (err->code == BRUME_OK)
        return s;
    shoot_free(s);
    return nullptr;
}

void shoot_free(shoot *s)
{
    for (void *held : s->held)
        cudaFree(held);
    device_arena_free(&s->kd.arena);
    delete s;
}

bool shoot_build(shoot *s, shoot_tree tree, int places, int times,
                 double *milliseconds, bool *even, brume_error *err)
{
    *even = false;
    return tree == SHOOT_BVH
               ? build_bvh(s, places, times, milliseconds, even, err)
               : build_kd(s, times, milliseconds, err);
}

bool shoot_fetch(const shoot *s, flat *to, brume_error *err)
{
    const flat_scene *f = &s->scene;
    to->bvh = fetch(f->bvh, f->bvh_count, err);
    to->bvh_items = fetch(f->bvh_items, f->bvh_items_count, err);
    to->kd = fetch(f->kd, f->kd_count, err);
    to->kd_items = fetch(f->kd_items, f->kd_items_count, err);
    to->bvh_count = f->bvh_count;
    to->bvh_items_count = f->bvh_items_count;
    to->kd_count = f->kd_count;
    to->kd_items_count = f->kd_items_count;
    to->view.bvh_root = f->bvh_root;
    to->view.kd_box = f->kd_box;
    return err->code == BRUME_OK;
}

bool shoot_rays(shoot *s, bool shared, const bvh_ray *ray, size_t rays,
                ray_hit *hit, int times, double *milliseconds, brume_error *err)
{
    const bvh_ray *from = send(s, ray, rays, err);
    ray_hit *to = hold<ray_hit>(s, rays, err);
    uint32_t count = static_cast<uint32_t>(rays);
    if (!from || !to)
        return false;
    return time_it(
               times, milliseconds,
               [&] {
                   (shared ? shoot_shared : shoot_own)(&s->scene, from, count,
                                                       to);
                   return device_check(cudaGetLastError(), "a test", err);
               },
               err) &&
           device_check(
               cudaMemcpy(hit, to, rays * sizeof *hit, cudaMemcpyDeviceToHost),
               "a test", err);
}
