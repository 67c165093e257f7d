/* single_profile.h - how much the media along the eye's ray scatter to the eye,
 * and the choice of a place by that.
 *
 * Where densities are grids or constants, the sums are those of every stretch
 * between voxel planes, in halves, as of a line integral (line.h). A few of
 * them make a piece that is kept; the place is found by walking through the
 * piece again. So a place is chosen about as densely as it gives light, however
 * sharp a medium's edge is: with one look at each cell of the majorants it
 * could come ten times too seldom, and then counted ten times. Densities that
 * are functions are told by such a look. */
#ifndef CORE_PHYSICS_SINGLE_PROFILE_H
#define CORE_PHYSICS_SINGLE_PROFILE_H
#include "core/physics/path.h"

enum { SINGLE_PIECES = 64, SINGLE_EVEN = 48 };

/* Between distances t of the ray: sums of what comes to the eye from before
 * each, and the optical depth there. */
typedef struct {
    int32_t count;
    float t[SINGLE_PIECES + 1], sum[SINGLE_PIECES + 1];
    float depth[SINGLE_PIECES + 1];
    int32_t thick;          /* transmittance is worth its exact integral   */
    int32_t coarse;         /* of one look each; then there are no depths  */
    int32_t gray;           /* depths are those of all channels            */
} single_profile;

/* A place on the ray. */
typedef struct {
    float t;
    float density;          /* of the sum, per length                      */
    float sum, depth;       /* up to there                                 */
} single_spot;

/* Full, it goes on with half the pieces. */
HD void single_add(single_profile *f, float t, float weight, float depth)
{
    if (f->count == SINGLE_PIECES) {
        f->count /= 2;
        for (int i = 1; i <= f->count; i++) {
            f->t[i] = f->t[2 * i];
            f->sum[i] = f->sum[2 * i];
            f->depth[i] = f->depth[2 * i];
        }
    }
    float before = f->sum[f->count];
    f->count++;
    f->t[f->count] = t;
    f->sum[f->count] = before + weight;
    f->depth[f->count] = depth;
}

/* Scattering that the bounds of the current piece allow, and whether all its
 * media are homogeneous. */
HD float single_bound(const flat_scene *s, const media_walk *w, bool *even)
{
    float sum = 0.0f;
    *even = true;
    for (int i = 0; i < walk_parts(w); i++) {
        const flat_medium *m = walk_medium(s, w, i);
        sum += rgb_max(m->sigma_s) * walk_part(w, i)->bound.density;
        *even = *even && m->uniform;
    }
    return sum;
}

/* ---- one look at each piece --------------------------------------------- */

/* A piece whose middle scatters sigma_s and loses sigma_t, in parts where it
 * is thick and even. Not beyond a depth from which nothing comes. */
HD void single_piece(single_profile *f, const media_walk *w, float sigma_s,
                     float sigma_t, bool even, double *tau)
{
    float length = w->t_end - w->t, depth = sigma_t * length;
    int parts = 1;
    if (even && depth > 0.5f * SINGLE_EVEN) {
        depth = 0.5f * SINGLE_EVEN;
        length = depth / sigma_t;
    }
    if (even && depth > 0.5f)
        parts = (int)(2.0f * depth) + 1;
    for (int i = 1; i <= parts; i++) {
        float part = length / (float)parts;
        float seen = fm_exp(-(float)*tau - 0.5f * sigma_t * part);
        single_add(f, i < parts ? w->t + part * (float)i : w->t + length,
                   sigma_s * part * seen, 0.0f);
        *tau += (double)(sigma_t * part);
    }
}

/* The optical depth that was seen. */
HD double single_glance(const flat_scene *s, const path_state *p,
                        media_walk *w, single_profile *f)
{
    const float surely = 0.1f, enough = 30.0f;
    double tau = 0.0;
    do {
        bool even;
        float all, bound = single_bound(s, w, &even);
        float middle = path_middle(s, p, w, &all);
        single_piece(f, w, middle + surely * (bound - middle), all, even, &tau);
    } while (tau < (double)enough && walk_next(s, w));
    return tau;
}

/* ---- every stretch ------------------------------------------------------- */

/* What the halves of a stretch scatter and lose per length, their length, and
 * what comes of each to the eye. */
typedef struct {
    twin_float scatters, loses, comes;
    float half;
    float seen;             /* from all of it alike, where it is thin; or 0 */
} single_stretch;

/* A little of what the bounds allow is added, for edges within a stretch. */
HD single_stretch single_measure(const flat_scene *s, const line_flight *l,
                                 float stop)
{
    const float surely = 0.02f;
    const media_walk *w = &l->walk;
    single_stretch out;
    float off = LINE_NODE * (stop - l->t), ta = l->t + off, tb = stop - off;
    out.half = 0.5f * (stop - l->t);
    out.scatters.a = out.scatters.b = out.loses.a = out.loses.b = 0.0f;
    for (int i = 0; i < walk_parts(w); i++) {
        const lattice_walk *part = walk_part(w, i);
        const flat_medium *m = walk_medium(s, w, i);
        if (part->bound.density == 0.0f)
            continue;
        twin_point x = line_twin_point(s, &l->job, w, i, ta, tb);
        twin_rgb density = twin_density(s, m, &x);
        float scatters = rgb_max(m->sigma_s), loses = rgb_min(m->sigma_t);
        float least = surely * part->bound.density;
        out.scatters.a += scatters *
                          (least + (1.0f - surely) * density.a.r);
        out.scatters.b += scatters *
                          (least + (1.0f - surely) * density.b.r);
        out.loses.a += loses * density.a.r;
        out.loses.b += loses * density.b.r;
    }
    return out;
}

/* What comes of a length behind that depth. */
HD float single_weight(float scatters, float loses, float length, float depth)
{
    return scatters * fm_exp(-depth) * line_reach(loses, length);
}

/* What comes of a stretch behind that depth. */
HD void single_weigh(single_stretch *x, float depth)
{
    const float thin = 0.5f;
    float loss = x->half * (x->loses.a + x->loses.b);
    x->seen = loss < thin ? fm_exp(-depth - 0.5f * loss) : 0.0f;
    if (x->seen > 0.0f) {
        x->comes.a = x->scatters.a * x->half * x->seen;
        x->comes.b = x->scatters.b * x->half * x->seen;
        return;
    }
    x->comes.a = single_weight(x->scatters.a, x->loses.a, x->half, depth);
    x->comes.b = single_weight(x->scatters.b, x->loses.b, x->half,
                               depth + x->loses.a * x->half);
}

/* Begins the ray between two distances; false: there are no media. */
HD bool single_begin(const flat_scene *s, const path_state *p, float t0,
                     float t1, line_flight *l)
{
    line_integral none = line_zero();
    bool more = line_begin(s, &p->inside, p->o, p->d, t0, t1, 0.0f, false,
                           false, line_jitter_make(0.5f, 0.5f), &none, l);
    p->count->overflow += none.overflow;
    return more;
}

/* The optical depth that was seen. */
HD double single_add_all(const flat_scene *s, line_flight *l,
                         single_profile *f)
{
    const float enough = 30.0f;
    double tau = 0.0;
    float stop;
    while (tau < (double)enough && line_next(s, l, &stop)) {
        single_stretch x = single_measure(s, l, stop);
        single_weigh(&x, (float)tau);
        tau += (double)(x.half * (x.loses.a + x.loses.b));
        single_add(f, stop, x.comes.a + x.comes.b, (float)tau);
        l->t = stop;
    }
    return tau;
}

/* Where a half has given the share u of what comes of it. */
HD float single_invert(const single_stretch *y, float loses, float u)
{
    float tau = loses * y->half;
    u = hd_min(hd_max(u, 0.0f), 1.0f);
    float x = y->seen > 0.0f || tau < 1e-4f
            ? u * y->half : -fm_log1p(u * fm_expm1(-tau)) / loses;
    return hd_min(hd_max(x, 0.0f), y->half);
}

/* Of the first half of a stretch, or the second, up to the length x of it. */
HD single_spot single_spot_in(const flat_scene *s, const line_flight *l,
                              const single_stretch *y, bool second, float x,
                              float sum, float depth)
{
    single_spot at;
    float scatters = second ? y->scatters.b : y->scatters.a;
    float loses = second ? y->loses.b : y->loses.a;
    float before = depth + (second ? y->loses.a * y->half : 0.0f);
    at.t = l->t + (second ? y->half : 0.0f) + x;
    at.sum = sum + (second ? y->comes.a : 0.0f);
    if (y->seen > 0.0f) {
        at.density = scatters * y->seen;
        at.sum += at.density * x;
    } else {
        at.density = scatters * fm_exp(-before - loses * x);
        at.sum += single_weight(scatters, loses, x, before);
    }
    /* Of the two points of that part, this is exact. */
    single_stretch part = single_measure(s, l, at.t);
    at.depth = depth + part.half * (part.loses.a + part.loses.b);
    return at;
}

/* Walks through piece k to the distance `goal`, or `by_sum` to where the sum is
 * that. The last place that gives something, where rounding says that there is
 * none; of no density in a gap. */
HD_APART single_spot single_find(const flat_scene *s, const path_state *p,
                                 const single_profile *f, int k, bool by_sum,
                                 float goal)
{
    line_flight l;
    single_stretch x;
    float sum = f->sum[k], depth = f->depth[k], stop;
    single_spot at;
    at.t = by_sum ? f->t[k + 1] : goal;
    at.density = 0.0f;
    at.sum = sum;
    at.depth = depth;
    if (!single_begin(s, p, f->t[k], f->t[k + 1], &l))
        return at;
    while (line_next(s, &l, &stop)) {
        if (!by_sum && goal < l.t)
            break;
        x = single_measure(s, &l, stop);
        single_weigh(&x, depth);
        float end = sum + x.comes.a + x.comes.b;
        if (by_sum ? goal <= end : goal <= stop) {
            bool second = by_sum ? goal > sum + x.comes.a
                                 : goal > l.t + x.half;
            float in = goal - l.t - (second ? x.half : 0.0f);
            if (by_sum)
                in = second ? single_invert(&x, x.loses.b,
                                            (goal - sum - x.comes.a) /
                                            x.comes.b)
                            : single_invert(&x, x.loses.a,
                                            (goal - sum) / x.comes.a);
            return single_spot_in(s, &l, &x, second, in, sum, depth);
        }
        at.sum = sum = end;
        at.depth = depth += x.half * (x.loses.a + x.loses.b);
        at.density = x.scatters.b * fm_exp(-depth);
        at.t = l.t = stop;
    }
    if (!by_sum) {
        at.t = goal;
        at.density = 0.0f;
    }
    return at;
}

/* ---- both ---------------------------------------------------------------- */

/* Whether the walk's media tell their densities at points alone, and whether
 * they take the same of all channels. */
HD void single_ask(const flat_scene *s, const media_walk *w,
                   single_profile *f)
{
    f->coarse = 0;
    f->gray = 1;
    for (int i = 0; i < walk_parts(w); i++) {
        const flat_medium *m = walk_medium(s, w, i);
        f->coarse = f->coarse ||
                    (scene_may(MAY_FUNCTIONS) && (m->functions || m->sampled));
        f->gray = f->gray && rgb_min(m->sigma_t) == rgb_max(m->sigma_t);
    }
}

/* False where nothing is scattered. Wherever the media may scatter the profile
 * is above 0. */
HD bool single_look(const flat_scene *s, const path_state *p, float t1,
                    single_profile *f)
{
    const double thick = 1.0;
    line_flight l;
    f->count = 0;
    f->t[0] = p->after.t;
    f->sum[0] = f->depth[0] = 0.0f;
    if (!single_begin(s, p, p->after.t, t1, &l))
        return false;
    single_ask(s, &l.walk, f);
    double tau = f->coarse ? single_glance(s, p, &l.walk, f)
                           : single_add_all(s, &l, f);
    f->thick = tau > thick && s->procedures_count == 0;
    return f->sum[f->count] > 0.0f;
}

/* The piece in which the sum is `sum`. */
HD int single_piece_of(const single_profile *f, float sum)
{
    int i = 0;
    while (i < f->count - 1 && sum >= f->sum[i + 1])
        i++;
    return i;
}

/* Where the sum is `sum`. */
HD single_spot single_place(const flat_scene *s, const path_state *p,
                            const single_profile *f, float sum)
{
    int i = single_piece_of(f, sum);
    if (!f->coarse)
        return single_find(s, p, f, i, true, sum);
    single_spot at;
    float height = f->sum[i + 1] - f->sum[i];
    float length = f->t[i + 1] - f->t[i];
    float share = height > 0.0f ? (sum - f->sum[i]) / height : 0.5f;
    at.density = length > 0.0f ? height / length : 0.0f;
    at.t = f->t[i] + hd_min(hd_max(share, 0.0f), 1.0f) * length;
    at.sum = sum;
    at.depth = 0.0f;
    return at;
}

/* The place at distance t; beyond the profile nothing is there. */
HD single_spot single_at(const flat_scene *s, const path_state *p,
                         const single_profile *f, float t)
{
    int i = 0;
    single_spot at;
    while (i < f->count - 1 && t >= f->t[i + 1])
        i++;
    at.t = t;
    at.density = at.depth = at.sum = 0.0f;
    if (!(t >= f->t[0] && t <= f->t[f->count]))
        return at;
    if (!f->coarse)
        return single_find(s, p, f, i, false, t);
    float length = f->t[i + 1] - f->t[i], height = f->sum[i + 1] - f->sum[i];
    if (length > 0.0f) {
        at.density = height / length;
        at.sum = f->sum[i] + hd_min((t - f->t[i]) / length, 1.0f) * height;
    }
    return at;
}

#endif
