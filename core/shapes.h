/* shapes.h - what the API takes of shapes: checks and copies. */
#ifndef CORE_SHAPES_H
#define CORE_SHAPES_H
#include "core/scene.h"

/* The kind's name in messages: "a torus". */
const char *shape_name(enum brume_shape_kind kind);

/* False with err set for a shape that nothing behind the API could use. */
bool shape_check(const brume_scene *scene, const struct brume_shape *shape,
                 struct brume_error *err);

/* Makes the lists that `shape` points to its own; on failure it owns none. */
bool shape_own(struct brume_shape *shape, struct brume_error *err);
void shape_release(struct brume_shape *shape);

/* Whether it is made of parts. */
bool shape_is_composite(const struct brume_shape *shape);
#endif
