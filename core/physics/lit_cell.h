/* lit_cell.h - light straight from the lights, at points of the field. */
#ifndef CORE_PHYSICS_LIT_CELL_H
#define CORE_PHYSICS_LIT_CELL_H
#include "core/physics/ball_cell.h"

/* The streams of cells, apart from those of photons and of pixels' samples. */
#define LIT_CELL_PASS 0xfffffffcu

/* What goes on to the eye of light from wi: in a field of balls of what the
 * media scatter, else of the light, by the field's phase function `kind`. */
HD rgb lit_cell_seen(const flat_scene *s, const path_state *p,
                     const ball_media *ball, vec3 wi, int kind)
{
    const radiance_lattice *f = &s->field;
    if (f->ball)
        return ball_scattered(s, ball, p->d, wi);
    return rgb_gray(phase_eval_between(f->phase[kind], f->g[kind], p->d, wi) *
                    phase_pov_scale(f->phase[kind]) * light_medium_factor(s));
}

/* Adds that of all kinds to the numbers from `out` on. */
HD void lit_cell_add(const flat_scene *s, const path_state *p,
                     const ball_media *ball, vec3 wi, rgb in, float *out)
{
    for (int i = 0; i < radiance_phases(&s->field); i++) {
        rgb seen = rgb_mul(in, lit_cell_seen(s, p, ball, wi, i));
        for (int c = 0; c < 3; c++)
            out[3 * i + c] += rgb_get(seen, c);
    }
}

/* Where paths seek what the cells are wrong by, the light of a lamp counts as
 * from half a cell away at least: nearer, cells hold no truth of it. */
HD float lit_cell_near(const flat_scene *s, const flat_light *l,
                       float distance)
{
    float near = 0.5f * s->field.side;
    if (!s->field.lit || !l->local || !(distance < near))
        return 1.0f;
    return distance * distance / (near * near);
}

/* Adds a light's part to the numbers of the cell around x. */
HD void lit_cell_light(const flat_scene *s, int light, path_state *p, vec3 x,
                       const ball_media *ball, float *out)
{
    const radiance_lattice *f = &s->field;
    light_sample l;
    if (!s->lights[light].media_interaction ||
        !light_reach(s, light, x, &p->random, &l))
        return;
    container_set set = p->inside;
    rgb in = rgb_scale(l.color, lit_cell_near(s, &s->lights[light],
                                              l.shadow_distance));
    if (s->lights[light].shadows)
        in = rgb_mul(in, shadow_line(s, &set, x, l.shadow_wi,
                                     l.shadow_distance,
                                     line_jitter_draw(s, &p->random)));
    if (f->lit || f->eye >= 0)
        lit_cell_add(s, p, ball, l.wi, in, out + (f->lit ? f->lit : f->eye));
    if (f->lit)
        return;
    in = rgb_scale(in, light_medium_factor(s));
    for (int c = 0; c < 3; c++) {
        if (f->fluence >= 0)
            out[f->fluence + c] += rgb_get(in, c);
        for (int k = 0; f->flux >= 0 && k < 3; k++)
            out[f->flux + 3 * c + k] -= rgb_get(in, c) * vec3_get(l.wi, k);
    }
}

/* All lights, at the middle of a cell. */
HD void lit_cell(const flat_scene *s, vec3 x, rng random, float *out,
                 track_counters *count)
{
    path_state p;
    container_set set;
    ball_media ball;
    ball.count = 0;
    ball.thickness = 0.0f;
    if (s->field.ball) {
        ball = ball_media_at(s, x, BALL_SHARES, team_alone());
        if (!(ball.thickness > 0.0f))
            return;
    }
    inside_find(s, x, &set);
    path_begin(&p, x, vec3_scale(radiance_to_eye(s, x), -1.0f), &set, true,
               random);
    p.count = count;
    for (uint64_t i = 0; i < s->lights_count; i++)
        lit_cell_light(s, (int)i, &p, x, &ball, out);
}

/* Adds what photons brought and goes on to the eye, too: lines read all of it
 * as one. Where nothing is kept for the eye alone there is one phase function,
 * and it is even. */
HD void lit_cell_join(const radiance_lattice *f, float *out)
{
    int all = 3 * radiance_phases(f);
    for (int i = 0; f->lit && i < all; i++)
        out[f->lit + i] += f->eye >= 0 ? out[f->eye + i]
                                       : WARP_INV_4PI * out[f->fluence + i];
}

/* Cell i of a brick that is there, if it has so many, into its numbers. */
HD void lit_cell_run(const flat_scene *s, uint64_t seed, uint32_t frame,
                     uint64_t brick, int i, float *cells,
                     track_counters *count)
{
    const radiance_lattice *f = &s->field;
    int32_t slot = s->radiance_slots[brick];
    if (i >= 512 >> 3 * radiance_level(s, slot))
        return;
    uint64_t cell = (uint64_t)radiance_first(s, slot) + (uint64_t)i;
    float *out = cells + cell * (uint64_t)f->numbers;
    lit_cell(s, radiance_middle(s, brick, i),
             rng_make(seed, frame, LIT_CELL_PASS, cell), out, count);
    lit_cell_join(f, out);
}

#endif
