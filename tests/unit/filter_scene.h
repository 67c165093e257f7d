/* filter_scene.h - a ball of fog, frame by frame, and its fields. */
#ifndef TESTS_FILTER_SCENE_H
#define TESTS_FILTER_SCENE_H
#include "core/filter.h"
#include "core/frame.h"
#include "tests/unit/truth.h"

enum { SIDE = 8, PIXELS = SIDE * SIDE, PHOTONS = 2000 };

/* At x, seen from `eye`, both along the first axis; lit from above by a lamp;
 * g as Henyey and Greenstein have it; and how far its velocity says that it
 * moves in a frame, 0: it has none. */
struct fog {
    double x, eye, g, lamp, drift;
};

static inline int fog_component(brume_scene *s, double value)
{
    static const int32_t origin[3] = {0, 0, 0}, bricks[3] = {1, 1, 1};
    struct grid *g = grid_new(origin, bricks, (float)value, truth_error());
    assert_non_null(g);
    for (int i = 0; i < 3; i++)
        g->to_world[i][i] = 1.0;
    g->any_sign = true;
    int id = brume_add_grid(s, g, truth_error());
    assert_true(id >= 0);
    grid_free(g);
    return id;
}

static inline brume_scene *fog_scene(const struct fog *f)
{
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    struct brume_camera camera = BRUME_CAMERA_INIT;
    struct brume_light lamp = BRUME_LIGHT_INIT;
    struct brume_medium m = truth_medium(0.3, 3.0, f->g);
    struct brume_shape ball = BRUME_SHAPE_INIT;
    globals.media_multiple = true;
    brume_scene *s = truth_scene(&globals, 4.0, 1.0);
    camera.location[0] = f->eye;
    camera.location[2] = -4.0;
    assert_true(brume_set_camera(s, &camera, truth_error()));
    lamp.location[1] = 5.0;
    for (int i = 0; i < 3; i++)
        lamp.color[i] *= f->lamp;
    assert_true(brume_add_light(s, &lamp, truth_error()) >= 0);
    ball.a[0] = f->x;
    m.velocity.on = f->drift != 0.0;
    for (int i = 0; m.velocity.on && i < 3; i++)
        m.velocity.grid[i] = fog_component(s, i == 0 ? f->drift : 0.0);
    truth_fill(s, ball, &m);
    return s;
}

static inline struct brume_options fog_options(int taps, uint32_t frame)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    o.width = o.height = SIDE;
    o.integrator = BRUME_INTEGRATOR_PHOTON;
    o.backend = BRUME_BACKEND_CPU;
    o.spp = 2;
    o.frame = frame;
    o.photons.count = PHOTONS;
    o.photons.spacing = 0.125;
    assert_true(brume_film_taps(&o.photons, taps));
    return o;
}

/* The field of a frame, and the flat scene that a filter fills; frees the
 * scene. */
static inline struct flat *fog_trace(brume_scene *scene,
                                     const struct brume_options *o,
                                     struct filter_field *field)
{
    static struct brume_frame out;
    static struct frame_job job;
    assert_true(frame_open(&job, scene, o, &out, truth_error()));
    assert_true(frame_trace(&job, truth_error()));
    assert_true(filter_keep(job.flat, job.power, field, truth_error()));
    brume_scene_free(scene);
    struct flat *flat = job.flat;
    job.flat = NULL;
    return flat;
}
#endif
