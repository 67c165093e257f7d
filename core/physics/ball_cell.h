/* ball_cell.h - what of the media lies in the ball of a cell.
 *
 * Events in a ball, over its volume, are what is scattered there on average:
 * where a medium thickens within the ball, light would seem to come from its
 * thin part too, through which more of it is seen. So a cell keeps what is
 * scattered per thickness of the media, both of them means over its ball, and
 * the eye's rays give it back by the thickness where they pass. This is the
 * published sum times sigma_s (PAPER.md, section 1) with the factor that it
 * lacks, 1 / sigma_s, of the ball.
 *
 * Births of emission photons tell likewise what is emitted in a ball on
 * average, of hot and cold places. A cell keeps how many there are for each
 * that should be, which is 1 but for chance; the eye's rays give it back by
 * what is emitted where they pass. */
#ifndef CORE_PHYSICS_BALL_CELL_H
#define CORE_PHYSICS_BALL_CELL_H
#include "core/physics/ball_glow.h"
#include "core/physics/ball_table.h"
#include "core/physics/inside.h"
#include "core/physics/path.h"

/* Points of a ball that tell of it: pairs, of which linear densities come out
 * exactly. Where they differ much, as at the edge of a cloud, up to so many: a
 * ball whose thick part none of them met would seem to scatter that much more
 * for each bit of its thickness, and shine in the picture. */
enum { BALL_PAIRS = 16, BALL_MOST_PAIRS = 256 };

/* Mean densities of the media in a ball. */
typedef struct {
    int32_t count;
    int32_t medium[MAX_ACTIVE];
    rgb density[MAX_ACTIVE];
    float thickness;
} ball_media;

/* The k-th of them, in a ball of radius 1. */
HD vec3 ball_offset(int k)
{
    return vec3_make(ball_point[3 * k], ball_point[3 * k + 1],
                     ball_point[3 * k + 2]);
}

HD void ball_add(const flat_scene *s, ball_media *b, int32_t medium, vec3 x)
{
    const flat_medium *m = scene_medium(s, medium);
    int i = 0;
    while (i < part_bound(b->count) && b->medium[part_place(i)] != medium)
        i++;
    if (i == MAX_ACTIVE)
        return;
    if (i >= b->count) {
        b->medium[part_place(i)] = medium;
        b->density[part_place(i)] = rgb_gray(0.0f);
        b->count = i + 1;
    }
    field_point at = medium_point(s, m, x);
    rgb *sum = &b->density[part_place(i)];
    *sum = rgb_add(*sum, medium_density(s, m, &at));
}

HD void ball_add_point(const flat_scene *s, ball_media *b, vec3 x)
{
    container_set set;
    inside_find(s, x, &set);
    for (int i = -1; i < container_count(&set); i++) {
        int32_t interior = container_interior(s, &set, i);
        for (int k = 0; interior >= 0 && k < s->interiors[interior].count; k++)
            ball_add(s, b, s->interior_media[s->interiors[interior].first + k],
                     x);
    }
}

/* The thickness of what has been added up. */
HD float ball_thickness(const flat_scene *s, const ball_media *b)
{
    float sum = 0.0f;
    for (int i = 0; i < part_bound(b->count); i++)
        sum += radiance_thickness(
            scene_medium(s, b->medium[part_place(i)]),
            b->density[part_place(i)]);
    return sum;
}

/* What is to be known of a ball: the mean of its media, where something is
 * known to scatter in it; or which of them scatter there, and how they share
 * it. */
enum { BALL_MEAN, BALL_SHARES };

/* What some of its points tell. */
typedef struct {
    ball_media sum;
    int points;
    float thickness, squares;   /* of whole pairs                          */
    bool known;
} ball_probe;

/* Whether the mean is good to a tenth. */
HD bool ball_is_known(const ball_probe *p)
{
    float n = (float)(p->points / 2), sum = p->thickness;
    return n * p->squares - sum * sum <= 0.01f * (n - 1.0f) * sum * sum;
}

/* A medium that is alone has all of it wherever it is found, unless it has
 * colours. */
HD bool ball_is_shared(const flat_scene *s)
{
    return s->media_count > 1 || scene_medium(s, 0)->functions;
}

/* Whether its points are enough. */
HD bool ball_suffices(const flat_scene *s, const ball_probe *p, int what)
{
    int pairs = p->points / 2;
    if (what == BALL_SHARES)
        return pairs >= BALL_PAIRS ||
               (p->thickness > 1e-30f && !ball_is_shared(s));
    return pairs >= BALL_MOST_PAIRS ||
           (pairs >= BALL_PAIRS && p->thickness > 0.0f && ball_is_known(p));
}

/* A point of the ball; each pair has two. */
HD vec3 ball_place(const flat_scene *s, vec3 x, int i)
{
    float r = s->field.radius;
    return vec3_mad(x, i & 1 ? -r : r, ball_offset(i >> 1));
}

/* Adds a pair. */
HD void ball_add_pair(const flat_scene *s, vec3 x, int what, ball_probe *p)
{
    ball_add_point(s, &p->sum, ball_place(s, x, p->points));
    ball_add_point(s, &p->sum, ball_place(s, x, p->points + 1));
    float now = ball_thickness(s, &p->sum), pair = now - p->thickness;
    p->points += 2;
    p->thickness = now;
    p->squares += pair * pair;
    p->known = ball_suffices(s, p, what);
}

/* What the pairs up to that of its place tell each of half a team, of whose
 * points each has found the density at one: as one thread would add them, so
 * that the bits are the same. */
HD ball_probe ball_probe_until(const flat_scene *s, team t, float density,
                               int what, const ball_probe *before)
{
    ball_probe p = *before;
    float sum = before->sum.density[0].r, squares = before->squares;
    for (int i = 0; i < t.size; i++) {
        sum += team_float(t, density, i);
        if (i == 2 * t.place + 1)
            p.sum.density[0] = rgb_gray(sum);
    }
    p.thickness = ball_thickness(s, &p.sum);
    float last = team_float(t, p.thickness, t.place - 1);
    float pair = p.thickness - (t.place > 0 ? last : before->thickness);
    for (int i = 0; i < t.size / 2; i++) {
        squares += team_float(t, pair * pair, i);
        if (i == t.place)
            p.squares = squares;
    }
    p.points += 2 * t.place + 2;
    p.known = t.place < t.size / 2 && ball_suffices(s, &p, what);
    return p;
}

/* Adds as many points as a team has threads, each of which looks up one, or
 * fewer if they are enough. There is one medium, and its density is one
 * number. */
HD void ball_add_pairs(const flat_scene *s, vec3 x, int what, team t,
                       ball_probe *p)
{
    ball_media at;
    at.count = 0;
    at.density[0] = rgb_gray(0.0f);
    ball_add_point(s, &at, ball_place(s, x, p->points + t.place));
    if (p->sum.count == 0 && team_any(t, at.count > 0)) {
        p->sum.count = 1;
        p->sum.medium[0] = 0;
    }
    ball_probe until = ball_probe_until(s, t, at.density[0].r, what, p);
    int last = team_first(t, until.known);
    p->known = last < t.size;
    last = p->known ? last : t.size / 2 - 1;
    p->points += 2 * last + 2;
    p->sum.density[0] = rgb_gray(team_float(t, until.sum.density[0].r, last));
    p->thickness = team_float(t, until.thickness, last);
    p->squares = team_float(t, until.squares, last);
}

/* Whether a point of the field's ball around x, of those of a place of `size`
 * that have them in turn, has something of the only medium. */
HD bool ball_finds(const flat_scene *s, vec3 x, int place, int size)
{
    for (int i = place; i < 2 * BALL_PAIRS; i += size) {
        ball_media at;
        at.count = 0;
        ball_add_point(s, &at, ball_place(s, x, i));
        if (at.count > 0 && at.density[0].r > 0.0f)
            return true;
    }
    return false;
}

/* The media of the field's ball around x. */
HD ball_media ball_media_at(const flat_scene *s, vec3 x, int what, team t)
{
    ball_probe p;
    p.sum.count = p.points = 0;
    p.sum.density[0] = rgb_gray(0.0f);
    p.thickness = p.squares = 0.0f;
    p.known = false;
    while (!p.known)
        if (t.size > 1)
            ball_add_pairs(s, x, what, t, &p);
        else
            ball_add_pair(s, x, what, &p);
    for (int i = 0; i < part_bound(p.sum.count); i++) {
        rgb *density = &p.sum.density[part_place(i)];
        *density = rgb_scale(*density, 1.0f / (float)p.points);
    }
    p.sum.thickness = ball_thickness(s, &p.sum);
    return p.sum;
}

/* Whether the cells of a medium's majorants tell that it is nowhere in the
 * field's ball around x; its points may lie a little beyond. */
HD bool ball_lacks(const flat_scene *s, const flat_medium *m, vec3 x)
{
    vec3 at = affine_point(&m->to_cell, x);
    int lo[3], hi[3];
    if (m->uniform || m->functions || m->outside.density != 0.0f)
        return false;
    for (int i = 0; i < 3; i++) {
        float r = 1.001f * ball_reach(&m->to_cell, i, s->field.radius) + 0.001f;
        lo[i] = hd_floor(hd_max(vec3_get(at, i) - r, 0.0f));
        hi[i] = hd_floor(hd_min(vec3_get(at, i) + r,
                                (float)m->cells[i] - 0.5f));
    }
    for (int c = lo[2]; c <= hi[2]; c++)
        for (int b = lo[1]; b <= hi[1]; b++)
            for (int a = lo[0]; a <= hi[0]; a++) {
                uint64_t row = (uint64_t)b +
                               (uint64_t)m->cells[1] * (uint64_t)c;
                if (s->cells[m->cell + (uint64_t)a +
                             (uint64_t)m->cells[0] * row].density != 0.0f)
                    return false;
            }
    return true;
}

/* Whether they tell so of all media. */
HD bool ball_is_empty(const flat_scene *s, vec3 x)
{
    for (uint64_t i = 0; i < s->media_count; i++)
        if (!ball_lacks(s, scene_medium(s, (int)i), x))
            return false;
    return true;
}

/* What the media of the ball scatter along d of light from wi, per light C and
 * thickness. */
HD rgb ball_scattered(const flat_scene *s, const ball_media *b, vec3 d,
                      vec3 wi)
{
    rgb sum = rgb_gray(0.0f);
    if (!(b->thickness > 0.0f))
        return sum;
    for (int i = 0; i < part_bound(b->count); i++) {
        const flat_medium *m = scene_medium(s, b->medium[part_place(i)]);
        rgb sigma = rgb_mul(m->sigma_s, b->density[part_place(i)]);
        float phase = phase_eval_between(m->phase, m->g, d, wi) *
                      phase_pov_scale(m->phase);
        sum = rgb_add(sum, rgb_scale(sigma, phase));
    }
    return rgb_scale(sum, light_medium_factor(s) / b->thickness);
}

/* Power of births that is to be expected, over the volume of the ball. */
HD float ball_births(const flat_scene *s, const ball_media *b, vec3 x, team t)
{
    float sum = 0.0f;
    for (uint64_t i = 0; i < s->glows_count; i++)
        sum += s->glows[i].power *
               ball_glow(s, &s->glows[i], x, s->field.radius, t);
    field_point at = field_point_make(s, -1, x);
    for (int i = 0; i < part_bound(b->count); i++) {
        const flat_medium *m = scene_medium(s, b->medium[part_place(i)]);
        if (m->uniform && m->emits)
            sum += 4.0f * FM_PI *
                   rgb_mean(medium_source(s, m, &at,
                                          b->density[part_place(i)]));
    }
    return sum;
}

/* The numbers of cell i of a brick that is there. */
HD float *ball_cell_numbers(const flat_scene *s, uint64_t brick, int i,
                            float *cells)
{
    uint64_t cell = (uint64_t)s->radiance_slots[brick] * 512u + (uint64_t)i;
    return cells + cell * (uint64_t)s->field.numbers;
}

HD bool ball_has_events(const float *numbers)
{
    return numbers[0] != 0.0f || numbers[1] != 0.0f || numbers[2] != 0.0f;
}

HD bool ball_has_births(const radiance_lattice *f, const float *numbers)
{
    return f->births && numbers[f->births] != 0.0f;
}

/* Whether something is in its ball. */
HD bool ball_cell_has(const flat_scene *s, uint64_t brick, int i, float *cells)
{
    const float *numbers = ball_cell_numbers(s, brick, i, cells);
    return ball_has_events(numbers) || ball_has_births(&s->field, numbers);
}

/* Turns what is in the ball of cell i of a brick that is there, over its
 * volume: events into those per thickness, births into their number over that
 * which is to be expected. The first of the team writes. */
HD void ball_cell_run(const flat_scene *s, uint64_t brick, int i, float *cells,
                      team t)
{
    const radiance_lattice *f = &s->field;
    float *out = ball_cell_numbers(s, brick, i, cells);
    bool births = ball_has_births(f, out);
    if (!ball_has_events(out) && !births)
        return;
    vec3 x = radiance_middle(s, brick, i);
    ball_media b = ball_media_at(s, x, BALL_MEAN, t);
    float expected = births ? ball_births(s, &b, x, t) : 0.0f;
    float scale = b.thickness > 0.0f ? 1.0f / b.thickness : 0.0f;
    if (t.place > 0)
        return;
    for (int c = 0; c < 3; c++)
        out[c] *= scale;
    if (births)
        out[f->births] = expected > 0.0f ? out[f->births] / expected : 1.0f;
}

#endif
