/* Queries of shapes, while the scene is told. */
#include "core/shapes.h"

static bool not_yet(const brume_scene *scene, int shape,
                    struct brume_error *err)
{
    if (shape < 0 || (size_t)shape >= scene->shapes_count)
        return brume_fail(err, BRUME_ERR_SCENE, "there is no shape %d", shape);
    return brume_fail(err, BRUME_ERR_SCENE,
                      "queries of %s are not supported yet",
                      shape_name(scene->shapes[shape].kind));
}

int brume_trace(brume_scene *scene, int shape, const double origin[3],
                const double direction[3], double point[3], double normal[3],
                struct brume_error *err)
{
    (void)origin, (void)direction, (void)point, (void)normal;
    not_yet(scene, shape, err);
    return -1;
}

int brume_inside(brume_scene *scene, int shape, const double point[3],
                 struct brume_error *err)
{
    (void)point;
    not_yet(scene, shape, err);
    return -1;
}

bool brume_extent(brume_scene *scene, int shape, double lowest[3],
                  double highest[3], struct brume_error *err)
{
    (void)lowest, (void)highest;
    return not_yet(scene, shape, err);
}
