/* may.h - what scenes may hold, as far as code is made for it.
 *
 * Code for scenes that hold less has none for the rest, and keeps in registers
 * what would else be arrays in memory: it is the same physics, and gives the
 * same bits. SCENE_MAY is a sum of MAY_*. */
#ifndef CORE_PHYSICS_MAY_H
#define CORE_PHYSICS_MAY_H
#include "core/physics/hd.h"

enum {
    MAY_SOLIDS = 1,         /* primitives of solids.h, isosurfaces         */
    MAY_COMPOSITES = 2,
    MAY_FUNCTIONS = 4,      /* pigments and skies that are byte code       */
    MAY_MESHES = 8,
    MAY_SURFACES = 16,      /* that are seen, not only bound media         */
    MAY_EMISSION = 32,      /* of media                                    */
    MAY_SKY = 64,           /* a picture around the scene                  */
    MAY_LAMPS = 128,        /* local lights (equiangular.h)                */
    MAY_MANY = 256,         /* several media or containers at one place, or
                               grids of one medium on different lattices   */
    MAY_CLEAR = 512,        /* media that do not scatter                   */
    MAY_FIELD = 1024,       /* a field of photons' light, read by lines    */
    MAY_KDTREE = 2048,
    MAY_COLORS = 4096,      /* media in which the channels fly differently */
    MAY_BALLS = 8192,       /* a field of balls                            */
    MAY_PLATE = 16384,      /* a picture from elsewhere before the eye     */
    MAY_TINTS = 32768,      /* power of photons whose channels differ: what
                               samples do is the same                      */
    MAY_SINGLE = 65536,     /* paths that end at their first event         */
    MAY_ALL = 131071
};

#ifndef SCENE_MAY
#define SCENE_MAY MAY_ALL
#endif

/* A macro, for compilers to see a constant: of a function's value nvcc learns
 * when all is inlined, what is for other scenes too, which takes it ten times
 * as long. */
#define scene_may(what) ((SCENE_MAY & (what)) != 0)

#endif
