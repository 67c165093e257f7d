/* blend.h - maps: what a pattern's value from 0 to 1 chooses from, and the
 * lists of block patterns.
 *
 * A map is an array of reals: how many entries, terms of each (0: they are
 * functions), then the entries' places, then their terms. As in POV-Ray a
 * value belongs to the first entry whose place it does not exceed, and to the
 * one before that in part. */
#ifndef CORE_PHYSICS_BLEND_H
#define CORE_PHYSICS_BLEND_H
#include "core/physics/real.h"

enum { BLEND_HEAD = 2 };

/* A value as the index of one of `count`. */
HD int blend_index(real value, real count)
{
    return (int)real_clamp(value, REAL(0.0), count - 1);
}

/* found[0]: the entry before the value, found[1]: the part of the next. */
HD void blend_find(const real *map, real value, real *found)
{
    const real *at = map + BLEND_HEAD;
    int count = (int)map[0], next = 0;
    while (next < count && !(value <= at[next]))
        next++;
    found[0] = (real)(next > 0 ? next - 1 : 0);
    found[1] = REAL(0.0);
    if (next > 0 && next < count)
        found[1] = (value - at[next - 1]) / (at[next] - at[next - 1]);
}

HD void blend_choose(const real *map, real value, real *out)
{
    int count = (int)map[0], terms = (int)map[1];
    const real *entry = map + BLEND_HEAD + count
                      + blend_index(value, map[0]) * terms;
    for (int k = 0; k < terms; k++)
        out[k] = entry[k];
}

HD void blend_eval(const real *map, real value, real *out)
{
    int terms = (int)map[1];
    real found[2];
    blend_find(map, value, found);
    blend_choose(map, found[0], out);
    if (!(found[1] > 0))
        return;
    const real *next = map + BLEND_HEAD + (int)map[0]
                     + ((int)found[0] + 1) * terms;
    for (int k = 0; k < terms; k++)
        out[k] += found[1] * (next[k] - out[k]);
}

#endif
