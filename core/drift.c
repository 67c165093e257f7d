#include "core/drift.h"
#include <math.h>
#include <stdlib.h>
#include "core/physics/medium.h"
#include "core/physics/radiance.h"
#include "core/radiance.h"
#include "lib/memory.h"
#include "lib/thread.h"

/* One component of a medium's velocity. */
struct component {
    const struct grid *grid;
    matrix to_index; /* from the scene's space                      */
};

struct stream {
    size_t medium;
    struct component component[3];
    matrix to_cells; /* from a grid's numbers, without its move     */
};

struct streams {
    struct flat *flat;
    struct stream *stream;
    size_t count;
};

/* ---- velocities --------------------------------------------------------- */

static double sample(const struct component *c, const double scene[3])
{
    double p[3], sum = 0.0, fraction[3];
    int low[3];
    matrix_point(&c->to_index, scene, p);
    for (int i = 0; i < 3; i++) {
        double whole = fmin(fmax(floor(p[i]), -1e9), 1e9);
        low[i] = (int)whole;
        fraction[i] = fmin(fmax(p[i] - whole, 0.0), 1.0);
    }
    for (int k = 0; k < 8; k++) {
        double weight = 1.0;
        for (int i = 0; i < 3; i++)
            weight *= k >> i & 1 ? fraction[i] : 1.0 - fraction[i];
        if (weight > 0.0)
            sum += weight * (double)grid_sample(c->grid, low[0] + (k & 1),
                                                low[1] + (k >> 1 & 1),
                                                low[2] + (k >> 2));
    }
    return sum;
}

static bool open_stream(const brume_scene *scene, const struct flat *flat,
                        size_t medium, struct stream *out,
                        struct brume_error *err)
{
    const struct brume_velocity *v = &scene->media[medium].velocity;
    matrix placed = matrix_from(v->transform);
    out->medium = medium;
    for (int i = 0; i < 3; i++) {
        const struct grid *grid = scene->grids[v->grid[i]];
        matrix to_world = matrix_from(grid->to_world);
        matrix to_scene = matrix_compose(&placed, &to_world);
        out->component[i].grid = grid;
        if (!matrix_invert(&to_scene, &out->component[i].to_index))
            return brume_fail(err, BRUME_ERR_SCENE,
                              "the place of a velocity in the scene has no "
                              "inverse");
        out->to_cells = v->voxels ? to_scene : placed;
    }
    double scale = v->scale * flat->unit / (double)flat->view.field.side;
    for (int i = 0; i < 12; i++)
        out->to_cells.m[i / 4][i % 4] *= scale;
    return true;
}

/* Of a medium that scatters there, by how much it does. */
static double weight_of(const struct flat *flat, const struct stream *s, vec3 p)
{
    const flat_medium *m = &flat->media[s->medium];
    int32_t lead = m->densities > 0 ? m->density[0] : -1;
    field_point x = field_point_make(&flat->view, lead, p);
    rgb density = medium_density(&flat->view, m, &x);
    return (double)rgb_mean(rgb_mul(density, m->sigma_s));
}

/* Media that move through each other count by what they scatter, or alike
 * where none does. */
static void drift_at(const struct streams *s, vec3 p, float out[3])
{
    const struct flat *flat = s->flat;
    double at[3], sum[3] = {0}, weights = 0.0;
    for (int i = 0; i < 3; i++)
        at[i] = (double)vec3_get(p, i) / flat->unit + flat->centre[i];
    for (size_t k = 0; k < s->count; k++) {
        const struct stream *stream = &s->stream[k];
        double weight = s->count > 1 ? 1e-30 + weight_of(flat, stream, p) : 1.0;
        double v[3], moved[3];
        for (int i = 0; i < 3; i++)
            v[i] = sample(&stream->component[i], at);
        matrix_vector(&stream->to_cells, v, moved);
        weights += weight;
        for (int i = 0; i < 3; i++)
            sum[i] += weight * moved[i];
    }
    for (int i = 0; i < 3; i++)
        out[i] = (float)(sum[i] / weights);
}

/* ---- blocks ------------------------------------------------------------- */

static void drift_of_brick(void *context, size_t index, int thread)
{
    (void)thread;
    const struct streams *s = context;
    struct flat *flat = s->flat;
    const radiance_lattice *f = &flat->view.field;
    int32_t slot = flat->radiance_slots[index];
    if (slot < 0)
        return;
    float *out = flat->drift + (size_t)slot * DRIFT_BLOCKS * 3;
    for (int i = 0; i < DRIFT_BLOCKS; i++, out += 3) {
        int cell = 2 * (i & 3) + 16 * (i >> 2 & 3) + 128 * (i >> 4);
        vec3 p = radiance_middle(&flat->view, index, cell);
        float half = 0.5f * f->side;
        drift_at(s, vec3_add(p, vec3_make(half, half, half)), out);
    }
}

static bool moves(const brume_scene *scene, size_t medium)
{
    const struct brume_medium *m = &scene->media[medium];
    return m->velocity.on && (m->scattering[0] > 0.0 ||
                              m->scattering[1] > 0.0 || m->scattering[2] > 0.0);
}

static bool find_streams(const brume_scene *scene, struct streams *s,
                         struct brume_error *err)
{
    s->stream = memory_new(scene->media_count, sizeof *s->stream, err);
    if (!s->stream)
        return false;
    for (size_t i = 0; i < scene->media_count; i++)
        if (moves(scene, i) &&
            !open_stream(scene, s->flat, i, &s->stream[s->count++], err))
            return false;
    return true;
}

bool drift_find(const brume_scene *scene, struct flat *flat, int threads,
                struct brume_error *err)
{
    struct streams s = {.flat = flat};
    bool good = find_streams(scene, &s, err);
    if (good && s.count > 0 && flat->radiance_count > 0) {
        size_t bricks = radiance_cells(flat) / 512;
        flat->drift = memory_new(bricks * DRIFT_BLOCKS * 3, sizeof *flat->drift,
                                 err);
        good = flat->drift != NULL;
        if (good)
            parallel_for(threads, flat->radiance_slots_count, drift_of_brick,
                         &s, NULL);
    }
    free(s.stream);
    return good;
}
