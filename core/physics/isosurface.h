/* isosurface.h - isosurfaces of the scene's functions: what
 * solid_isosurface.h asks for, the machine answers, in the precision of the
 * scene. Closed by their containers. */
#ifndef CORE_PHYSICS_ISOSURFACE_H
#define CORE_PHYSICS_ISOSURFACE_H
#include "core/physics/scene_machine.h"
#include "core/physics/solid_isosurface.h"

HD_APART double isosurface_value(const flat_scene *s, const double *data,
                                 dvec3 p)
{
    real registers[MACHINE_REGISTERS];
    machine m = scene_machine(s);
    registers[0] = (real)p.x;
    registers[1] = (real)p.y;
    registers[2] = (real)p.z;
    machine_run(&m, (int32_t)data[ISOSURFACE_FUNCTION], registers);
    return (double)registers[0];
}

HD int isosurface_roots(const flat_scene *s, const double *data, dvec3 o,
                        dvec3 d, double *t, int *part, int room)
{
    isosurface_walk w;
    isosurface_start(data, o, d, -INFINITY, INFINITY, t, part, room, &w);
    while (w.asks)
        isosurface_tell(&w, isosurface_value(s, data, w.p));
    return w.count;
}

HD dvec3 isosurface_normal(const flat_scene *s, const double *data, dvec3 p,
                           int part)
{
    double value[6] = {0, 0, 0, 0, 0, 0};
    for (int k = 0; part == ISOSURFACE_SURFACE && k < 6; k++)
        value[k] = isosurface_value(s, data, isosurface_beside(data, p, k));
    return isosurface_normal_of(data, p, part, value);
}

HD bool isosurface_inside(const flat_scene *s, const double *data, dvec3 p)
{
    return isosurface_contains(data, p) &&
           isosurface_inside_of(data, p, isosurface_value(s, data, p));
}

#endif
