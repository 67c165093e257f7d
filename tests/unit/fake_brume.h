/* fake_brume.h - a core that renders nothing and keeps what it was given, so
 * that a test can ask what the front end hands over. Included by one file of
 * a program, it stands in for all of core/brume.h. */
#ifndef TESTS_FAKE_BRUME_H
#define TESTS_FAKE_BRUME_H
#include <stdlib.h>
#include <string.h>
#include "core/brume.h"
/* The functions of a scene are core's own, which keeps them in its lists. */
typedef struct core_scene core_scene;
#define brume_scene core_scene
#include "core/scene.h"
#undef brume_scene

/* More than these are counted, not kept. */
enum { FAKE_ROOM = 64 };

struct fake_mesh {
    size_t vertices, normals, uvs, triangles;
    double position[FAKE_ROOM][3];
    uint32_t corner[FAKE_ROOM][3];
    uint32_t corner_normal[FAKE_ROOM][3];
    bool smooth, mapped;
};

struct fake_grid {
    char name[64];
    enum grid_filter filter;
    size_t bad;
};

struct fake_interior {
    int media[BRUME_MAX_INTERIOR_MEDIA], count;
};

/* Copies of what a shape points at, the first of them. */
struct fake_lists {
    int parts[FAKE_ROOM], clips[FAKE_ROOM];
    double data[FAKE_ROOM];
};

struct brume_scene {
    struct core_scene core;                 /* first: where core looks */
    struct fake_lists list[FAKE_ROOM];      /* of the shapes */
    struct brume_camera camera;
    struct brume_globals globals;
    struct brume_sky sky;
    struct brume_plate plate;
    int cameras, global_settings, atmosphere;
    struct brume_light light[FAKE_ROOM];
    struct brume_material material[FAKE_ROOM];
    struct brume_shape shape[FAKE_ROOM];
    struct brume_field field[FAKE_ROOM];
    struct brume_medium medium[FAKE_ROOM];
    struct fake_interior interior[FAKE_ROOM];
    struct fake_mesh mesh[FAKE_ROOM];
    struct fake_grid grid[FAKE_ROOM];
    int lights, materials, shapes, fields, mediums, interiors, meshes, grids;
    const char *refuse;         /* the next call of this fails: "shape"    */
};

static bool fake_refuses(brume_scene *scene, const char *what,
                         struct brume_error *err)
{
    if (!scene->refuse || strcmp(scene->refuse, what))
        return false;
    brume_fail(err, BRUME_ERR_SCENE, "no %s today", what);
    return true;
}

#define FAKE_ADD(list, count, item, what)                                     \
    do {                                                                      \
        if (fake_refuses(scene, what, err))                                   \
            return -1;                                                        \
        if (scene->count < FAKE_ROOM)                                         \
            scene->list[scene->count] = item;                                 \
        return scene->count++;                                                \
    } while (0)

brume_scene *brume_scene_new(struct brume_error *err)
{
    brume_scene *scene = calloc(1, sizeof *scene);

    if (!scene)
        brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    else
        scene->atmosphere = -1;
    return scene;
}

void brume_scene_free(brume_scene *scene)
{
    if (!scene)
        return;
#define X(type, name) free(scene->core.name);
    SCENE_LISTS(X)
#undef X
    free(scene);
}

bool brume_set_camera(brume_scene *scene, const struct brume_camera *camera,
                      struct brume_error *err)
{
    if (fake_refuses(scene, "camera", err))
        return false;
    scene->camera = *camera;
    scene->cameras++;
    return true;
}

bool brume_set_globals(brume_scene *scene,
                       const struct brume_globals *globals,
                       struct brume_error *err)
{
    if (fake_refuses(scene, "globals", err))
        return false;
    scene->globals = *globals;
    scene->global_settings++;
    return true;
}

bool brume_set_sky(brume_scene *scene, const struct brume_sky *sky,
                   struct brume_error *err)
{
    if (fake_refuses(scene, "sky", err))
        return false;
    scene->sky = *sky;
    return true;
}

bool brume_set_plate(brume_scene *scene, const struct brume_plate *plate,
                     struct brume_error *err)
{
    if (fake_refuses(scene, "plate", err))
        return false;
    scene->plate = *plate;
    return true;
}

int brume_add_light(brume_scene *scene, const struct brume_light *light,
                    struct brume_error *err)
{
    FAKE_ADD(light, lights, *light, "light");
}

int brume_add_material(brume_scene *scene,
                       const struct brume_material *material,
                       struct brume_error *err)
{
    FAKE_ADD(material, materials, *material, "material");
}

int brume_add_shape(brume_scene *scene, const struct brume_shape *shape,
                    struct brume_error *err)
{
    if (scene->shapes < FAKE_ROOM) {
        struct fake_lists *list = &scene->list[scene->shapes];
        for (size_t i = 0; i < shape->part_count && i < FAKE_ROOM; i++)
            list->parts[i] = shape->parts[i];
        for (size_t i = 0; i < shape->clip_count && i < FAKE_ROOM; i++)
            list->clips[i] = shape->clips[i];
        for (size_t i = 0; i < shape->count && i < FAKE_ROOM; i++)
            list->data[i] = shape->data[i];
    }
    FAKE_ADD(shape, shapes, *shape, "shape");
}

static struct fake_mesh fake_mesh_of(const struct mesh *mesh)
{
    struct fake_mesh out = {mesh->vertices, mesh->normals, mesh->uvs,
                            mesh->triangles, {{0}}, {{0}}, {{0}},
                            mesh->corner_normal != NULL,
                            mesh->corner_uv != NULL};

    for (size_t i = 0; i < mesh->vertices && i < FAKE_ROOM; i++)
        memcpy(out.position[i], mesh->position[i], sizeof *out.position);
    for (size_t i = 0; i < mesh->triangles && i < FAKE_ROOM; i++) {
        memcpy(out.corner[i], mesh->corner[i], sizeof *out.corner);
        if (out.smooth)
            memcpy(out.corner_normal[i], mesh->corner_normal[i],
                   sizeof *out.corner_normal);
    }
    return out;
}

int brume_add_mesh(brume_scene *scene, const struct mesh *mesh,
                   struct brume_error *err)
{
    FAKE_ADD(mesh, meshes, fake_mesh_of(mesh), "mesh");
}

int brume_share_mesh(brume_scene *scene, struct mesh *mesh,
                     struct brume_error *err)
{
    return brume_add_mesh(scene, mesh, err);
}

static struct fake_grid fake_grid_of(const struct grid *grid)
{
    struct fake_grid out = {{0}, grid->filter, grid->bad_nan + grid->bad_inf +
                                                   grid->bad_negative};

    memcpy(out.name, grid->name, sizeof out.name);
    return out;
}

int brume_add_grid(brume_scene *scene, const struct grid *grid,
                   struct brume_error *err)
{
    FAKE_ADD(grid, grids, fake_grid_of(grid), "grid");
}

int brume_share_grid(brume_scene *scene, struct grid *grid,
                     struct brume_error *err)
{
    return brume_add_grid(scene, grid, err);
}

int brume_add_field(brume_scene *scene, const struct brume_field *field,
                    struct brume_error *err)
{
    FAKE_ADD(field, fields, *field, "field");
}

int brume_add_medium(brume_scene *scene, const struct brume_medium *medium,
                     struct brume_error *err)
{
    FAKE_ADD(medium, mediums, *medium, "medium");
}

int brume_add_interior(brume_scene *scene, const int *media, int count,
                       struct brume_error *err)
{
    struct fake_interior interior = {{0}, count};

    for (int i = 0; i < count; i++)
        interior.media[i] = media[i];
    FAKE_ADD(interior, interiors, interior, "interior");
}

bool brume_set_atmosphere(brume_scene *scene, int interior,
                          struct brume_error *err)
{
    if (fake_refuses(scene, "atmosphere", err))
        return false;
    scene->atmosphere = interior;
    return true;
}

bool brume_plan_frame(brume_scene *scene, const struct brume_options *options,
                      struct brume_plan *plan, struct brume_error *err)
{
    (void)scene, (void)options, (void)plan;
    return brume_fail(err, BRUME_ERR_DEVICE, "a fake core plans nothing");
}

bool brume_render(brume_scene *scene, const struct brume_options *options,
                  struct brume_frame *frame, struct brume_error *err)
{
    (void)scene, (void)options, (void)frame;
    return brume_fail(err, BRUME_ERR_DEVICE, "a fake core renders nothing");
}

void brume_frame_free(struct brume_frame *frame)
{
    (void)frame;
}

struct brume_film *brume_film_new(const struct brume_film_events *events,
                                  struct brume_error *err)
{
    (void)events;
    brume_fail(err, BRUME_ERR_DEVICE, "a fake core has no film");
    return NULL;
}

void brume_film_free(struct brume_film *film)
{
    (void)film;
}

int brume_film_reach(const struct brume_options *options)
{
    return options->photons.taps / 2;
}

bool brume_film_taps(struct brume_photon_options *options, int taps)
{
    options->taps = taps;
    return taps == 1 || taps == 3 || taps == 5;
}

bool brume_film_workers(struct brume_film *film, int count,
                        struct brume_error *err)
{
    (void)film;
    (void)count;
    (void)err;
    return true;
}

void brume_film_begin(struct brume_film *film,
                      const struct brume_options *options)
{
    (void)film;
    (void)options;
}

int brume_film_devices(const struct brume_options *options, char *why,
                       size_t size)
{
    (void)options;
    (void)why;
    (void)size;
    return 0;
}

bool brume_film_push(struct brume_film *film, brume_scene *scene,
                     const struct brume_options *options, bool picture,
                     struct brume_error *err)
{
    (void)film, (void)scene, (void)options, (void)picture, (void)err;
    return false;
}

bool brume_film_ask(struct brume_film *film, uint32_t frame, uint32_t first,
                    uint32_t last, struct brume_error *err)
{
    (void)film, (void)frame, (void)first, (void)last, (void)err;
    return false;
}

bool brume_film_forget(struct brume_film *film, uint32_t below,
                       struct brume_error *err)
{
    (void)film, (void)below, (void)err;
    return false;
}

bool brume_film_next(struct brume_film *film, struct brume_frame *frame,
                     struct brume_error *err)
{
    (void)film, (void)frame, (void)err;
    return false;
}

#endif
