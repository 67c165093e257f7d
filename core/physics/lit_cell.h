/* lit_cell.h - light straight from the lights, at points of the field. */
#ifndef CORE_PHYSICS_LIT_CELL_H
#define CORE_PHYSICS_LIT_CELL_H
#include "core/physics/ball_cell.h"

/* The streams of cells, apart from those of photons and of pixels' samples. */
#define LIT_CELL_PASS 0xfffffffcu

/* The light of one cell after the other, in steps: what is next of it. */
enum { LIT_TAKES, LIT_CHOOSES, LIT_SEEKS, LIT_STEPS, LIT_LANDS, LIT_ENDS };

typedef struct {
    int32_t light;          /* that is next                                */
    float *out;             /* the cell's numbers                          */
    vec3 x, d;              /* its middle; d: from the eye                 */
    container_set inside;   /* around it                                   */
    ball_media ball;        /* of a field of balls: what scatters in it    */
    rng random;
    vec3 wi;                /* toward the light                            */
    rgb in;                 /* what comes where nothing is in the way      */
    shadow_way way;
} lit_task;

/* Of it, what each step of a line has to do with: a GPU keeps it in registers,
 * and the rest in memory. */
typedef struct {
    int32_t next;           /* LIT_*                                       */
    line_integral line;
    line_flight flight;
} lit_liner;

/* What goes on to the eye of light from wi: in a field of balls of what the
 * media scatter, else of the light, by the field's phase function `kind`. */
HD rgb lit_cell_seen(const flat_scene *s, const lit_task *t, int kind)
{
    const radiance_lattice *f = &s->field;
    if (f->ball)
        return ball_scattered(s, &t->ball, t->d, t->wi);
    return rgb_gray(phase_eval_between(f->phase[kind], f->g[kind], t->d,
                                       t->wi) *
                    phase_pov_scale(f->phase[kind]) * light_medium_factor(s));
}

/* Adds that of all kinds to the numbers from `out` on. */
HD void lit_cell_add(const flat_scene *s, const lit_task *t, rgb in,
                     float *out)
{
    for (int i = 0; i < radiance_phases(&s->field); i++) {
        rgb seen = rgb_mul(in, lit_cell_seen(s, t, i));
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

/* Adds what a light gives to the cell's numbers. */
HD void lit_cell_light(const flat_scene *s, const lit_task *t, rgb in)
{
    const radiance_lattice *f = &s->field;
    if (f->lit || f->eye >= 0)
        lit_cell_add(s, t, in, t->out + (f->lit ? f->lit : f->eye));
    if (f->lit)
        return;
    in = rgb_scale(in, light_medium_factor(s));
    for (int c = 0; c < 3; c++) {
        if (f->fluence >= 0)
            t->out[f->fluence + c] += rgb_get(in, c);
        for (int k = 0; f->flux >= 0 && k < 3; k++)
            t->out[f->flux + 3 * c + k] -= rgb_get(in, c) *
                                           vec3_get(t->wi, k);
    }
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

/* Whether light may be scattered around cell i of a brick that is there, if it
 * has so many: a glance. */
HD bool lit_cell_may(const flat_scene *s, uint64_t brick, int i)
{
    return i < 512 >> 3 * radiance_level(s, s->radiance_slots[brick]) &&
           !(s->field.ball &&
             ball_is_empty(s, radiance_middle(s, brick, i)));
}

/* What is next: a light, or the next cell. */
HD int32_t lit_go_on(const flat_scene *s, const lit_task *t)
{
    if (t->light < (int)s->lights_count)
        return LIT_CHOOSES;
    lit_cell_join(&s->field, t->out);
    return LIT_TAKES;
}

/* Takes cell i of a brick that is there, of which lit_cell_may. */
HD void lit_take(const flat_scene *s, uint64_t seed, uint32_t frame,
                 uint64_t brick, int i, float *cells, lit_task *t,
                 lit_liner *l)
{
    uint64_t cell = (uint64_t)radiance_first(s, s->radiance_slots[brick]) +
                    (uint64_t)i;
    vec3 x = radiance_middle(s, brick, i);
    l->next = LIT_TAKES;
    t->ball.count = 0;
    t->ball.thickness = 0.0f;
    if (s->field.ball) {
        t->ball = ball_media_at(s, x, BALL_SHARES, team_alone());
        if (!(t->ball.thickness > 0.0f))
            return;
    }
    t->light = 0;
    t->out = cells + cell * (uint64_t)s->field.numbers;
    t->x = x;
    t->d = vec3_scale(radiance_to_eye(s, x), -1.0f);
    t->random = rng_make(seed, frame, LIT_CELL_PASS, cell);
    inside_find(s, x, &t->inside);
    l->next = lit_go_on(s, t);
}

/* The next light, and what comes of it where nothing is in the way. */
HD void lit_choose(const flat_scene *s, lit_task *t, lit_liner *l)
{
    int i = t->light++;
    const flat_light *light = &s->lights[i];
    light_sample at;
    if (!light->media_interaction ||
        !light_reach(s, i, t->x, &t->random, &at)) {
        l->next = lit_go_on(s, t);
        return;
    }
    t->wi = at.wi;
    t->in = rgb_scale(at.color, lit_cell_near(s, light, at.shadow_distance));
    if (light->shadows) {
        t->way = shadow_begin(&t->inside, t->x, at.shadow_wi,
                              at.shadow_distance,
                              line_jitter_draw(s, &t->random));
        l->line = line_zero();
        l->next = LIT_SEEKS;
        return;
    }
    lit_cell_light(s, t, t->in);
    l->next = lit_go_on(s, t);
}

HD void lit_seek(const flat_scene *s, lit_task *t, lit_liner *l)
{
    l->next = shadow_look(s, &t->way, &l->line, &l->flight) ? LIT_STEPS
                                                            : LIT_LANDS;
}

/* Over a piece in which there is nothing more. */
HD void lit_skip(const flat_scene *s, lit_liner *l)
{
    if (line_passed_piece(&l->flight) && !line_next_piece(s, &l->flight))
        l->next = LIT_LANDS;
}

/* Along a piece, if there is something. */
HD void lit_step(const flat_scene *s, lit_liner *l)
{
    if (!line_passed_piece(&l->flight))
        line_add_stretch(s, &l->flight, line_find_stop(&l->flight), &l->line);
}

HD void lit_land(const flat_scene *s, lit_task *t, lit_liner *l)
{
    l->next = LIT_SEEKS;
    if (shadow_land(s, &t->way, &l->line))
        return;
    lit_cell_light(s, t, rgb_mul(t->in, t->way.left));
    l->next = lit_go_on(s, t);
}

/* The whole of a cell. */
HD void lit_cell_run(const flat_scene *s, uint64_t seed, uint32_t frame,
                     uint64_t brick, int i, float *cells)
{
    lit_task t;
    lit_liner l;
    if (!lit_cell_may(s, brick, i))
        return;
    lit_take(s, seed, frame, brick, i, cells, &t, &l);
    while (l.next != LIT_TAKES) {
        if (l.next == LIT_CHOOSES)
            lit_choose(s, &t, &l);
        if (l.next == LIT_SEEKS)
            lit_seek(s, &t, &l);
        while (l.next == LIT_STEPS) {
            lit_skip(s, &l);
            if (l.next == LIT_STEPS)
                lit_step(s, &l);
        }
        if (l.next == LIT_LANDS)
            lit_land(s, &t, &l);
    }
}

#endif
