/* The gather stage: from sums to the field, and light straight from the lights
 * into it, a brick at a time. */
#include "core/cpu/cpu.h"
#include <string.h>
#include "core/physics/half.h"
#include "core/physics/lit_cell.h"
#include "core/radiance.h"
#include "lib/thread.h"

static void ball_brick(void *context, size_t index, int thread)
{
    (void)thread;
    const struct cpu_state *s = context;
    const flat_scene *v = &s->frame.flat->view;
    for (int i = 0; i < 512 && v->radiance_slots[index] >= 0; i++)
        ball_cell_run(v, index, i, s->frame.flat->radiance, team_alone());
}

static void light_brick(void *context, size_t index, int thread)
{
    (void)thread;
    const struct cpu_state *s = context;
    const flat_scene *v = &s->frame.flat->view;
    if (v->radiance_slots[index] < 0)
        return;
    for (int i = 0; i < 512; i++)
        lit_cell_run(v, s->job.seed, s->job.frame, index, i,
                     s->frame.flat->radiance);
}

static void sharpen_brick(void *context, size_t index, int thread)
{
    (void)thread;
    const struct cpu_state *s = context;
    const flat_scene *v = &s->frame.flat->view;
    for (int i = 0; i < 512 && v->radiance_slots[index] >= 0; i++)
        radiance_sharpen(v, (const float *)s->sum, index, i,
                         s->frame.flat->radiance);
}

/* The means stand where the sums were that they are of. */
static void sharpen(struct cpu_state *s)
{
    struct flat *flat = s->frame.flat;
    memcpy(s->sum, flat->radiance,
           (size_t)flat->radiance_count * sizeof *flat->radiance);
    parallel_for(s->threads, (size_t)flat->radiance_slots_count, sharpen_brick,
                 s, &s->stop);
}

bool cpu_halve(void *state, double unit, float *blocks, struct brume_error *err)
{
    (void)err;
    const struct cpu_state *s = state;
    const radiance_lattice *f = &s->frame.flat->view.field;
    double scale = radiance_scale(f, unit);
    size_t count = radiance_blocks(s->frame.flat);
    for (size_t i = 0; i < count; i++)
        blocks[i] = half_block(f, s->sum, i, scale);
    return true;
}

bool cpu_gather(void *state, double unit, struct brume_error *err)
{
    struct cpu_state *s = state;
    struct flat *flat = s->frame.flat;
    const radiance_lattice *f = &flat->view.field;
    size_t bricks = (size_t)flat->radiance_slots_count;
    atomic_store(&s->stop, false);
    if (unit > 0.0)
        radiance_resolve(flat, s->sum, unit);
    if (backend_sharpens(&s->frame))
        sharpen(s);
    bool good = !(unit > 0.0 && f->ball) ||
                parallel_for(s->threads, bricks, ball_brick, s, &s->stop);
    good = good && (!(f->single || f->lit) ||
                    parallel_for(s->threads, bricks, light_brick, s, &s->stop));
    return good || brume_fail(err, BRUME_STOPPED, "the rendering was stopped");
}
