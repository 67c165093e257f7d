/* The steps in which a GPU builds a BVH, taken one after the other: what comes
 * out does not depend on whose turn it is, names every item once, is not deep
 * and finds what a loop over all finds. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "core/physics/lbvh.h"
#include "tests/unit/tree_meshes.h"

#define NONE UINT32_MAX

struct built {
    const struct triangles *mesh;
    uint32_t count, root;
    bool even;
    bvh_box *box; /* of items                                    */
    uint64_t *code;
    uint32_t *order;
    lbvh_cluster *cluster; /* by id                                       */
    uint32_t (*child)[2];
    uint32_t *parent, *row;
    uint8_t *taken; /* places of inner nodes                       */
};

/* ---- codes -------------------------------------------------------------- */

static const uint64_t *sorted_by;

static int compare(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    if (sorted_by[x] != sorted_by[y])
        return sorted_by[x] < sorted_by[y] ? -1 : 1;
    return (x > y) - (x < y);
}

static float centre(const bvh_box *b, int k)
{
    return 0.5f * (b->lo[k] + b->hi[k]);
}

static void sort(struct built *b)
{
    float lo[3] = {INFINITY, INFINITY, INFINITY};
    float hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    uint64_t *code = malloc(b->count * sizeof *code);
    for (uint32_t i = 0; i < b->count; i++) {
        lbvh_triangle_box(b->mesh->corner[i], b->box[i].lo, b->box[i].hi);
        lbvh_widen(b->box[i].lo, b->box[i].hi);
        for (int k = 0; k < 3; k++) {
            lo[k] = fminf(lo[k], centre(&b->box[i], k));
            hi[k] = fmaxf(hi[k], centre(&b->box[i], k));
        }
    }
    for (uint32_t i = 0; i < b->count; i++) {
        const float at[3] = {centre(&b->box[i], 0), centre(&b->box[i], 1),
                             centre(&b->box[i], 2)};
        code[i] = lbvh_code(at, lo, lbvh_scale(lo, hi));
        b->order[i] = i;
    }
    sorted_by = code;
    qsort(b->order, b->count, sizeof *b->order, compare);
    for (uint32_t i = 0; i < b->count; i++)
        b->code[i] = b->even ? i : code[b->order[i]];
    free(code);
}

/* ---- clusters ----------------------------------------------------------- */

static int take_row(const struct built *b, uint32_t first, uint32_t end,
                    uint32_t *id)
{
    int n = 0;
    for (uint32_t i = first; i < end && i < first + LBVH_LEFT; i++)
        if (b->row[i] != NONE)
            id[n++] = b->row[i];
    return n;
}

static int partner_of(const struct built *b, const uint32_t *id, int count,
                      int i)
{
    uint64_t best = UINT64_MAX;
    for (int k = i - LBVH_REACH; k <= i + LBVH_REACH; k++) {
        if (k < 0 || k == i || k >= count)
            continue;
        uint64_t d = lbvh_distance(&b->cluster[id[i]].box,
                                   &b->cluster[id[k]].box, (uint32_t)i,
                                   (uint32_t)k, b->even);
        best = d < best ? d : best;
    }
    return (int)lbvh_partner(best, (uint32_t)i);
}

static int merge_pairs(struct built *b, uint32_t *id, int count)
{
    int partner[LBVH_WARP], kept = 0;
    for (int i = 0; i < count; i++)
        partner[i] = partner_of(b, id, count, i);
    for (int i = 0; i < count; i++) {
        int k = partner[i];
        if (partner[k] == i && k < i)
            continue;
        uint32_t made = id[i];
        if (partner[k] == i) {
            lbvh_cluster c = lbvh_merge(&b->cluster[id[i]], &b->cluster[id[k]],
                                        b->count);
            assert_in_range(c.id, b->count, 2 * b->count - 1);
            assert_false(b->taken[c.id - b->count]);
            b->taken[c.id - b->count] = 1;
            b->cluster[c.id] = c;
            b->child[c.id - b->count][0] = id[i];
            b->child[c.id - b->count][1] = id[k];
            made = c.id;
        }
        id[kept++] = made;
    }
    assert_true(kept < count);
    return kept;
}

static void merge_node(struct built *b, uint32_t left, uint32_t split,
                       uint32_t right)
{
    uint32_t id[LBVH_WARP];
    int begun = take_row(b, left, split, id);
    begun += take_row(b, split, right + 1, id + begun);
    bool whole = right - left == b->count - 1;
    int count = begun, most = whole ? 1 : LBVH_LEFT;
    while (count > most)
        count = merge_pairs(b, id, count);
    for (int i = 0; i < begun; i++)
        b->row[left + (uint32_t)i] = i < count ? id[i] : NONE;
    if (whole)
        b->root = id[0];
}

/* As far up as the other parts are done. */
static void go_up(struct built *b, uint32_t item)
{
    uint32_t left = item, right = item;
    while (right - left < b->count - 1) {
        bool is_left = lbvh_is_left(b->code, b->count, left, right);
        uint32_t gap = is_left ? right : left - 1, other = b->parent[gap];
        uint32_t split = is_left ? right + 1 : left;
        b->parent[gap] = is_left ? left : right;
        if (other == NONE)
            return;
        *(is_left ? &right : &left) = other;
        uint32_t size = right - left + 1;
        if (size > LBVH_LEFT || size == b->count)
            merge_node(b, left, split, right);
    }
}

/* Items take their turns from the first, the last or in steps. */
static struct built build(const struct triangles *mesh, bool even, int turns)
{
    uint32_t n = (uint32_t)mesh->count;
    struct built b = {.mesh = mesh, .count = n, .even = even};
    b.box = calloc(n, sizeof *b.box);
    b.code = calloc(n, sizeof *b.code);
    b.order = calloc(n, sizeof *b.order);
    b.cluster = calloc(2 * n, sizeof *b.cluster);
    b.child = calloc(n, sizeof *b.child);
    b.parent = malloc(n * sizeof *b.parent);
    b.row = calloc(n, sizeof *b.row);
    b.taken = calloc(n, 1);
    memset(b.parent, 255, n * sizeof *b.parent);
    sort(&b);
    for (uint32_t i = 0; i < n; i++) {
        b.cluster[i] = lbvh_item(&b.box[b.order[i]], i);
        b.row[i] = i;
    }
    for (uint32_t i = 0; i < n; i++)
        go_up(&b, turns == 0   ? i
                  : turns == 1 ? n - 1 - i
                               : (uint32_t)(i * UINT64_C(1000003) % n));
    return b;
}

static void release(struct built *b)
{
    free(b->box);
    free(b->code);
    free(b->order);
    free(b->cluster);
    free(b->child);
    free(b->parent);
    free(b->row);
    free(b->taken);
}

/* ---- what came out ------------------------------------------------------ */

static void assert_holds(const bvh_box *outer, const bvh_box *inner)
{
    for (int k = 0; k < 3; k++) {
        assert_true(outer->lo[k] <= inner->lo[k]);
        assert_true(outer->hi[k] >= inner->hi[k]);
    }
}

/* Names the items below a leaf, in order; returns how many there are then. */
static uint32_t list_items(const struct built *b, uint32_t id, uint32_t *name,
                           uint32_t items)
{
    uint32_t stack[BVH_LEAF] = {id};
    for (int held = 1; held > 0;) {
        uint32_t at = stack[--held];
        if (at < b->count) {
            name[items++] = 1 + b->order[at];
            continue;
        }
        assert_true(held + 2 <= BVH_LEAF);
        stack[held++] = b->child[at - b->count][1];
        stack[held++] = b->child[at - b->count][0];
    }
    return items;
}

/* The binary tree, and its items' names. */
static struct bvh_binary binary_of(const struct built *b, uint32_t *name)
{
    size_t most = 2 * b->count;
    struct bvh_binary tree = {calloc(most, sizeof *tree.part),
                              calloc(most, sizeof *tree.box), 1};
    uint32_t *id = malloc(most * sizeof *id), items = 0;
    id[0] = b->root;
    for (size_t i = 0; i < tree.count; i++) {
        const lbvh_cluster *c = &b->cluster[id[i]];
        wide_part *p = &tree.part[i];
        tree.box[i] = c->box;
        p->leaf = c->leaf;
        p->items = c->items;
        if (c->leaf) {
            p->child[0] = items;
            items = list_items(b, id[i], name, items);
            assert_int_equal(items - p->child[0], c->items);
            continue;
        }
        for (uint32_t k = 0; k < 2; k++) {
            uint32_t child = b->child[id[i] - b->count][k];
            assert_holds(&c->box, &b->cluster[child].box);
            id[tree.count] = child;
            p->child[k] = (uint32_t)tree.count++;
        }
    }
    assert_int_equal(items, b->count);
    free(id);
    return tree;
}

/* A scene with the wide tree. */
static struct flat *scene_of(const struct built *b)
{
    struct brume_error err = {0};
    struct flat *f = tree_scene(b->mesh, TREE_NONE, 1, &err);
    uint32_t *name = malloc(b->count * sizeof *name);
    struct bvh_binary tree = binary_of(b, name);
    assert_true(bvh_collapse(f, &tree, BVH_STACK - 1, &err));
    assert_in_range(bvh_room(f, 0), 0, BVH_STACK - 1);
    assert_int_equal(tree.part[0].split, b->cluster[b->root].split);
    assert_int_equal(tree.part[0].depth, b->cluster[b->root].depth);
    assert_non_null(FLAT_EXTEND(f, bvh_items, b->count, &err));
    memcpy(f->bvh_items, name, b->count * sizeof *name);
    f->view.bvh_root = 0;
    flat_view(f);
    free(name);
    free(tree.part);
    free(tree.box);
    return f;
}

static ray_hit nearest_of_all(const flat_scene *s, const bvh_ray *r)
{
    ray_hit after = hit_start(0.0f), best = hit_none(INFINITY);
    best.key = 0;
    for (uint64_t i = 0; i < s->triangles_count; i++)
        item_hit_triangle(s, r, i, &after, &best);
    return best;
}

static void assert_finds_all(const struct flat *f, const struct triangles *t)
{
    for (uint64_t i = 0; i < 400; i++) {
        bvh_ray r = tree_ray(t, i);
        ray_hit after = hit_start(0.0f), want = nearest_of_all(&f->view, &r);
        ray_hit got = bvh_nearest(&f->view, &r, &after, INFINITY);
        assert_true(same_hit(&got, &want));
    }
}

static void check(const struct triangles *t)
{
    for (int even = 0; even < 2; even++) {
        struct built b = build(t, even, 0);
        struct flat *f = scene_of(&b);
        assert_finds_all(f, t);
        for (int turns = 1; turns < 3; turns++) {
            struct built other = build(t, even, turns);
            assert_int_equal(other.root, b.root);
            assert_memory_equal(other.child, b.child,
                                t->count * sizeof *b.child);
            release(&other);
        }
        flat_free(f);
        release(&b);
    }
}

static void test_lbvh__mesh(void **state)
{
    (void)state;
    struct triangles t = {NULL, 0}, fine;
    struct brume_error err = {0};
    assert_true(triangles_load(&t, "scenes/campfire/spot.ply", &err));
    fine = triangles_divide(&t);
    check(&fine);
    free(t.corner);
    free(fine.corner);
}

static void test_lbvh__degenerate(void **state)
{
    (void)state;
    struct triangles t = triangles_degenerate(3000);
    check(&t);
    free(t.corner);
}

static void test_lbvh__few(void **state)
{
    (void)state;
    for (size_t n = 1; n < 70; n++) {
        struct triangles t = triangles_degenerate(n);
        check(&t);
        free(t.corner);
    }
}

/* Halves of halves: no deeper than the bits of their number, and what is left
 * to a node needs. */
static void test_lbvh__same(void **state)
{
    (void)state;
    enum { COUNT = 100000 };
    struct triangles t = {NULL, 0};
    vec3 o = vec3_make(0.1f, 0.2f, 0.3f), x = vec3_make(0.5f, 0.2f, 0.1f);
    for (int i = 0; i < COUNT; i++)
        triangles_add(&t, o, x, vec3_make(0.2f, 0.6f, 0.3f));
    struct built b = build(&t, false, 0);
    assert_in_range(b.cluster[b.root].depth, 13, 24);
    release(&b);
    free(t.corner);
}

/* Each is twice as large as the one before, and around it: a tree from below
 * is as deep as they are many, but not where it is halved. */
static void test_lbvh__deep(void **state)
{
    (void)state;
    struct triangles t = {NULL, 0};
    for (int i = 0; i < 120; i++) {
        float s = ldexpf(1e-18f, i);
        triangles_add(&t, vec3_make(-s, -s, -s), vec3_make(s, s, -s),
                      vec3_make(s, -s, s));
    }
    struct built deep = build(&t, false, 0), even = build(&t, true, 0);
    assert_true(deep.cluster[deep.root].depth > 40);
    assert_true(even.cluster[even.root].depth < 16);
    release(&deep);
    release(&even);
    free(t.corner);
}

/* By x y z x y z from the highest of 21 bits of each. */
static void test_lbvh__codes(void **state)
{
    (void)state;
    const float lo[3] = {-1, 2, 0}, hi[3] = {1, 3, 2};
    const float steps = lbvh_scale(lo, hi);
    const float top[3] = {1, 2, 0}, side[3] = {-1, 3, 0}, end[3] = {9, 9, 9};
    const float odd[3] = {NAN, -INFINITY, INFINITY};
    assert_int_equal(lbvh_code(lo, lo, steps), 0);
    assert_true(lbvh_code(top, lo, steps) == UINT64_C(0x4924924924924924));
    assert_true(lbvh_code(side, lo, steps) == UINT64_C(1) << 61);
    assert_true(lbvh_code(end, lo, steps) == (UINT64_C(1) << 63) - 1);
    assert_true(lbvh_code(odd, lo, steps) == UINT64_C(0x1249249249249249));
    assert_true(lbvh_scale(lo, lo) == 0.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lbvh__codes),
        cmocka_unit_test(test_lbvh__mesh),
        cmocka_unit_test(test_lbvh__degenerate),
        cmocka_unit_test(test_lbvh__few),
        cmocka_unit_test(test_lbvh__same),
        cmocka_unit_test(test_lbvh__deep),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
