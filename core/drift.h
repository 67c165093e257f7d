/* drift.h - how far media move in a frame of a film, by the velocities that
 * they have, for each block of 2^3 cells of the field of scattered light. */
#ifndef CORE_DRIFT_H
#define CORE_DRIFT_H
#include "core/flat.h"

enum { DRIFT_BLOCKS = 64 };     /* of a brick                              */

/* Fills flat->drift, three numbers a block in sides of a cell, for a field
 * that is laid out; leaves it NULL where no medium has a velocity. False: no
 * memory. */
bool drift_find(const brume_scene *scene, struct flat *flat, int threads,
                struct brume_error *err);
#endif
