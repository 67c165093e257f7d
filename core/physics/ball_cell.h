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

/* Whether the mean of n pairs is good to a tenth. */
HD bool ball_is_known(int n, float sum, float squares)
{
    return (float)n * squares - sum * sum <= 0.01f * (float)(n - 1) * sum * sum;
}

/* The media of the field's ball around x. `surely`: something is known to
 * scatter in it. */
HD ball_media ball_media_at(const flat_scene *s, vec3 x, bool surely)
{
    ball_media b;
    int n = 0, most = surely ? BALL_MOST_PAIRS : BALL_PAIRS;
    float sum = 0.0f, squares = 0.0f;
    b.count = 0;
    do {
        vec3 off = ball_offset(n++);
        ball_add_point(s, &b, vec3_mad(x, s->field.radius, off));
        ball_add_point(s, &b, vec3_mad(x, -s->field.radius, off));
        float now = ball_thickness(s, &b), pair = now - sum;
        sum = now;
        squares += pair * pair;
    } while (n < BALL_PAIRS ||
             (n < most && (!(sum > 0.0f) || !ball_is_known(n, sum, squares))));
    for (int i = 0; i < part_bound(b.count); i++) {
        rgb *density = &b.density[part_place(i)];
        *density = rgb_scale(*density, 0.5f / (float)n);
    }
    b.thickness = ball_thickness(s, &b);
    return b;
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
HD float ball_births(const flat_scene *s, const ball_media *b, vec3 x)
{
    float sum = 0.0f;
    for (uint64_t i = 0; i < s->glows_count; i++)
        sum += s->glows[i].power *
               ball_glow(s, &s->glows[i], x, s->field.radius);
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
 * which is to be expected. */
HD void ball_cell_run(const flat_scene *s, uint64_t brick, int i, float *cells)
{
    const radiance_lattice *f = &s->field;
    float *out = ball_cell_numbers(s, brick, i, cells);
    bool births = ball_has_births(f, out);
    if (!ball_has_events(out) && !births)
        return;
    vec3 x = radiance_middle(s, brick, i);
    ball_media b = ball_media_at(s, x, true);
    float scale = b.thickness > 0.0f ? 1.0f / b.thickness : 0.0f;
    for (int c = 0; c < 3; c++)
        out[c] *= scale;
    if (!births)
        return;
    float expected = ball_births(s, &b, x);
    out[f->births] = expected > 0.0f ? out[f->births] / expected : 1.0f;
}

#endif
