/* leaf.h - one primitive as it is told, brought to the space in which
 * physics/ knows it. */
#ifndef CORE_LEAF_H
#define CORE_LEAF_H
#include "core/matrix.h"
#include "core/scene.h"
#include "core/solid.h"

/* A box of the scene's space; sides may be infinite. Empty: lo > hi. */
struct box {
    double lo[3], hi[3];
};

struct box box_empty(void);
struct box box_endless(void);
void box_add(struct box *b, const double p[3]);
struct box box_hull(const struct box *a, const struct box *b);
struct box box_common(const struct box *a, const struct box *b);
bool box_is_empty(const struct box *b);
bool box_is_bounded(const struct box *b);
/* Of the box's corners under the map; endless stays endless. */
struct box box_transform(const struct box *b, const matrix *map);

struct leaf {
    int kind;               /* SHAPE_* of physics/shape.h, SOLID_* of
                               physics/solids.h or SHAPE_MESH              */
    double params[4];       /* physics/shape.h                             */
    matrix map;             /* its own space to the scene's                */
    struct solid solid;
    struct mesh *mesh;
    struct mesh *made;      /* the same where it was made, owned           */
    size_t seen_triangles;  /* the mesh's triangles beyond close it        */
    double inside[3];       /* a mesh's inside_vector                      */
    int flags;              /* SHAPE_OPEN, _ENDLESS, _THIN                 */
    struct box bounds;      /* in the scene's space                        */
};

#define LEAF_ALL SIZE_MAX

/* `glyph` is the place in data of the glyph of a text, or LEAF_ALL; `closed`
 * asks for the walls of what POV-Ray draws open and knows the inside of. */
struct leaf_request {
    const brume_scene *scene;
    const struct brume_shape *shape;
    size_t glyph;
    bool closed;
    const matrix *place;    /* the shape's space to the scene's            */
};

/* Solids lie in the arena; false with err set on failure. */
bool leaf_make(const struct leaf_request *request, struct arena *arena,
               struct leaf *leaf, struct brume_error *err);
void leaf_release(struct leaf *leaf);
/* Bounds under `map`, from its own space. */
struct box leaf_bounds(const struct leaf *leaf, const matrix *map);
#endif
