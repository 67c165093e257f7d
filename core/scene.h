/* scene.h - the scene as the API was told it: lists of brume.h's structures
 * and copies of meshes and grids. prepare.c flattens it for rendering. */
#ifndef CORE_SCENE_H
#define CORE_SCENE_H
#include "core/brume.h"
#include "core/physics/machine_code.h"

struct scene_interior {
    int media[BRUME_MAX_INTERIOR_MEDIA];
    int count;
};

struct scene_query;

#define SCENE_LISTS(X)                                                        \
    X(struct brume_light, lights)                                             \
    X(struct brume_material, materials)                                       \
    X(struct brume_shape, shapes)                                             \
    X(struct brume_field, fields)                                             \
    X(struct brume_medium, media)                                             \
    X(struct scene_interior, interiors)                                       \
    X(struct scene_query, queries)      /* of shapes: query.h */              \
    X(struct mesh *, meshes)                                                  \
    X(struct grid *, grids)                                                   \
    X(machine_instruction, code)        /* of all functions */                \
    X(machine_function, functions)                                            \
    X(flat_image, images)                                                     \
    X(float, texels)                                                          \
    X(double, pool)             /* numbers that instructions refer to */      \
    X(int32_t, splines)         /* their places in the pool */

struct brume_scene {
    struct brume_camera camera;
    struct brume_globals globals;
    struct brume_sky sky;       /* radiance is the scene's own copy        */
    struct brume_plate plate;   /* so are its numbers                      */
    int atmosphere;             /* an interior, or -1                      */
#define X(type, name) type *name; size_t name##_count, name##_capacity;
    SCENE_LISTS(X)
#undef X
};

#endif
