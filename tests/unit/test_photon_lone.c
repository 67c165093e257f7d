/* Photons of one medium in one container: what photon_lone.h does beside what
 * photon.h does, number by number. */
#include "tests/unit/truth_flat.h"
#include <stdlib.h>
#include <string.h>
#include "core/photons.h"
#include "core/physics/lone_lay.h"
#include "core/radiance.h"

#define PHOTONS 20000u

struct kind {
    const char *name;
    bool ball;
    double g, extinction, absorption;
    double color[3]; /* of the light, parallel or a lamp            */
    bool parallel;
    double background;
    double lamp[3];
};

static brume_scene *make_scene(const struct kind *k)
{
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    globals.media_multiple = globals.surfaces_indirect = true;
    globals.environment = k->background > 0.0;
    for (int i = 0; i < 3; i++)
        globals.background[i] = k->background;
    brume_scene *s = truth_scene(&globals, 5.0, 1.0);
    struct brume_medium m = truth_medium(k->absorption, 8.0, k->g);
    m.extinction = k->extinction;
    struct brume_shape shape = truth_box(1.0, -1.0, 1.0);
    if (k->ball) {
        struct brume_shape b = BRUME_SHAPE_INIT;
        b.kind = BRUME_SHAPE_SPHERE;
        b.radius = 0.9;
        shape = b;
    }
    truth_fill(s, shape, &m);
    struct brume_light l = BRUME_LIGHT_INIT;
    for (int i = 0; i < 3; i++) {
        l.color[i] = k->color[i];
        l.location[i] = k->lamp[i];
        l.point_at[i] = 0.0;
    }
    l.parallel = k->parallel;
    if (k->color[0] > 0.0)
        assert_true(brume_add_light(s, &l, truth_error()) >= 0);
    return s;
}

/* The whole of a photon, as a backend's trace stage has it. */
static void run_one(const flat_scene *s, const lone_scene *l,
                    const photon_job *job, uint64_t i, photon_counters *c)
{
    lone_photon p;
    lone_rest w;
    uint32_t words[LONE_WORDS];
    lone_end f;
    lone_line line;
    lone_walk lays;
    lone_counts n;
    memset(&n, 0, sizeof n);
    memset(&p, 0, sizeof p);
    memset(&f, 0, sizeof f);
    int next = lone_begin(s, l, job, i, &p, &w, c) ? LONE_FLIES : LONE_ENDS;
    while (next != LONE_ENDS)
        switch (next) {
        case LONE_FLIES:
            while (lone_ready(&p.numbers) < LONE_NEEDS)
                lone_draw(l, w.path, &p.numbers, words);
            next = lone_fly(l, &p, &w, words, &f, &n);
            break;
        case LONE_SEEKS:
            lone_seek(s, l, &p, &w);
            next = LONE_FLIES;
            break;
        case LONE_LAYS:
            if (lone_lays(s, l, &p, &f, &line, &lays))
                while (lone_lay(s, l, c->tally.sum, &n, &line, &lays))
                    ;
            next = LONE_LANDS;
            break;
        default:
            next = lone_land(s, l, &p, &w, words, &f, &n);
        }
#define X(book) c->books.book += n.book;
    LONE_BOOKS(X)
#undef X
    c->events += n.events;
    c->tally.clipped += n.clipped;
    c->track.rays += n.rays;
    c->track.lookups += n.lookups;
}

static void same_book(const char *name, const char *what, double a, double b)
{
    if (!(fabs(a - b) <= 1e-9 * fmax(fabs(a), 1.0)))
        fail_msg("%s: %s %.12g, not %.12g", name, what, b, a);
}

static void same_count(const char *name, const char *what, uint64_t a,
                       uint64_t b)
{
    if (a != b)
        fail_msg("%s: %llu %s, not %llu", name, (unsigned long long)b, what,
                 (unsigned long long)a);
}

static void check_kind(const struct kind *k)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    o.integrator = BRUME_INTEGRATOR_PHOTON;
    o.photons.count = PHOTONS;
    brume_scene *scene = make_scene(k);
    struct flat *flat = truth_layout(scene, &o);
    struct photons photons;
    lone_scene l;
    photon_counters c[2];
    size_t n = flat->radiance_count;
    const flat_scene *s = &flat->view;
    memset(c, 0, sizeof c);
    assert_true(n > 0);
    assert_true(photons_plan(flat, &o, 0, &photons, truth_error()));
    for (int i = 0; i < 2; i++) {
        c[i].tally.sum = calloc(n, sizeof(int64_t));
        assert_non_null(c[i].tally.sum);
    }
    assert_true(photons_lone(s, o.seed, o.frame, &l));
    assert_true(l.ball == k->ball);
    photon_run(s, &photons.job, 0, PHOTONS, &c[0]);
    for (uint64_t i = 0; i < PHOTONS; i++)
        run_one(s, &l, &photons.job, i, &c[1]);
    same_count(k->name, "events", c[0].events, c[1].events);
    same_count(k->name, "rays", c[0].track.rays, c[1].track.rays);
    same_count(k->name, "lookups", c[0].track.lookups, c[1].track.lookups);
    same_count(k->name, "clipped", c[0].tally.clipped, c[1].tally.clipped);
#define X(book) same_book(k->name, #book, c[0].books.book, c[1].books.book);
    PHOTON_BOOKS(X)
#undef X
    if (memcmp(c[0].tally.sum, c[1].tally.sum, n * sizeof(int64_t)) != 0)
        fail_msg("%s: the sums differ", k->name);
    assert_true(c[0].events > PHOTONS / 4);
    for (int i = 0; i < 2; i++)
        free(c[i].tally.sum);
    photons_release(&photons);
    flat_free(flat);
    brume_scene_free(scene);
}

static const struct kind kinds[] = {
    {"gray beam", false, 0.01, 1.0, 0.2, {1, 1, 1}, true, 0.0, {-100, 3, 7}},
    {"coloured beam",
     false,
     0.6,
     1.0,
     0.2,
     {1, 0.8, 0.5},
     true,
     0.0,
     {-100, 0, 0}},
    {"extinction", false, -0.4, 1.5, 0.1, {1, 1, 1}, true, 0.0, {-10, 5, 7}},
    {"less extinction",
     false,
     0.0,
     0.5,
     0.1,
     {1, 1, 1},
     true,
     0.0,
     {-10, 5, 7}},
    {"ball", true, 0.8, 1.0, 0.0, {1, 1, 1}, false, 0.0, {-2, 1, 2}},
    {"lamp within",
     false,
     0.3,
     1.0,
     0.3,
     {1, 1, 1},
     false,
     0.0,
     {0.3, 0.2, 0.1}},
    {"sky", false, 0.3, 1.0, 0.3, {0, 0, 0}, true, 0.7, {0, 0, 0}},
    {"sky and lamp",
     true,
     0.0,
     1.0,
     0.3,
     {1, 0.5, 0.5},
     false,
     0.7,
     {0, 0, -3}},
};

static void photon_lone__has_every_bit(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        check_kind(&kinds[i]);
}

/* A surface, a second shape, an atmosphere: the general way. */
static void photon_lone__is_for_one_container(void **state)
{
    (void)state;
    struct brume_options o = BRUME_OPTIONS_INIT;
    o.integrator = BRUME_INTEGRATOR_PHOTON;
    o.photons.count = 16;
    for (int i = 0; i < 2; i++) {
        brume_scene *scene = make_scene(&kinds[0]);
        struct brume_shape b = BRUME_SHAPE_INIT;
        struct brume_material m = BRUME_MATERIAL_INIT;
        struct photons photons;
        lone_scene l;
        b.kind = BRUME_SHAPE_SPHERE;
        b.radius = 0.1;
        b.material = brume_add_material(scene, &m, truth_error());
        if (i > 0)
            assert_true(brume_add_shape(scene, &b, truth_error()) >= 0);
        struct flat *flat = truth_layout(scene, &o);
        assert_true(photons_plan(flat, &o, 0, &photons, truth_error()));
        assert_true(photons_lone(&flat->view, o.seed, o.frame, &l) == (i == 0));
        photons_release(&photons);
        flat_free(flat);
        brume_scene_free(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(photon_lone__has_every_bit),
        cmocka_unit_test(photon_lone__is_for_one_container),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
