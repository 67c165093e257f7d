/* query.h - what is kept for the queries of a shape. */
#ifndef CORE_QUERY_H
#define CORE_QUERY_H
#include "core/leaf.h"

struct scene_query {
    struct flat *flat;      /* NULL until it is needed                     */
    bool has_extent;
    struct box extent;
};

/* The shape's place in scene->queries; NULL with err set if there is no such
 * shape or no memory. */
struct scene_query *query_of(brume_scene *scene, int shape,
                             struct brume_error *err);
#endif
