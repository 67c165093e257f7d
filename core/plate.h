/* plate.h - the plate of a scene, as the API was told it. */
#ifndef CORE_PLATE_H
#define CORE_PLATE_H
#include "core/brume.h"

void plate_release(struct brume_plate *plate);

/* False with err set, if a picture of that size can't have it. */
bool plate_fits(const struct brume_plate *plate, int width, int height,
                struct brume_error *err);
#endif
