/* plan.h - which stages a frame needs, decided from its scene alone. */
#ifndef CORE_PLAN_H
#define CORE_PLAN_H
#include "core/flat.h"

struct stages {
    bool load;              /* grids                                       */
    bool accel;             /* the tree                                    */
    bool glow;              /* emitting voxels as lights                   */
    bool march;             /* the straight line from the eye              */
    bool photons;           /* emit, trace and gather: a field of light    */
    bool passes;            /* ... for each sample of the picture          */
    bool cells;             /* ... that holds what comes from lights too   */
    bool single;            /* what the lights give media, once scattered  */
    bool path;              /* anything beyond that                        */
    bool lines;             /* a straight line for each sample             */
    int needs;              /* MAY_* of may.h: what the scene holds        */
};

struct stages plan_stages(const struct flat *flat,
                          const struct brume_options *options);

/* Whether a tree over what there is pays to be left to a backend that builds it
 * on its device. */
bool plan_leaves_tree(const struct flat *flat, enum brume_tree tree);

/* Lays out what the stages need beyond the prepared scene. */
bool plan_layout(struct flat *flat, const struct brume_options *options,
                 struct brume_error *err);

/* The stages with their reasons and bytes, and notes on grids and media. */
void plan_describe(const brume_scene *scene, const struct flat *flat,
                   const struct brume_options *options,
                   struct brume_plan *plan);
#endif
