/* Boxes of bounds. */
#include <math.h>
#include "core/leaf.h"

struct box box_empty(void)
{
    return (struct box){{INFINITY, INFINITY, INFINITY},
                        {-INFINITY, -INFINITY, -INFINITY}};
}

struct box box_endless(void)
{
    return (struct box){{-INFINITY, -INFINITY, -INFINITY},
                        {INFINITY, INFINITY, INFINITY}};
}

void box_add(struct box *b, const double p[3])
{
    for (int i = 0; i < 3; i++) {
        b->lo[i] = fmin(b->lo[i], p[i]);
        b->hi[i] = fmax(b->hi[i], p[i]);
    }
}

struct box box_hull(const struct box *a, const struct box *b)
{
    struct box out;
    for (int i = 0; i < 3; i++) {
        out.lo[i] = fmin(a->lo[i], b->lo[i]);
        out.hi[i] = fmax(a->hi[i], b->hi[i]);
    }
    return out;
}

struct box box_common(const struct box *a, const struct box *b)
{
    struct box out;
    for (int i = 0; i < 3; i++) {
        out.lo[i] = fmax(a->lo[i], b->lo[i]);
        out.hi[i] = fmin(a->hi[i], b->hi[i]);
    }
    return out;
}

bool box_is_empty(const struct box *b)
{
    return !(b->lo[0] <= b->hi[0] && b->lo[1] <= b->hi[1] &&
             b->lo[2] <= b->hi[2]);
}

bool box_is_bounded(const struct box *b)
{
    for (int i = 0; i < 3; i++)
        if (!isfinite(b->lo[i]) || !isfinite(b->hi[i]))
            return false;
    return true;
}

struct box box_transform(const struct box *b, const matrix *map)
{
    struct box out = box_empty();
    if (!box_is_bounded(b))
        return box_endless();
    for (int i = 0; i < 8; i++) {
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = i >> k & 1 ? b->hi[k] : b->lo[k];
        matrix_point(map, p, p);
        box_add(&out, p);
    }
    return out;
}
