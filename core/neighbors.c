/* A kd-tree without nodes: of each range of points the middle one parts the
 * rest, along the axis on which the range is widest (Bentley 1975). */
#include "core/neighbors.h"
#include <math.h>
#include <stdlib.h>
#include "lib/memory.h"
#include "lib/thread.h"

enum { LEAF = 12, DEPTH = 64, CHUNK = 256 };

struct item {
    double at[3];
    uint32_t id;
    int axis; /* where it is the middle of a range                       */
};

struct range {
    size_t low, high;
    double bound; /* no point of it is nearer, squared                    */
};

struct tree {
    struct item *item;
    size_t count, k;
    double *distance;
};

/* ---- build ---- */

static int widest_axis(const struct item *item, size_t count)
{
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    int widest = 0;
    for (size_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++) {
            low[a] = fmin(low[a], item[i].at[a]);
            high[a] = fmax(high[a], item[i].at[a]);
        }
    for (int a = 1; a < 3; a++)
        if (high[a] - low[a] > high[widest] - low[widest])
            widest = a;
    return widest;
}

static void swap(struct item *a, struct item *b)
{
    struct item keep = *a;
    *a = *b;
    *b = keep;
}

/* Hoare's selection: item[middle] comes to where sorting would have it. The
 * pivots are drawn, so that no order of points is a slow one. */
static void select_middle(struct item *item, size_t count, size_t middle,
                          int axis)
{
    uint32_t random = (uint32_t)count;
    size_t low = 0, high = count - 1;
    while (low < high) {
        random = random * 1664525 + 1013904223;
        double pivot = item[low + random % (high - low + 1)].at[axis];
        size_t i = low, j = high;
        for (;;) {
            while (item[i].at[axis] < pivot)
                i++;
            while (item[j].at[axis] > pivot)
                j--;
            if (i >= j)
                break;
            swap(&item[i++], &item[j--]);
        }
        if (middle <= j)
            high = j;
        else
            low = j + 1;
    }
}

static void build(struct tree *t)
{
    struct range stack[DEPTH];
    int top = 0;
    stack[top++] = (struct range){0, t->count, 0};
    while (top > 0) {
        struct range r = stack[--top];
        if (r.high - r.low <= LEAF)
            continue;
        size_t middle = (r.low + r.high) / 2;
        int axis = widest_axis(t->item + r.low, r.high - r.low);
        select_middle(t->item + r.low, r.high - r.low, middle - r.low, axis);
        t->item[middle].axis = axis;
        stack[top++] = (struct range){r.low, middle, 0};
        stack[top++] = (struct range){middle + 1, r.high, 0};
    }
}

/* ---- query ---- */

/* The k nearest so far, as a heap whose first is the farthest. */
struct nearest {
    size_t count, k;
    double worst; /* infinite until there are k                           */
    double heap[BRUME_MAX_NEIGHBORS];
};

static void sink(struct nearest *n, double value)
{
    size_t at = 0;
    for (;;) {
        size_t child = 2 * at + 1;
        if (child >= n->count)
            break;
        if (child + 1 < n->count && n->heap[child + 1] > n->heap[child])
            child++;
        if (n->heap[child] <= value)
            break;
        n->heap[at] = n->heap[child];
        at = child;
    }
    n->heap[at] = value;
}

static void rise(struct nearest *n, double value)
{
    size_t at = n->count++;
    while (at > 0 && n->heap[(at - 1) / 2] < value) {
        n->heap[at] = n->heap[(at - 1) / 2];
        at = (at - 1) / 2;
    }
    n->heap[at] = value;
}

static void offer(struct nearest *n, const struct item *from,
                  const struct item *to)
{
    double x = to->at[0] - from->at[0], y = to->at[1] - from->at[1],
           z = to->at[2] - from->at[2];
    double d = x * x + y * y + z * z;
    if (d >= n->worst || to == from)
        return;
    if (n->count < n->k)
        rise(n, d);
    else
        sink(n, d);
    if (n->count == n->k)
        n->worst = n->heap[0];
}

/* Goes down to the point's own side and leaves the other sides for later. */
static void descend(const struct tree *t, const struct item *from,
                    struct range r, struct nearest *n, struct range *stack,
                    int *top)
{
    while (r.high - r.low > LEAF) {
        size_t middle = (r.low + r.high) / 2;
        const struct item *m = &t->item[middle];
        double apart = from->at[m->axis] - m->at[m->axis];
        struct range side[2] = {{r.low, middle, r.bound},
                                {middle + 1, r.high, r.bound}};
        int far = apart < 0;
        offer(n, from, m);
        side[far].bound = fmax(r.bound, apart * apart);
        stack[(*top)++] = side[far];
        r = side[1 - far];
    }
    for (size_t i = r.low; i < r.high; i++)
        offer(n, from, &t->item[i]);
}

static double distance_of(const struct tree *t, const struct item *from)
{
    struct range stack[DEPTH];
    struct nearest n;
    int top = 0;
    n.count = 0;
    n.k = t->k;
    n.worst = INFINITY;
    stack[top++] = (struct range){0, t->count, 0};
    while (top > 0) {
        struct range r = stack[--top];
        if (r.bound < n.worst)
            descend(t, from, r, &n, stack, &top);
    }
    return n.count > 0 ? sqrt(n.heap[0]) : 0;
}

static void query_chunk(void *context, size_t index, int thread)
{
    const struct tree *t = context;
    size_t end = (index + 1) * CHUNK;
    (void)thread;
    for (size_t i = index * CHUNK; i < end && i < t->count; i++)
        t->distance[t->item[i].id] = distance_of(t, &t->item[i]);
}

bool neighbors_distances(const double *at, size_t count, int k, int threads,
                         double *distance, struct brume_error *err)
{
    struct tree t = {.count = count, .k = (size_t)k, .distance = distance};
    t.item = memory_new(count, sizeof *t.item, err);
    if (!t.item)
        return false;
    for (size_t i = 0; i < count; i++) {
        for (int a = 0; a < 3; a++)
            t.item[i].at[a] = at[3 * i + (size_t)a];
        t.item[i].id = (uint32_t)i;
    }
    build(&t);
    parallel_for(threads, (count + CHUNK - 1) / CHUNK, query_chunk, &t, NULL);
    free(t.item);
    return true;
}
