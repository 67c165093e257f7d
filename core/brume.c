/* The building half of brume.h: lists that grow, and checks of what enters
 * them, so that nothing behind the API meets a value it cannot use. */
#include "core/brume.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/check.h"
#include "core/flat.h"
#include "core/plate.h"
#include "core/query.h"
#include "core/scene.h"
#include "core/shapes.h"
#include "lib/memory.h"

brume_scene *brume_scene_new(struct brume_error *err)
{
    brume_scene *s = memory_new(1, sizeof *s, err);
    if (!s)
        return NULL;
    s->camera = (struct brume_camera)BRUME_CAMERA_INIT;
    s->globals = (struct brume_globals)BRUME_GLOBALS_INIT;
    s->sky = (struct brume_sky)BRUME_SKY_INIT;
    s->plate = (struct brume_plate)BRUME_PLATE_INIT;
    s->atmosphere = -1;
    return s;
}

void brume_scene_free(brume_scene *scene)
{
    if (!scene)
        return;
    for (size_t i = 0; i < scene->meshes_count; i++)
        mesh_free(scene->meshes[i]);
    for (size_t i = 0; i < scene->grids_count; i++)
        grid_free(scene->grids[i]);
    for (size_t i = 0; i < scene->shapes_count; i++)
        shape_release(&scene->shapes[i]);
    for (size_t i = 0; i < scene->queries_count; i++)
        flat_free(scene->queries[i].flat);
    free((void *)scene->sky.radiance);
    plate_release(&scene->plate);
#define X(type, name) free(scene->name);
    SCENE_LISTS(X)
#undef X
    free(scene);
}

/* Appends to one of the lists and returns the id. */
#define APPEND(scene, list, value, err)                                        \
    (list_room((void **)&(scene)->list, &(scene)->list##_capacity,             \
               (scene)->list##_count, sizeof *(scene)->list, err)              \
         ? ((scene)->list[(scene)->list##_count] = (value),                    \
            (int)(scene)->list##_count++)                                      \
         : -1)

static bool list_room(void **list, size_t *capacity, size_t count, size_t size,
                      struct brume_error *err)
{
    if (count >= INT32_MAX)
        return brume_fail(err, BRUME_ERR_LIMIT, "too many items in the scene");
    void *grown = memory_grow(*list, capacity, count + 1, size, err);
    if (!grown)
        return false;
    *list = grown;
    return true;
}

bool brume_set_camera(brume_scene *scene, const struct brume_camera *camera,
                      struct brume_error *err)
{
    if (!check_finite(camera->location, 3, "the camera's location", err) ||
        !check_finite(camera->direction, 3, "the camera's direction", err) ||
        !check_finite(camera->up, 3, "the camera's up", err) ||
        !check_finite(camera->right, 3, "the camera's right", err))
        return false;
    const double *d = camera->direction;
    if (d[0] == 0.0 && d[1] == 0.0 && d[2] == 0.0)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "the camera's direction is zero");
    scene->camera = *camera;
    return true;
}

bool brume_set_globals(brume_scene *scene, const struct brume_globals *globals,
                       struct brume_error *err)
{
    if (!check_finite(globals->background, 3, "the background", err) ||
        !check_finite(globals->ambient_light, 3, "the ambient light", err))
        return false;
    scene->globals = *globals;
    return true;
}

static bool check_sky_function(const brume_scene *scene, int id,
                               struct brume_error *err)
{
    int parameters, results;
    return id < 0 ||
           (brume_function_arity(scene, id, &parameters, &results) &&
            parameters == 3 && results >= 3) ||
           brume_fail(err, BRUME_ERR_SCENE,
                      "a sky needs a function of 3 parameters with 3 results");
}

static bool check_sky(const brume_scene *scene, const struct brume_sky *sky,
                      struct brume_error *err)
{
    if (sky->width < 0 || sky->height < 0 || sky->width > BRUME_MAX_SKY ||
        sky->height > BRUME_MAX_SKY || (sky->width == 0) != (sky->height == 0))
        return brume_fail(err, BRUME_ERR_LIMIT,
                          "a sky of %d x %d texels is not possible; at most "
                          "%d on a side are",
                          sky->width, sky->height, BRUME_MAX_SKY);
    size_t n = 3 * (size_t)sky->width * (size_t)sky->height;
    for (size_t i = 0; i < n; i++)
        if (!(sky->radiance[i] >= 0.0f) || isinf(sky->radiance[i]))
            return brume_fail(err, BRUME_ERR_SCENE,
                              "the sky's radiance is %g at texel %zu",
                              (double)sky->radiance[i], i / 3);
    return check_not_negative(&sky->scale, 1, "the sky's scale", err) &&
           check_transform(sky->transform, "the sky", err) &&
           check_sky_function(scene, sky->function, err);
}

bool brume_set_sky(brume_scene *scene, const struct brume_sky *sky,
                   struct brume_error *err)
{
    float *copy = NULL;
    size_t n = 3 * (size_t)sky->width * (size_t)sky->height;
    if (!check_sky(scene, sky, err))
        return false;
    if (n > 0) {
        copy = memory_new(n, sizeof *copy, err);
        if (!copy)
            return false;
        memcpy(copy, sky->radiance, n * sizeof *copy);
    }
    free((void *)scene->sky.radiance);
    scene->sky = *sky;
    scene->sky.radiance = copy;
    return true;
}

static bool check_aim(const struct brume_light *l, struct brume_error *err)
{
    double v[3] = {l->radius, l->falloff, l->tightness};
    if (l->kind == BRUME_LIGHT_POINT && !l->parallel)
        return true;
    if (!check_finite(l->point_at, 3, "the light's point_at", err) ||
        !check_not_negative(v, 3, "a light's radius, falloff or tightness",
                            err))
        return false;
    if (memcmp(l->point_at, l->location, sizeof l->location) == 0)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "the light points at its own location");
    return true;
}

static bool check_area(const struct brume_light *l, struct brume_error *err)
{
    if (!l->area)
        return true;
    if (l->area_size[0] < 1 || l->area_size[1] < 1)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "an area light of %d by %d lamps is not possible",
                          l->area_size[0], l->area_size[1]);
    return check_finite(l->area_axis[0], 6, "an area light's axis", err);
}

static bool check_supported(const struct brume_light *l,
                            struct brume_error *err)
{
    if (l->looks_like != -1)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "looks_like is not supported: add the shape "
                          "without a shadow");
    return l->projected_through == -1 ||
           brume_fail(err, BRUME_ERR_SCENE,
                      "projected_through is not supported");
}

int brume_add_light(brume_scene *scene, const struct brume_light *light,
                    struct brume_error *err)
{
    double fade[2] = {light->fade_distance, light->fade_power};
    if (!check_finite(light->location, 3, "the light's location", err) ||
        !check_finite(light->color, 3, "the light's colour", err) ||
        !check_not_negative(fade, 2, "the light's fade", err) ||
        !check_aim(light, err) || !check_area(light, err) ||
        !check_supported(light, err))
        return -1;
    return APPEND(scene, lights, *light, err);
}

static bool check_pigment_function(const brume_scene *scene, int id,
                                   struct brume_error *err)
{
    int parameters, results;

    if (id == -1)
        return true;
    if (brume_function_arity(scene, id, &parameters, &results) &&
        parameters == 3 && results == 5)
        return true;
    return brume_fail(err, BRUME_ERR_SCENE,
                      "a pigment needs a function of 3 parameters with 5 "
                      "results");
}

int brume_add_material(brume_scene *scene,
                       const struct brume_material *material,
                       struct brume_error *err)
{
    const struct brume_material *m = material;
    double finish[7] = {m->diffuse,  m->brilliance, m->phong,   m->phong_size,
                        m->specular, m->roughness,  m->metallic};
    if (!check_finite(m->color[0], 10, "a pigment's colour", err) ||
        !check_finite(m->ambient, 3, "the finish's ambient", err) ||
        !check_finite(m->emission, 3, "the finish's emission", err) ||
        !check_not_negative(finish, 7, "a term of the finish", err) ||
        !check_transform(m->pigment_transform, "a pigment", err) ||
        !check_pigment_function(scene, m->function, err))
        return -1;
    return APPEND(scene, materials, *m, err);
}

int brume_add_shape(brume_scene *scene, const struct brume_shape *shape,
                    struct brume_error *err)
{
    struct brume_shape own = *shape;
    if (!shape_check(scene, shape, err) || !shape_own(&own, err))
        return -1;
    int id = APPEND(scene, shapes, own, err);
    if (id < 0)
        shape_release(&own);
    return id;
}

int brume_add_mesh(brume_scene *scene, const struct mesh *mesh,
                   struct brume_error *err)
{
    if (!mesh_check(mesh, err))
        return -1;
    struct mesh *copy = mesh_copy(mesh, err);
    if (!copy)
        return -1;
    int id = APPEND(scene, meshes, copy, err);
    if (id < 0)
        mesh_free(copy);
    return id;
}

int brume_share_mesh(brume_scene *scene, struct mesh *mesh,
                     struct brume_error *err)
{
    if (!mesh_check(mesh, err))
        return -1;
    int id = APPEND(scene, meshes, mesh, err);
    if (id >= 0)
        mesh_share(mesh);
    return id;
}

int brume_add_grid(brume_scene *scene, const struct grid *grid,
                   struct brume_error *err)
{
    if (!check_transform(grid->to_world, "a grid", err))
        return -1;
    struct grid *copy = grid_copy(grid, err);
    if (!copy)
        return -1;
    int id = APPEND(scene, grids, copy, err);
    if (id < 0)
        grid_free(copy);
    return id;
}

int brume_share_grid(brume_scene *scene, struct grid *grid,
                     struct brume_error *err)
{
    const struct grid *own = grid;
    if (!check_transform(own->to_world, "a grid", err))
        return -1;
    int id = APPEND(scene, grids, grid, err);
    if (id >= 0)
        grid_share(grid);
    return id;
}

static bool check_field_function(const brume_scene *scene,
                                 const struct brume_field *f,
                                 struct brume_error *err)
{
    int parameters, results;
    return (brume_function_arity(scene, f->function, &parameters, &results) &&
            parameters == 3 && f->component >= BRUME_COMPONENT_COLOR &&
            f->component < results && (f->component >= 0 || results >= 3)) ||
           brume_fail(err, BRUME_ERR_SCENE,
                      "a field is no function of a point with that result");
}

int brume_add_field(brume_scene *scene, const struct brume_field *field,
                    struct brume_error *err)
{
    bool grid = field->kind == BRUME_FIELD_GRID;
    if (!check_not_negative(&field->scale, 1, "a field's scale", err) ||
        !check_id(field->grid, scene->grids_count, !grid, "grid", err) ||
        !check_transform(field->transform, "a field", err) ||
        (field->kind == BRUME_FIELD_FUNCTION &&
         !check_field_function(scene, field, err)))
        return -1;
    if (grid && scene->grids[field->grid]->any_sign) {
        brume_fail(err, BRUME_ERR_SCENE,
                   "grid %d is a part of a velocity, and no density",
                   field->grid);
        return -1;
    }
    return APPEND(scene, fields, *field, err);
}

static bool check_fire(const brume_scene *scene, const struct brume_fire *f,
                       struct brume_error *err)
{
    double kelvin[2] = {f->kelvin_scale, f->kelvin_offset};
    double positive[2] = {f->intensity, f->reference};
    if (!check_id(f->temperature, scene->fields_count, false, "field", err) ||
        !check_id(f->amount, scene->fields_count, true, "field", err) ||
        !check_finite(kelvin, 2, "the fire's kelvin", err) ||
        !check_not_negative(positive, 2, "the fire's intensity or reference",
                            err))
        return false;
    if (f->brightness == BRUME_BRIGHTNESS_TOTAL && !(f->reference > 0))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "the fire's reference is %g "
                          "K but must be greater than 0",
                          f->reference);
    return f->brightness != BRUME_BRIGHTNESS_PHYSICAL || f->reference >= 500 ||
           brume_fail(err, BRUME_ERR_SCENE,
                      "the fire's reference is %g K but must be at least "
                      "500 K, where a black body begins to glow",
                      f->reference);
}

static bool check_velocity(const brume_scene *scene,
                           const struct brume_velocity *v,
                           struct brume_error *err)
{
    for (int i = 0; i < 3; i++)
        if (!check_id(v->grid[i], scene->grids_count, false, "grid", err) ||
            !(scene->grids[v->grid[i]]->any_sign ||
              brume_fail(err, BRUME_ERR_SCENE,
                         "grid %d is no part of a velocity", v->grid[i])))
            return false;
    return check_finite(&v->scale, 1, "a velocity's scale", err) &&
           check_transform(v->transform, "a velocity", err);
}

static bool check_medium(const brume_scene *scene, const struct brume_medium *m,
                         struct brume_error *err)
{
    if (!check_not_negative(m->absorption, 3, "absorption", err) ||
        !check_not_negative(m->scattering, 3, "scattering", err) ||
        !check_finite(m->emission, 3, "emission", err) ||
        !check_not_negative(&m->extinction, 1, "extinction", err))
        return false;
    if (m->phase < BRUME_PHASE_ISOTROPIC ||
        m->phase > BRUME_PHASE_HENYEY_GREENSTEIN)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "scattering type %d is not one of 1 to 5",
                          (int)m->phase);
    if (!(fabs(m->eccentricity) < 1.0))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "eccentricity is %g but must lie between -1 and 1",
                          m->eccentricity);
    if (m->densities < 0 || m->densities > BRUME_MAX_DENSITIES)
        return brume_fail(err, BRUME_ERR_LIMIT,
                          "a medium has %d densities but at most %d are "
                          "possible",
                          m->densities, BRUME_MAX_DENSITIES);
    for (int i = 0; i < m->densities; i++)
        if (!check_id(m->density[i], scene->fields_count, false, "field", err))
            return false;
    return (!m->fire.on || check_fire(scene, &m->fire, err)) &&
           (!m->velocity.on || check_velocity(scene, &m->velocity, err));
}

int brume_add_medium(brume_scene *scene, const struct brume_medium *medium,
                     struct brume_error *err)
{
    if (!check_medium(scene, medium, err))
        return -1;
    return APPEND(scene, media, *medium, err);
}

int brume_add_interior(brume_scene *scene, const int *media, int count,
                       struct brume_error *err)
{
    struct scene_interior in = {.count = count};
    if (count < 0 || count > BRUME_MAX_INTERIOR_MEDIA) {
        brume_fail(err, BRUME_ERR_LIMIT,
                   "an interior has %d media but at most %d are possible",
                   count, BRUME_MAX_INTERIOR_MEDIA);
        return -1;
    }
    for (int i = 0; i < count; i++) {
        if (!check_id(media[i], scene->media_count, false, "medium", err))
            return -1;
        in.media[i] = media[i];
    }
    return APPEND(scene, interiors, in, err);
}

bool brume_set_atmosphere(brume_scene *scene, int interior,
                          struct brume_error *err)
{
    if (!check_id(interior, scene->interiors_count, true, "interior", err))
        return false;
    scene->atmosphere = interior;
    return true;
}
