/* Build and traversal of the trees, on three meshes, and whether all find the
 * same hits.
 *
 *     trees [RAYS [DIVISIONS]]
 *
 * RAYS, a million at first, for each mesh; the second is the first with each
 * triangle divided into four so many times, 4. Prints a table of CPU seconds;
 * status 1 where a hit differs. */
#include "tests/unit/tree_meshes.h"
#include <inttypes.h>
#include <stdio.h>
#include <time.h>

static double cpu_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

struct way {
    const char *name;
    enum tree tree;
    int stack;
};

static const struct way ways[] = {
    {"BVH", TREE_BVH, 1},
    {"kd-tree, stack 1", TREE_KD, 1},
    {"kd-tree, stack 2", TREE_KD, 2},
    {"kd-tree, stack 4", TREE_KD, 4},
    {"kd-tree, stack 8", TREE_KD, 8},
    {"kd-tree, stack 32", TREE_KD, 32},
    {"both, half each", TREE_BOTH, 4},
};
enum { WAYS = sizeof ways / sizeof *ways };

static ray_hit shoot(const struct flat *f, const bvh_ray *r)
{
    ray_hit after = hit_start(0.0f);
    return bvh_nearest(&f->view, r, &after, INFINITY);
}

static double time_rays(const struct flat *f, const bvh_ray *ray, size_t rays,
                        ray_hit *hit)
{
    double start = cpu_seconds();
    for (size_t i = 0; i < rays; i++)
        hit[i] = shoot(f, &ray[i]);
    return cpu_seconds() - start;
}

static uint64_t count_differences(const ray_hit *a, const ray_hit *b,
                                  size_t rays)
{
    uint64_t n = 0;
    for (size_t i = 0; i < rays; i++)
        n += !same_hit(&a[i], &b[i]);
    return n;
}

static double mebibytes(const struct flat *f)
{
    return (double)(f->bvh_count * sizeof *f->bvh +
                    f->bvh_items_count * sizeof *f->bvh_items +
                    f->kd_count * sizeof *f->kd +
                    f->kd_items_count * sizeof *f->kd_items) /
           1048576.0;
}

static uint64_t run(const char *name, const struct triangles *t, size_t rays)
{
    bvh_ray *ray = malloc(rays * sizeof *ray);
    ray_hit *hit = malloc(2 * rays * sizeof *hit);
    uint64_t wrong = 0;
    for (size_t i = 0; i < rays; i++)
        ray[i] = tree_ray(t, i);
    for (int w = 0; w < WAYS; w++) {
        struct brume_error err = {0};
        ray_hit *to = hit + (w ? rays : 0);
        double start = cpu_seconds();
        struct flat *f = tree_scene(t, ways[w].tree, ways[w].stack, &err);
        double build = cpu_seconds() - start;
        double shot = time_rays(f, ray, rays, to);
        uint64_t differ = count_differences(hit, to, rays);
        printf("| %s, %zu | %s | %.2f | %.1f | %.3f | %" PRIu64 " |\n", name,
               t->count, ways[w].name, build, mebibytes(f),
               1e-6 * (double)rays / shot, differ);
        fflush(stdout);
        wrong += differ;
        flat_free(f);
    }
    free(hit);
    free(ray);
    return wrong;
}

int main(int count, char **word)
{
    size_t rays = count > 1 ? (size_t)atoll(word[1]) : 1000000;
    int divisions = count > 2 ? atoi(word[2]) : 4;
    struct triangles spot = {NULL, 0}, fine, odd = triangles_degenerate(20000);
    struct brume_error err = {0};
    if (!triangles_load(&spot, "scenes/campfire/spot.ply", &err)) {
        fprintf(stderr, "trees: %s\n", err.text);
        return 5;
    }
    fine = triangles_divide(&spot);
    for (int i = 1; i < divisions; i++) {
        struct triangles finer = triangles_divide(&fine);
        free(fine.corner);
        fine = finer;
    }
    puts("| mesh, triangles | tree | build, CPU s | MiB | M rays/s | differ |\n"
         "| --- | --- | --- | --- | --- | --- |");
    uint64_t wrong = run("spot", &spot, rays) + run("divided", &fine, rays) +
                     run("degenerate", &odd, rays);
    free(spot.corner);
    free(fine.corner);
    free(odd.corner);
    return wrong ? 1 : 0;
}
