/* Light straight from the lights into the field: a cell at a time. */
#include "core/cpu/cpu.h"
#include "core/physics/lit_cell.h"
#include "lib/thread.h"

/* The streams of cells. */
#define SINGLE_PASS (PHOTON_PASS - 3u)

struct single {
    const flat_scene *scene;
    uint64_t seed;
    uint32_t frame;
    float *cells;
};

static void light_cell(const struct single *job, const int32_t at[3],
                       int64_t cell)
{
    const radiance_lattice *f = &job->scene->field;
    track_counters count = {0};
    vec3 x = vec3_make(f->origin[0] + ((float)at[0] + 0.5f) * f->side,
                       f->origin[1] + ((float)at[1] + 0.5f) * f->side,
                       f->origin[2] + ((float)at[2] + 0.5f) * f->side);
    lit_cell(job->scene, x,
             rng_make(job->seed, job->frame, SINGLE_PASS, (uint64_t)cell),
             job->cells + cell * f->numbers, &count);
}

static void light_brick(void *context, size_t index, int thread)
{
    (void)thread;
    const struct single *job = context;
    const radiance_lattice *f = &job->scene->field;
    int32_t x = 8 * (int32_t)(index % (size_t)f->bricks[0]);
    int32_t y = 8 *
                (int32_t)(index / (size_t)f->bricks[0] % (size_t)f->bricks[1]);
    int32_t z = 8 *
                (int32_t)(index / (size_t)f->bricks[0] / (size_t)f->bricks[1]);
    if (job->scene->radiance_slots[index] < 0)
        return;
    for (int i = 0; i < 512; i++) {
        int32_t at[3] = {x + (i & 7), y + (i >> 3 & 7), z + (i >> 6)};
        light_cell(job, at, radiance_cell(job->scene, at[0], at[1], at[2]));
    }
}

bool cpu_single(void *state, float *cells)
{
    struct cpu_state *s = state;
    const flat_scene *v = &s->frame.flat->view;
    struct single job = {v, s->job.seed, s->job.frame, cells};
    atomic_store(&s->stop, false);
    return parallel_for(s->threads, (size_t)v->radiance_slots_count,
                        light_brick, &job, &s->stop);
}
