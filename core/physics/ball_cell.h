/* ball_cell.h - what of the media lies in the ball of a cell.
 *
 * Events in a ball, over its volume, are what is scattered there on average:
 * where a medium thickens within the ball, light would seem to come from its
 * thin part too, through which more of it is seen. So a cell keeps what is
 * scattered per thickness of the media, both of them means over its ball, and
 * the eye's rays give it back by the thickness where they pass. This is the
 * published sum times sigma_s (PAPER.md, section 1) with the factor that it
 * lacks, 1 / sigma_s, of the ball. */
#ifndef CORE_PHYSICS_BALL_CELL_H
#define CORE_PHYSICS_BALL_CELL_H
#include "core/physics/inside.h"
#include "core/physics/path.h"

/* Points of a ball that tell of it: pairs, of which linear densities come out
 * exactly. */
enum { BALL_PAIRS = 16 };

/* Mean densities of the media in a ball. */
typedef struct {
    int32_t count;
    int32_t medium[MAX_ACTIVE];
    rgb density[MAX_ACTIVE];
    float thickness;
} ball_media;

/* The k-th offset, of a ball of radius 1: even in volume and direction, by
 * multiples of powers of the generalised golden ratio, x^4 = x + 1 [Roberts
 * 2018]. */
HD vec3 ball_offset(int k)
{
    float u[3];
    const float step[3] = {0.819172513f, 0.671043607f, 0.549700478f};
    for (int i = 0; i < 3; i++) {
        float x = 0.5f + step[i] * (float)(k + 1);
        u[i] = x - (float)hd_floor(x);
    }
    return vec3_scale(warp_sphere(u[0], u[1]), fm_pow(u[2], 1.0f / 3.0f));
}

HD void ball_add(const flat_scene *s, ball_media *b, int32_t medium, vec3 x)
{
    const flat_medium *m = &s->media[medium];
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
    field_point at = field_point_make(s, m->lead, x);
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

/* The media of the field's ball around x. */
HD ball_media ball_media_at(const flat_scene *s, vec3 x)
{
    ball_media b;
    b.count = 0;
    b.thickness = 0.0f;
    for (int k = 0; k < 2 * BALL_PAIRS; k++) {
        float r = k & 1 ? -s->field.radius : s->field.radius;
        ball_add_point(s, &b, vec3_mad(x, r, ball_offset(k / 2)));
    }
    for (int i = 0; i < part_bound(b.count); i++) {
        rgb *density = &b.density[part_place(i)];
        *density = rgb_scale(*density, 0.5f / (float)BALL_PAIRS);
        b.thickness += radiance_thickness(
            s, &s->media[b.medium[part_place(i)]], *density);
    }
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
        const flat_medium *m = &s->media[b->medium[part_place(i)]];
        rgb sigma = rgb_mul(m->sigma_s, b->density[part_place(i)]);
        float phase = phase_eval_between(m->phase, m->g, d, wi) *
                      phase_pov_scale(m->phase);
        sum = rgb_add(sum, rgb_scale(sigma, phase));
    }
    return rgb_scale(sum, light_medium_factor(s) / b->thickness);
}

/* Turns the events of cell i of a brick that is there, over the volume of its
 * ball, into those per thickness. */
HD void ball_cell_run(const flat_scene *s, uint64_t brick, int i, float *cells)
{
    const radiance_lattice *f = &s->field;
    uint64_t cell = (uint64_t)s->radiance_slots[brick] * 512u + (uint64_t)i;
    float *out = cells + cell * (uint64_t)f->numbers;
    if (out[0] == 0.0f && out[1] == 0.0f && out[2] == 0.0f)
        return;
    ball_media b = ball_media_at(s, radiance_middle(s, brick, i));
    float scale = b.thickness > 0.0f ? 1.0f / b.thickness : 0.0f;
    for (int c = 0; c < 3; c++)
        out[c] *= scale;
}

#endif
