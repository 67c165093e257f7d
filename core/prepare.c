/* Unit space, camera and materials; and the order of all parts. */
#include "core/prepare.h"
#include <math.h>
#include <string.h>
#include "core/blackbody.h"
#include "core/physics/inside.h"

/* Rays end here at the latest, in scene units, as in POV-Ray. */
#define FAR 1e7

/* Bounds of what is seen of all bounded parts. */
static struct box scene_bounds(const struct assembly *a)
{
    struct box out = box_empty();
    for (size_t i = 0; i < a->parts_count; i++)
        if (box_is_bounded(&a->parts[i].seen) &&
            !box_is_empty(&a->parts[i].seen))
            out = box_hull(&out, &a->parts[i].seen);
    return out;
}

/* A power of two that brings the scene's extent near 1, so that usual numbers
 * keep their bits, and an origin only where the scene lies far from it. */
static void set_unit(struct flat *f, const struct assembly *a)
{
    struct box b = scene_bounds(a);
    double extent = 0.0, away = 0.0;
    for (int i = 0; i < 3; i++) {
        if (!(b.hi[i] >= b.lo[i]))
            continue;
        extent = fmax(extent, b.hi[i] - b.lo[i]);
        away = fmax(away, fabs(0.5 * (b.lo[i] + b.hi[i])));
    }
    if (!(extent > 0.0))
        extent = 1.0;
    int exponent;
    frexp(extent, &exponent);
    f->unit = ldexp(1.0, 1 - exponent);
    double move[3];
    for (int i = 0; i < 3; i++) {
        f->centre[i] = away > 16.0 * extent ? 0.5 * (b.lo[i] + b.hi[i]) : 0.0;
        move[i] = -f->centre[i] * f->unit;
    }
    f->to_unit = matrix_scale_move(f->unit, move);
    f->from_unit = matrix_scale_move(1.0 / f->unit, f->centre);
    f->view.unit = (float)f->unit;
    f->view.far = (float)fmax(FAR * f->unit, 1e4);
}

static vec3 make_vec3(const double v[3])
{
    return vec3_make((float)v[0], (float)v[1], (float)v[2]);
}

static vec3 unit_point(const struct flat *f, const double p[3])
{
    double q[3];
    matrix_point(&f->to_unit, p, q);
    return make_vec3(q);
}

static rgb color(const double c[3])
{
    return rgb_make((float)c[0], (float)c[1], (float)c[2]);
}

/* A perspective ray's direction is scaled to be near 1 long; only
 * orthographic extents are lengths. */
static void set_camera(struct flat *f, const struct brume_camera *c)
{
    camera *v = &f->view.view;
    const double *d = c->direction;
    double size = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    double direction[3], up[3], right[3];
    v->orthographic = c->kind == BRUME_CAMERA_ORTHOGRAPHIC;
    double scale = v->orthographic ? f->unit : 1.0 / size;
    for (int i = 0; i < 3; i++) {
        direction[i] = d[i] / size;
        up[i] = c->up[i] * scale;
        right[i] = c->right[i] * scale;
    }
    v->location = unit_point(f, c->location);
    v->direction = make_vec3(direction);
    v->up = make_vec3(up);
    v->right = make_vec3(right);
}

static void set_globals(struct flat *f, const struct brume_globals *g)
{
    flat_scene *v = &f->view;
    v->background = color(g->background);
    v->media_multiple = g->media_multiple;
    v->surfaces_indirect = g->surfaces_indirect;
    v->environment = g->environment;
    v->physical_units = g->physical_units;
}

static bool add_material(const struct prepare *job,
                         const struct brume_material *in,
                         struct brume_error *err)
{
    struct flat *f = job->flat;
    const struct brume_globals *g = &job->scene->globals;
    flat_material *out = FLAT_EXTEND(f, materials, 1, err);
    if (!out)
        return false;
    out->checker = in->pigment == BRUME_PIGMENT_CHECKER;
    out->function = in->function;
    for (int i = 0; i < 2; i++) {
        out->color[i] = color(in->color[i]);
        out->filter[i] = (float)in->color[i][3];
        out->transmit[i] = (float)in->color[i][4];
    }
    matrix placed = matrix_from(in->pigment_transform), to_pattern;
    placed = matrix_compose(&f->to_unit, &placed);
    if (!matrix_invert(&placed, &to_pattern))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "a pigment's transform has no inverse");
    out->to_pattern = matrix_affine(&to_pattern);
    rgb ambient = rgb_mul(color(in->ambient), color(g->ambient_light));
    out->ambient = g->surfaces_indirect ? rgb_gray(0.0f) : ambient;
    out->emission = color(in->emission);
    out->diffuse = (float)in->diffuse;
    out->brilliance = (float)in->brilliance;
    out->phong = (float)in->phong;
    out->phong_size = (float)in->phong_size;
    out->specular = (float)in->specular;
    out->roughness = (float)in->roughness;
    out->metallic = (float)in->metallic;
    return true;
}

static bool same_containers(const container_set *a, const container_set *b)
{
    for (int i = 0; i < a->count; i++)
        if (!container_has(b, a->shape[i]))
            return false;
    return a->count == b->count;
}

/* Whether it matters on which side of a face the eye's rays leave it. */
static bool is_on_face(const struct flat *f, const container_set *set)
{
    vec3 eye = f->view.view.location;
    for (int i = 0; i < 27; i++) {
        container_set beside;
        vec3 d = vec3_make((float)(i % 3 - 1), (float)(i / 3 % 3 - 1),
                           (float)(i / 9 - 1));
        inside_find(&f->view, inside_beside(eye, d), &beside);
        if (!same_containers(set, &beside))
            return true;
    }
    return false;
}

/* The containers of a perspective camera's eye, found once. */
static bool add_eye(struct flat *f, struct brume_error *err)
{
    container_set set;
    inside_find(&f->view, f->view.view.location, &set);
    f->view.eye_on_face = is_on_face(f, &set);
    int32_t *out = FLAT_EXTEND(f, camera_containers, (size_t)set.count, err);
    for (int i = 0; out && i < set.count; i++)
        out[i] = set.shape[i];
    return out != NULL || set.count == 0;
}

/* Made only where something burns: it takes longer than small pictures. */
static bool add_blackbody(const struct prepare *job, struct brume_error *err)
{
    const brume_scene *s = job->scene;
    blackbody_table *table = FLAT_EXTEND(job->flat, blackbody, 1, err);
    bool burns = false;
    if (!table)
        return false;
    for (size_t i = 0; i < s->media_count; i++)
        burns |= s->media[i].fire.on != 0;
    if (burns)
        blackbody_fill(table);
    else
        memset(table, 0, sizeof *table);
    return true;
}

static bool prepare_all(const struct prepare *job, const struct assembly *a,
                        struct brume_error *err)
{
    struct flat *f = job->flat;
    const brume_scene *s = job->scene;
    if (!add_blackbody(job, err))
        return false;
    set_unit(f, a);
    set_camera(f, &s->camera);
    set_globals(f, &s->globals);
    for (size_t i = 0; i < s->materials_count; i++)
        if (!add_material(job, &s->materials[i], err))
            return false;
    if (!prepare_lights(job, err) || !prepare_sky(job, err) ||
        !prepare_plate(job, err) || !prepare_shapes(job, a, err) ||
        !prepare_grids(job, a, err) || !prepare_media(job, err) ||
        !prepare_glow(job, err))
        return false;
    prepare_clear(job);
    prepare_reach(job, a);
    flat_view(f);
    if (!add_eye(f, err))
        return false;
    flat_view(f);
    return true;
}

struct flat *prepare_scene(const struct prepare *request,
                           struct brume_error *err)
{
    struct prepare job = *request;
    job.flat = flat_new(err);
    if (!job.flat)
        return NULL;
    struct assembly assembly;
    bool good = assembly_make(job.scene, -1, &assembly, err);
    if (good) {
        good = prepare_all(&job, &assembly, err);
        assembly_release(&assembly);
    }
    if (!good) {
        flat_free(job.flat);
        return NULL;
    }
    return job.flat;
}
