/* plan.h - which stages a frame needs, decided from its scene alone. */
#ifndef CORE_PLAN_H
#define CORE_PLAN_H
#include "core/flat.h"

struct stages {
    bool load;              /* grids                                       */
    bool accel;             /* the tree                                    */
    bool glow;              /* emitting voxels as lights                   */
    bool march;             /* the straight line from the eye              */
    bool path;              /* anything beyond it                          */
};

struct stages plan_stages(const struct flat *flat);

/* The stages with their reasons and bytes, and notes on grids and media. */
void plan_describe(const brume_scene *scene, const struct flat *flat,
                   const struct brume_options *options,
                   struct brume_plan *plan);
#endif
