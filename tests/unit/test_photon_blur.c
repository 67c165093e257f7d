/* What cells blur, and second differences take out again. */
#include "tests/unit/truth.h"
#include <string.h>
#include "core/physics/radiance.h"

enum {
    SIDE = 8,
    PIXELS = SIDE * SIDE,
    BRICKS = 27,
    NUMBERS = BRICKS * 512 * 3
};

/* A field of fluence in 3 x 3 x 3 bricks, around the origin. */
struct lattice {
    flat_scene scene;
    int32_t slots[BRICKS];
};

static void lay_lattice(struct lattice *l)
{
    radiance_lattice *f = &l->scene.field;
    memset(l, 0, sizeof *l);
    f->side = 0.1f;
    f->numbers = 3;
    for (int i = 0; i < 3; i++) {
        f->bricks[i] = 3;
        f->origin[i] = -1.2f;
    }
    f->eye = f->flux = -1;
    for (int i = 0; i < BRICKS; i++)
        l->slots[i] = i;
    l->scene.radiance_slots = l->slots;
}

/* The mean of (x^2 + 2 y^2 - z^2) / 3 over a cell around p. */
static double mean_of(vec3 p, double side)
{
    double x = (double)p.x, y = (double)p.y, z = (double)p.z;
    double more = side * side / 12.0;
    return (x * x + 2.0 * y * y - z * z + 2.0 * more) / 3.0;
}

/* The mean over a cell in the middle of the lattice of what is interpolated. */
static double mean_read(const struct lattice *l, const float *cells, int axis)
{
    enum { POINTS = 16 };
    flat_scene s = l->scene;
    double sum = 0.0;
    s.radiance = cells;
    for (int i = 0; i < POINTS * POINTS * POINTS; i++) {
        const int n[3] = {i % POINTS, i / POINTS % POINTS, i / POINTS / POINTS};
        float p[3];
        for (int k = 0; k < 3; k++)
            p[k] = 0.1f *
                   (((float)n[k] + 0.5f) / POINTS + (k == axis ? 3.0f : 0.0f));
        radiance_point at = radiance_at(&s, vec3_make(p[0], p[1], p[2]),
                                        RADIANCE_ANYWHERE);
        sum += (double)at.fluence.g;
    }
    return sum / (POINTS * POINTS * POINTS);
}

/* Of a field that is curved, but no further, nothing is left of the blur. */
static void photon_blur__none_of_a_parabola(void **state)
{
    (void)state;
    static struct lattice l;
    static float means[NUMBERS], cells[NUMBERS];
    lay_lattice(&l);
    for (uint64_t b = 0; b < BRICKS; b++)
        for (int i = 0; i < 512; i++)
            for (uint64_t c = 0; c < 3; c++)
                means[(b * 512 + (uint64_t)i) * 3 + c] = (float)mean_of(
                    radiance_middle(&l.scene, b, i), 0.1);
    memcpy(cells, means, sizeof cells);
    for (uint64_t b = 0; b < BRICKS; b++)
        for (int i = 0; i < 512; i++)
            radiance_sharpen(&l.scene, means, b, i, cells);
    for (int axis = 0; axis < 3; axis++) {
        vec3 p = vec3_make(0.05f, 0.05f, 0.05f);
        float *along = axis == 0 ? &p.x : axis == 1 ? &p.y : &p.z;
        *along += 0.3f;
        double truth = mean_of(p, 0.1);
        double blurred = mean_read(&l, means, axis) - truth;
        double left = mean_read(&l, cells, axis) - truth;
        if (!(fabs(blurred) > 1e-3) || !(fabs(left) < 2e-5))
            fail_msg("axis %d: off by %g, before %g", axis, left, blurred);
    }
}

/* The mean of a scene, and its error, from pictures of several seeds. */
static double brightness(brume_scene *s, enum brume_integrator integrator,
                         double side, int seeds, double *error)
{
    double sum = 0.0, squares = 0.0;
    for (int seed = 1; seed <= seeds; seed++) {
        struct brume_options o = BRUME_OPTIONS_INIT;
        struct brume_frame f;
        double mean = 0.0;
        o.integrator = integrator;
        o.width = o.height = SIDE;
        o.spp = integrator == BRUME_INTEGRATOR_PATH ? 512 : 32;
        o.photons.count = 100000;
        o.photons.spacing = side;
        o.seed = (uint64_t)seed;
        assert_true(brume_render(s, &o, &f, truth_error()));
        for (int i = 0; i < 3 * PIXELS; i++)
            mean += (double)f.radiance[i] / (3 * PIXELS);
        sum += mean / seeds;
        squares += mean * mean / seeds;
        brume_frame_free(&f);
    }
    *error = sqrt(fmax(squares - sum * sum, 0.0) / (seeds - 1));
    return sum;
}

/* Cells of a mean free path: left as they are they make it 4 % too dark. */
static void photon_blur__little_of_thick_media(void **state)
{
    (void)state;
    struct brume_globals g = BRUME_GLOBALS_INIT;
    struct brume_light l = BRUME_LIGHT_INIT;
    struct brume_medium m = truth_medium(0.05, 8.0, 0.0);
    double error[2];
    g.media_multiple = true;
    brume_scene *s = truth_scene(&g, 5.0, 0.5);
    truth_fill(s, truth_box(1.0, -1.0, 1.0), &m);
    l.location[0] = 3.0;
    l.location[1] = 4.0;
    l.location[2] = -6.0;
    l.color[0] = l.color[1] = l.color[2] = 1.0;
    assert_true(brume_add_light(s, &l, truth_error()) >= 0);
    double truth = brightness(s, BRUME_INTEGRATOR_PATH, 0.0, 6, &error[0]);
    double is = brightness(s, BRUME_INTEGRATOR_PHOTON, 0.14, 4, &error[1]);
    if (!(fabs(is / truth - 1.0) < 0.01) ||
        !(hypot(error[0], error[1]) < 0.003 * truth))
        fail_msg("%.5f +- %.5f, path %.5f +- %.5f", is, error[1], truth,
                 error[0]);
    brume_scene_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(photon_blur__none_of_a_parabola),
        cmocka_unit_test(photon_blur__little_of_thick_media),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
