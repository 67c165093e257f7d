/* Wide trees out of binary ones: the cheapest that there is, with all items,
 * within the places that a search has; and boxes of four children at once. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <math.h>
#include <string.h>
#include <cmocka.h>
#include "core/bvh.h"
#include "core/physics/bvh.h"
#include "core/physics/lbvh.h"
#include "core/physics/rng.h"
#include "core/physics/warp.h"

enum { MOST = 512 };

/* A binary tree of leaves, numbered as their items are. */
struct binary {
    wide_part part[MOST];
    bvh_box box[MOST];
    struct bvh_binary tree;
};

static bvh_box random_box(rng *r, float size)
{
    bvh_box box;
    for (int k = 0; k < 3; k++) {
        box.lo[k] = rng_float(r);
        box.hi[k] = box.lo[k] + size * rng_float(r);
    }
    return box;
}

/* Splits leaves until there are so many: any, or the last one made. */
static void grow(struct binary *b, int leaves, bool chain, rng *r)
{
    memset(b, 0, sizeof *b);
    b->tree = (struct bvh_binary){b->part, b->box, 1};
    b->part[0].leaf = 1;
    for (int i = 1; i < leaves; i++) {
        size_t at = b->tree.count - 1;
        while (
            !chain &&
            !b->part[at = (size_t)(rng_float(r) * (float)b->tree.count)].leaf)
            ;
        b->part[at].leaf = 0;
        for (int k = 0; k < 2; k++) {
            b->part[at].child[k] = (uint32_t)b->tree.count;
            b->part[b->tree.count++].leaf = 1;
        }
    }
    uint32_t item = 0;
    for (size_t i = b->tree.count; i-- > 0;) {
        wide_part *p = &b->part[i];
        if (p->leaf) {
            b->box[i] = random_box(r, 0.1f);
            p->items = 1;
            p->child[0] = item++;
        } else {
            b->box[i] = lbvh_union(&b->box[p->child[0]], &b->box[p->child[1]]);
        }
    }
}

static bvh_box child_box(const bvh_node *n, int i)
{
    bvh_box box;
    for (int k = 0; k < 3; k++) {
        box.lo[k] = n->lo[k][i];
        box.hi[k] = n->hi[k][i];
    }
    return box;
}

/* Areas of nodes beside the root, and of leaves. Marks the items found. */
static double cost_of(const struct flat *f, uint8_t *found)
{
    double sum = 0.0;
    for (size_t i = 0; i < f->bvh_count; i++) {
        const bvh_node *n = &f->bvh[i];
        for (int k = 0; k < BVH_WIDTH; k++) {
            if (!(n->lo[0][k] < INFINITY)) {
                assert_true(k > 0);
                assert_int_equal(n->count[k], 0);
                continue;
            }
            bvh_box box = child_box(n, k);
            sum += (double)lbvh_area(&box);
            if (n->count[k] > 0) {
                assert_int_equal(found[n->first[k]]++, 0);
                continue;
            }
            assert_in_range(n->first[k], i + 1, f->bvh_count - 1);
            for (int j = 0; j < BVH_WIDTH; j++) {
                bvh_box inner = child_box(&f->bvh[n->first[k]], j);
                for (int x = 0; x < 3 && inner.lo[0] < INFINITY; x++) {
                    assert_true(box.lo[x] <= inner.lo[x]);
                    assert_true(box.hi[x] >= inner.hi[x]);
                }
            }
        }
    }
    return sum;
}

static struct flat *collapse(struct binary *b, int room, double *cost)
{
    struct brume_error err = {0};
    struct flat *f = flat_new(&err);
    uint8_t found[MOST] = {0};
    assert_true(bvh_collapse(f, &b->tree, room, &err));
    *cost = cost_of(f, found);
    for (size_t i = 0; i < (b->tree.count + 1) / 2; i++)
        assert_int_equal(found[i], 1);
    return f;
}

/* Children of a node where the parts of a set are nodes. */
static int count_children(const struct binary *b, uint32_t at, const bool *node)
{
    int n = 0;
    for (int k = 0; k < 2; k++) {
        uint32_t child = b->part[at].child[k];
        bool is = b->part[child].leaf || node[child];
        n += is ? 1 : count_children(b, child, node);
    }
    return n;
}

/* Of all sets of parts that may be nodes the cheapest, with the leaves. */
static double least_cost(const struct binary *b)
{
    uint32_t inner[MOST];
    int count = 0;
    double leaves = 0.0, least = INFINITY;
    for (size_t i = 1; i < b->tree.count; i++)
        if (b->part[i].leaf)
            leaves += (double)lbvh_area(&b->box[i]);
        else
            inner[count++] = (uint32_t)i;
    for (uint32_t set = 0; set < 1u << count; set++) {
        bool node[MOST] = {true}, good = true;
        double sum = leaves;
        for (int i = 0; i < count; i++) {
            node[inner[i]] = set >> i & 1;
            sum += set >> i & 1 ? (double)lbvh_area(&b->box[inner[i]]) : 0.0;
        }
        for (size_t i = 0; i < b->tree.count && good; i++)
            good = b->part[i].leaf || !node[i] ||
                   count_children(b, (uint32_t)i, node) <= BVH_WIDTH;
        least = good && sum < least ? sum : least;
    }
    return least;
}

static void test_wide__cheapest(void **state)
{
    (void)state;
    struct binary b;
    rng r = rng_make(5, 0, 0, 1);
    for (int i = 0; i < 600; i++) {
        double cost;
        grow(&b, 2 + i % 10, false, &r);
        struct flat *f = collapse(&b, BVH_STACK - 1, &cost);
        assert_float_equal(cost, least_cost(&b), 1e-5 * cost);
        flat_free(f);
    }
}

/* As few places as there are levels are enough, whatever the tree. */
static void test_wide__room(void **state)
{
    (void)state;
    struct binary b;
    rng r = rng_make(6, 0, 0, 1);
    for (int i = 0; i < 300; i++) {
        double cost;
        bool chain = i % 4 == 0;
        grow(&b, chain ? 1 + i / 4 % 63 : 1 + i % 250, chain, &r);
        for (int room = 0; room < BVH_STACK; room += 9) {
            struct flat *f = collapse(&b, room, &cost);
            int deep = b.part[0].depth;
            assert_in_range(bvh_room(f, 0), 0, deep > room ? deep : room);
            flat_free(f);
        }
    }
}

/* Four boxes at once, as they are one by one. */
static void test_wide__boxes(void **state)
{
    (void)state;
    rng r = rng_make(7, 0, 0, 1);
    uint64_t touched = 0;
    for (int i = 0; i < 4000; i++) {
        bvh_node node;
        bvh_box box[BVH_WIDTH];
        real t[BVH_WIDTH];
        int n = 1 + i % BVH_WIDTH;
        float u = rng_float(&r), v = rng_float(&r);
        vec3 d = warp_sphere(u, v);
        d.x = i % 7 == 0 ? 0.0f : d.x;
        d.y = i % 11 == 0 ? -0.0f : d.y;
        vec3 o = vec3_make(rng_float(&r), rng_float(&r), rng_float(&r));
        bvh_ray ray = bvh_ray_make(o, vec3_normalize(d));
        wide_clear(&node);
        for (int k = 0; k < n; k++) {
            box[k] = random_box(&r, 1.0f);
            wide_put(&node, k, &box[k], 0, 1);
        }
        float from = 0.3f * rng_float(&r), to = i % 3 ? INFINITY : 0.5f;
        bvh_enter_all(&node, &ray, from, to, t);
        for (int k = 0; k < BVH_WIDTH; k++) {
            real want = k < n ? bvh_enter(&box[k], &ray, from, to) : INFINITY;
            assert_true(t[k] == want);
            touched += want < INFINITY;
        }
    }
    assert_true(touched > 500);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_wide__cheapest),
        cmocka_unit_test(test_wide__room),
        cmocka_unit_test(test_wide__boxes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
