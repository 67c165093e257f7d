/* Trees built on a GPU beside those built on the CPU, over meshes of all sorts:
 * whether rays find the same hits, whether the kd-trees are the same, how long
 * it takes to build them and to send rays through them.
 *
 *     trees [RAYS [TIMES [DIVISIONS]]]
 *
 * A million RAYS at each mesh, a quarter of them where its triangles are
 * degenerate, 20000 at small ones; medians of TIMES, 9; Spot's triangles
 * divided into four so many times, 4. Prints a table; status 1 where anything
 * differs. */
#include "tests/unit/tree_meshes.h"
#include "tests/gpu/shoot.h"
#include "lib/thread.h"
#include <inttypes.h>
#include <stdio.h>
#include <time.h>

static size_t rays = 1000000;
static int times = 9;
static uint64_t wrong;

static double cpu_milliseconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static void stop_at(const struct brume_error *err)
{
    if (err->code == BRUME_OK)
        return;
    fprintf(stderr, "trees: %s\n", err->text);
    exit(5);
}

/* ---- meshes ------------------------------------------------------------- */

/* So many triangles that are all the same. */
static struct triangles triangles_same(size_t count)
{
    struct triangles t = {NULL, 0};
    for (size_t i = 0; i < count; i++)
        triangles_add(&t, vec3_make(0.1f, 0.2f, 0.3f),
                      vec3_make(0.5f, 0.2f, 0.1f), vec3_make(0.2f, 0.6f, 0.3f));
    return t;
}

/* Each as far out, and as large, as the second power of the one before: what
 * makes trees that are built from below as deep as there are triangles. */
static struct triangles triangles_spread(size_t count)
{
    struct triangles t = {NULL, 0};
    for (size_t i = 0; i < count; i++) {
        float x = ldexpf(1.0f, -(int)(i % 100));
        triangles_add(&t, vec3_make(x, 0, 0), vec3_make(2 * x, x, 0),
                      vec3_make(x, 0, x));
    }
    return t;
}

/* The first so many. */
static struct triangles triangles_first(const struct triangles *from,
                                        size_t count)
{
    struct triangles t = {NULL, 0};
    for (size_t i = 0; i < count && i < from->count; i++)
        triangles_add(&t, from->corner[i][0], from->corner[i][1],
                      from->corner[i][2]);
    return t;
}

/* ---- trees -------------------------------------------------------------- */

/* Whether each of count items is named once. */
static bool names_all(const uint32_t *name, size_t names, size_t count)
{
    uint8_t *seen = calloc(count + 1, 1);
    bool good = names == count;
    for (size_t i = 0; i < names && good; i++) {
        good = name[i] >= 1 && name[i] <= count && !seen[name[i]];
        if (good)
            seen[name[i]] = 1;
    }
    free(seen);
    return good;
}

/* Names of two leaves; those of tests are listed from the last. */
static bool same_names(const uint32_t *a, const uint32_t *b, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (a[i] != b[count - 1 - i])
            return false;
    return true;
}

/* Whether two kd-trees are the same but for where they lie. */
static bool same_kd(const struct flat *a, const struct flat *b)
{
    uint32_t stack[2 * KD_MAX_DEPTH + 2][2] = {{0, 0}};
    int held = 1;
    if (a->kd_count != b->kd_count || a->kd_items_count != b->kd_items_count ||
        memcmp(&a->view.kd_box.lo, &b->view.kd_box.lo, 12) != 0 ||
        memcmp(&a->view.kd_box.hi, &b->view.kd_box.hi, 12) != 0)
        return false;
    while (held > 0 && a->kd_count > 0) {
        held--;
        const kd_node *x = &a->kd[stack[held][0]], *y = &b->kd[stack[held][1]];
        if (x->kind != y->kind)
            return false;
        if (x->kind >= KD_LEAF) {
            if (!same_names(a->kd_items + x->first, b->kd_items + y->first,
                            x->kind - KD_LEAF))
                return false;
            continue;
        }
        if (x->split != y->split)
            return false;
        for (uint32_t i = 0; i < 2; i++) {
            stack[held][0] = x->first + i;
            stack[held++][1] = y->first + i;
        }
    }
    return true;
}

static double area_of(const bvh_node *n, int i)
{
    double x = (double)n->hi[0][i] - (double)n->lo[0][i];
    double y = (double)n->hi[1][i] - (double)n->lo[1][i];
    double z = (double)n->hi[2][i] - (double)n->lo[2][i];
    return x * y + y * z + z * x;
}

/* What there is in a tree. */
struct census {
    int children, items;
    double cost;
};

/* The cost is that of the surface area heuristic: areas of nodes, and of leaves
 * times items, over the largest child's of the root. */
static struct census take_census(const struct flat *f)
{
    struct census c = {0, 0, 0.0};
    double whole = 0.0;
    for (size_t i = 0; i < f->bvh_count; i++)
        for (int k = 0; k < BVH_WIDTH; k++) {
            const bvh_node *n = &f->bvh[i];
            if (!(n->lo[0][k] < INFINITY))
                continue;
            c.children++;
            c.items += (int)n->count[k];
            c.cost += area_of(n, k) * (n->count[k] > 0 ? n->count[k] : 1);
            if (i == 0)
                whole = fmax(whole, area_of(n, k));
        }
    c.cost /= whole > 0.0 ? whole : 1.0;
    return c;
}

static uint64_t count_differences(const ray_hit *a, const ray_hit *b)
{
    uint64_t n = 0;
    for (size_t i = 0; i < rays; i++)
        n += !same_hit(&a[i], &b[i]);
    return n;
}

struct shots {
    const struct flat *flat;
    const bvh_ray *ray;
    ray_hit *hit;
};

static void shoot_one(void *context, size_t i, int thread)
{
    struct shots *s = context;
    ray_hit after = hit_start(0.0f);
    (void)thread;
    s->hit[i] = bvh_nearest(&s->flat->view, &s->ray[i], &after, INFINITY);
}

static void shoot_host(const struct flat *f, const bvh_ray *ray, ray_hit *hit)
{
    struct shots s = {f, ray, hit};
    parallel_for(0, rays, shoot_one, &s, NULL);
}

/* ---- rows --------------------------------------------------------------- */

struct mesh_case {
    const char *name;
    const struct triangles *mesh;
    bvh_ray *ray;
    ray_hit *want, *got;
};

static void row(const struct mesh_case *c, const char *tree, const char *where,
                double build, const struct flat *f, double shot,
                const char *more, uint64_t differ)
{
    struct census census = take_census(f);
    double wide = f->bvh_count > 0 ? census.children / (double)f->bvh_count
                                   : 0.0;
    printf("| %s, %zu | %s | %s | %.3f | %zu | %.2f | %d | %.2f | %.1f | "
           "%s%" PRIu64 " |\n",
           c->name, c->mesh->count, tree, where, build,
           f->bvh_count + f->kd_count, wide,
           f->bvh_count > 0 ? bvh_room(f, 0) : 0, census.cost,
           1e-3 * (double)rays / shot, more, differ);
    fflush(stdout);
    wrong += differ;
}

/* The CPU's tree, with rays on the GPU; it is the scale of all others. */
static struct flat *host_row(const struct mesh_case *c, enum tree tree,
                             const char *name, bool first)
{
    struct brume_error err = {0};
    double start = cpu_milliseconds(), shot;
    struct flat *f = tree_scene(c->mesh, tree, 4, &err);
    double build = cpu_milliseconds() - start;
    struct shoot *s = shoot_new(f, &err);
    stop_at(&err);
    if (first)
        shoot_host(f, c->ray, c->want);
    shoot_rays(s, false, c->ray, rays, c->got, times, &shot, &err);
    stop_at(&err);
    row(c, name, "CPU", build, f, shot, "", count_differences(c->want, c->got));
    shoot_free(s);
    return f;
}

/* The GPU's, with rays on both, of a BVH a search keeps `places` at most;
 * `like`: the CPU's kd-tree. */
static void device_row(const struct mesh_case *c, enum shoot_tree tree,
                       int places, const struct flat *like)
{
    struct brume_error err = {0};
    struct flat *f = tree_scene(c->mesh, TREE_NONE, 4, &err);
    const char *name = tree == SHOOT_KD ? "kd-tree" : "BVH";
    f->view.kd_stack = 4;
    struct shoot *s = shoot_new(f, &err);
    double build, shot;
    bool even, same = true;
    stop_at(&err);
    shoot_build(s, tree, places, times, &build, &even, &err);
    stop_at(&err);
    shoot_fetch(s, f, &err);
    stop_at(&err);
    flat_view(f);
    if (tree == SHOOT_KD)
        same = same_kd(f, like);
    else if (c->mesh->count > 0)
        same = names_all(f->bvh_items, f->bvh_items_count, c->mesh->count) &&
               (size_t)take_census(f).items == c->mesh->count &&
               bvh_room(f, 0) <= places;
    shoot_host(f, c->ray, c->got);
    uint64_t differ = count_differences(c->want, c->got);
    for (int shared = 0; shared < (tree == SHOOT_KD ? 2 : 1); shared++) {
        shoot_rays(s, shared, c->ray, rays, c->got, times, &shot, &err);
        stop_at(&err);
        differ += count_differences(c->want, c->got);
        row(c, shared ? "kd-tree, shared stack" : name, "GPU", build, f, shot,
            !same  ? "WRONG TREE, "
            : even ? "halved, "
                   : "",
            differ);
    }
    wrong += !same;
    shoot_free(s);
    flat_free(f);
}

/* `halved`: so few places that a tree has to be halved; or 0. */
static void run(const char *name, const struct triangles *mesh, int halved)
{
    struct mesh_case c = {.name = name, .mesh = mesh};
    c.ray = malloc(rays * sizeof *c.ray);
    c.want = malloc(rays * sizeof *c.want);
    c.got = malloc(rays * sizeof *c.got);
    for (size_t i = 0; i < rays; i++)
        c.ray[i] = tree_ray(mesh, i);
    struct flat *f = host_row(&c, TREE_BVH, "BVH", true);
    flat_free(f);
    device_row(&c, SHOOT_BVH, BVH_STACK - 1, NULL);
    if (halved)
        device_row(&c, SHOOT_BVH, halved, NULL);
    f = host_row(&c, TREE_KD, "kd-tree", false);
    device_row(&c, SHOOT_KD, 0, f);
    flat_free(f);
    free(c.ray);
    free(c.want);
    free(c.got);
}

static void run_some(const char *name, struct triangles mesh)
{
    size_t all = rays;
    rays = rays < 20000 ? rays : 20000;
    run(name, &mesh, 0);
    rays = all;
    free(mesh.corner);
}

int main(int count, char **word)
{
    struct triangles spot = {NULL, 0}, odd = triangles_degenerate(20000);
    struct brume_error err = {0};
    rays = count > 1 ? (size_t)atoll(word[1]) : rays;
    times = count > 2 ? atoi(word[2]) : times;
    int divisions = count > 3 ? atoi(word[3]) : 4;
    triangles_load(&spot, "scenes/campfire/spot.ply", &err);
    stop_at(&err);
    puts("| mesh, triangles | tree | built on | ms | nodes | wide | places | "
         "cost | M rays/s | differ |\n"
         "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    run("spot", &spot, 17);
    size_t all = rays;
    rays /= 4;
    run("degenerate", &odd, 20);
    rays = all;
    struct triangles fine = triangles_first(&spot, spot.count);
    for (int i = 1; i <= divisions; i++) {
        struct triangles finer = triangles_divide(&fine);
        free(fine.corner);
        fine = finer;
        if (i != 2)
            continue;
        struct triangles published = triangles_first(&fine, 66454);
        run("as many as published", &published, 0);
        free(published.corner);
    }
    if (divisions > 0)
        run("divided", &fine, 0);
    for (size_t n = 1; n <= 5; n++)
        run_some("few", triangles_first(&spot, n));
    run_some("few", triangles_first(&spot, 33));
    run_some("same", triangles_same(100000));
    run_some("spread", triangles_spread(5000));
    free(spot.corner);
    free(fine.corner);
    free(odd.corner);
    return wrong ? 1 : 0;
}
