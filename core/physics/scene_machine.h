/* scene_machine.h - the functions of a scene, to be run. */
#ifndef CORE_PHYSICS_SCENE_MACHINE_H
#define CORE_PHYSICS_SCENE_MACHINE_H
#include "core/physics/machine.h"
#include "core/physics/scene.h"

HD machine scene_machine(const flat_scene *s)
{
    machine m;
    m.code = s->code;
    m.functions = s->functions;
    m.pool = REAL_CHOOSE(s->exact_pool, s->pool);
    m.grids = REAL_CHOOSE(s->host_grids, s);
    m.images = s->images;
    m.texels = s->texels;
    return m;
}

#endif
