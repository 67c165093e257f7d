/* Checks and copies of shapes, a row a kind. */
#include "core/shapes.h"
#include <stdlib.h>
#include <string.h>
#include "core/check.h"
#include "lib/memory.h"

/* How many numbers `data` must have. */
struct rule {
    const char *name;
    size_t least;    /* numbers in data                             */
    size_t multiple; /* they come by so many; 0: exactly the least */
    bool signed_radii;
    bool ready; /* what follows the API can use it             */
};

static const struct rule rules[] = {
    [BRUME_SHAPE_SPHERE] = {"a sphere", 0, 0, false, true},
    [BRUME_SHAPE_BOX] = {"a box", 0, 0, false, true},
    [BRUME_SHAPE_CYLINDER] = {"a cylinder", 0, 0, false, true},
    [BRUME_SHAPE_CONE] = {"a cone", 0, 0, false, true},
    [BRUME_SHAPE_PLANE] = {"a plane", 0, 0, true, true},
    [BRUME_SHAPE_DISC] = {"a disc", 0, 0, false, true},
    [BRUME_SHAPE_MESH] = {"a mesh", 0, 0, false, true},
    [BRUME_SHAPE_TORUS] = {"a torus", 0, 0, false, true},
    [BRUME_SHAPE_QUADRIC] = {"a quadric", 10, 0, true, true},
    [BRUME_SHAPE_POLY] = {"a poly", 0, 1, true, true},
    [BRUME_SHAPE_SUPERELLIPSOID] = {"a superellipsoid", 0, 0, true, true},
    [BRUME_SHAPE_OVUS] = {"an ovus", 0, 0, true, true},
    [BRUME_SHAPE_BLOB] = {"a blob", BRUME_BLOB_NUMBERS, BRUME_BLOB_NUMBERS,
                          true, true},
    [BRUME_SHAPE_LATHE] = {"a lathe", 4, 2, true, true},
    [BRUME_SHAPE_PRISM] = {"a prism", 6, 2, true, true},
    [BRUME_SHAPE_SOR] = {"a sor", 8, 2, true, true},
    [BRUME_SHAPE_SPHERE_SWEEP] = {"a sphere_sweep", 8, 4, true, true},
    [BRUME_SHAPE_JULIA] = {"a julia_fractal", 11, 0, true, true},
    [BRUME_SHAPE_ISOSURFACE] = {"an isosurface", 0, 0, false, true},
    [BRUME_SHAPE_PARAMETRIC] = {"a parametric", 4, 0, false, true},
    [BRUME_SHAPE_POLYGON] = {"a polygon", 9, 3, true, true},
    [BRUME_SHAPE_BICUBIC_PATCH] = {"a bicubic_patch", 48, 0, true, true},
    [BRUME_SHAPE_HEIGHT_FIELD] = {"a height_field", 4, 1, true, true},
    [BRUME_SHAPE_TEXT] = {"a text", 0, 1, true, true},
    [BRUME_SHAPE_UNION] = {"a union", 0, 0, true, true},
    [BRUME_SHAPE_MERGE] = {"a merge", 0, 0, true, true},
    [BRUME_SHAPE_INTERSECTION] = {"an intersection", 0, 0, true, true},
    [BRUME_SHAPE_DIFFERENCE] = {"a difference", 0, 0, true, true},
};
enum { KINDS = sizeof rules / sizeof *rules };

const char *shape_name(enum brume_shape_kind kind)
{
    return rules[kind].name;
}

bool shape_is_composite(const struct brume_shape *s)
{
    return s->kind >= BRUME_SHAPE_UNION && s->kind <= BRUME_SHAPE_DIFFERENCE;
}

static bool check_data(const struct brume_shape *s, struct brume_error *err)
{
    const struct rule *r = &rules[s->kind];
    bool good = r->multiple == 0
                    ? s->count == r->least
                    : s->count >= r->least && s->count % r->multiple == 0;
    if (!good)
        return brume_fail(err, BRUME_ERR_SCENE, "%s has %zu numbers", r->name,
                          s->count);
    return check_finite(s->data, s->count, r->name, err);
}

static bool check_parts(const brume_scene *scene, const struct brume_shape *s,
                        struct brume_error *err)
{
    for (size_t i = 0; i < s->part_count; i++)
        if (!check_id(s->parts[i], scene->shapes_count, false, "shape", err))
            return false;
    for (size_t i = 0; i < s->clip_count; i++)
        if (!check_id(s->clips[i], scene->shapes_count, false, "shape", err))
            return false;
    if (s->part_count > 0 && !shape_is_composite(s))
        return brume_fail(err, BRUME_ERR_SCENE, "%s has no parts",
                          shape_name(s->kind));
    return true;
}

static bool check_look(const brume_scene *scene, const struct brume_shape *s,
                       struct brume_error *err)
{
    int material = s->material == BRUME_INHERIT ? -1 : s->material;
    int interior = s->interior == BRUME_INHERIT ? -1 : s->interior;
    return check_id(material, scene->materials_count, true, "material", err) &&
           check_id(interior, scene->interiors_count, true, "interior", err);
}

static bool check_heights(const struct brume_shape *s, struct brume_error *err)
{
    size_t columns = (size_t)s->steps[0], rows = (size_t)s->steps[1];
    bool sizes = s->steps[0] >= 2 && s->steps[1] >= 2 &&
                 s->steps[0] < 1 << 15 && s->steps[1] < 1 << 15;
    return (sizes && s->count == columns * rows) ||
           brume_fail(err, BRUME_ERR_SCENE,
                      "a height_field of %d columns and %d rows has %zu "
                      "heights",
                      s->steps[0], s->steps[1], s->count);
}

/* Each glyph says how many segments it has. */
static bool check_glyphs(const struct brume_shape *s, struct brume_error *err)
{
    size_t at = 0;
    while (at < s->count) {
        double segments = s->data[at++];
        if (!(segments >= 1.0 && segments <= (double)((s->count - at) / 8)))
            return brume_fail(err, BRUME_ERR_SCENE,
                              "a glyph of a text has %g segments", segments);
        at += 8 * (size_t)segments;
    }
    return true;
}

/* Isosurfaces are of a function of x, y and z, parametric ones of three of u
 * and v, which are x and y there. */
static bool check_functions(const brume_scene *scene,
                            const struct brume_shape *s,
                            struct brume_error *err)
{
    bool iso = s->kind == BRUME_SHAPE_ISOSURFACE;
    int count = iso ? 1 : s->kind == BRUME_SHAPE_PARAMETRIC ? 3 : 0;
    for (int i = 0; i < count; i++) {
        int parameters, results;
        if (!brume_function_arity(scene, s->function[i], &parameters, &results))
            return brume_fail(err, BRUME_ERR_SCENE, "there is no function %d",
                              s->function[i]);
        if (parameters < (iso ? 3 : 2) || parameters > 3 || results != 1)
            return brume_fail(err, BRUME_ERR_SCENE,
                              "%s is given a function of %d parameters and %d "
                              "results; expected %s and 1",
                              shape_name(s->kind), parameters, results,
                              iso ? "3" : "2 or 3");
    }
    return true;
}

static bool check_layout(const brume_scene *scene, const struct brume_shape *s,
                         struct brume_error *err)
{
    if (!check_functions(scene, s, err))
        return false;
    if (s->kind == BRUME_SHAPE_HEIGHT_FIELD)
        return check_heights(s, err);
    return s->kind != BRUME_SHAPE_TEXT || check_glyphs(s, err);
}

bool shape_check(const brume_scene *scene, const struct brume_shape *s,
                 struct brume_error *err)
{
    double radii[2] = {s->radius, s->radius_b};
    if ((int)s->kind < 0 || (int)s->kind >= KINDS)
        return brume_fail(err, BRUME_ERR_SCENE, "there is no shape kind %d",
                          (int)s->kind);
    if (!rules[s->kind].ready)
        return brume_fail(err, BRUME_ERR_SCENE, "%s is not supported yet",
                          rules[s->kind].name);
    if (!check_finite(s->a, 3, "a shape's point", err) ||
        !check_finite(s->b, 3, "a shape's point", err) ||
        !check_finite(radii, 2, "a shape's radius", err) ||
        !check_transform(s->transform, "a shape", err) ||
        !check_look(scene, s, err) || !check_data(s, err) ||
        !check_layout(scene, s, err) || !check_parts(scene, s, err))
        return false;
    if (s->kind == BRUME_SHAPE_MESH)
        return check_id(s->mesh, scene->meshes_count, false, "mesh", err);
    return rules[s->kind].signed_radii ||
           check_not_negative(radii, 2, "a radius", err);
}

/* NULL of an empty list too. */
static void *copy(const void *from, size_t count, size_t size,
                  struct brume_error *err)
{
    void *out = count > 0 ? memory_new(count, size, err) : NULL;
    if (out)
        memcpy(out, from, count * size);
    return out;
}

bool shape_own(struct brume_shape *s, struct brume_error *err)
{
    s->data = copy(s->data, s->count, sizeof *s->data, err);
    s->parts = copy(s->parts, s->part_count, sizeof *s->parts, err);
    s->clips = copy(s->clips, s->clip_count, sizeof *s->clips, err);
    if ((s->data || s->count == 0) && (s->parts || s->part_count == 0) &&
        (s->clips || s->clip_count == 0))
        return true;
    shape_release(s);
    return false;
}

void shape_release(struct brume_shape *s)
{
    free((void *)s->data);
    free((void *)s->parts);
    free((void *)s->clips);
    s->data = NULL;
    s->parts = s->clips = NULL;
}
