/* prepare.h - from the scene as told to the flat scene that stages read. One
 * file a topic; all are called by prepare_scene in this order. */
#ifndef CORE_PREPARE_H
#define CORE_PREPARE_H
#include "core/assembly.h"
#include "core/flat.h"

struct prepare {
    const brume_scene *scene;
    struct flat *flat;
    int threads;
    void (*warn)(void *user, const char *text);     /* may be NULL */
    void *user;
    enum brume_tree tree;
    int tree_stack;         /* entries                                     */
    struct brume_still *still;
    bool later;             /* a tree may be left to the backend           */
    bool traced;            /* photons are                                */
    bool exact;             /* for queries: all numbers in double, and trees
                               of single shapes too                        */
};

/* The whole of it; NULL with err set on failure. */
struct flat *prepare_scene(const struct prepare *job, struct brume_error *err);

/* prepare_lights.c: lights. */
bool prepare_lights(const struct prepare *job, struct brume_error *err);
/* prepare_sky.c: the sky, and its texels as lights. */
bool prepare_sky(const struct prepare *job, struct brume_error *err);
/* prepare_plate.c: the plate. */
bool prepare_plate(const struct prepare *job, struct brume_error *err);
/* prepare_shapes.c: shapes, triangles, their bounds and the tree. */
bool prepare_shapes(const struct prepare *job, const struct assembly *a,
                    struct brume_error *err);
/* prepare_grids.c: bricks with aprons, fields. */
bool prepare_grids(const struct prepare *job, const struct assembly *a,
                   struct brume_error *err);
/* prepare_function.c: a field that is a function becomes the last procedure,
 * from whose index space *to_world leads to the scene's; where one of its
 * containers has no bounds, nothing is done and *bounded false. */
bool prepare_function(const struct prepare *job, const struct assembly *a,
                      int field, matrix *to_world, bool *bounded,
                      struct brume_error *err);
/* prepare_bake.c: a result of such a field's function as a grid in the
 * scene's space; freed with grid_free. */
struct grid *prepare_bake(const struct prepare *job, const struct assembly *a,
                          int field, int component, struct brume_error *err);
/* prepare_media.c: media, their majorant lattices, interiors. */
bool prepare_media(const struct prepare *job, struct brume_error *err);
/* prepare_clear.c: the cells of these that no boundary goes through. */
void prepare_clear(const struct prepare *job);
/* prepare_glow.c: the emitting voxels as lights, where light is followed. */
bool prepare_glow(const struct prepare *job, struct brume_error *err);

/* prepare_reach.c: what photons are sent to, and where media scatter. */
void prepare_reach(const struct prepare *job, const struct assembly *a);

/* The largest value of a field over a box of unit space (or of the lattice
 * that `to_unit` maps from). */
float prepare_field_bound(const struct flat *flat, int field,
                          const matrix *to_unit, const double lo[3],
                          const double hi[3]);
/* The same over all space, and what it is outside of every grid. */
float prepare_field_bound_everywhere(const struct flat *flat, int field);
#endif
