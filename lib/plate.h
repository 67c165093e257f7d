/* plate.h - pictures that were made elsewhere, to lay others before or behind:
 * colour with its alpha, and depth, of OpenEXR files.
 *
 * Errors are BRUME_ERR_FILE and name the file. */
#ifndef LIB_PLATE_H
#define LIB_PLATE_H
#include <stdbool.h>
#include <stddef.h>
#include "lib/error.h"

struct plate {
    int width, height;          /* of the display window; rows from the top */
    float *radiance;            /* 3 a pixel, finite, associated with alpha */
    float *alpha;               /* in [0, 1]; NULL: 1 everywhere           */
    float *depth;               /* above 0, or infinite; NULL: there is none */
    size_t faulty;              /* pixels whose colour was no number or not
                                   finite: black and opaque now            */
    size_t depthless;           /* whose depth was no number or not above 0:
                                   infinite now                            */
};

/* Reads R, G, B (or Y for all three), A and Z; of a file with layers those of
 * the one that is named: LAYER.R, or LAYER.Combined.R as Blender writes, and
 * LAYER.Z, or LAYER.Depth.Z. Pixels of the display window that the data window
 * lacks are clear, and infinitely deep. NULL with err set. */
struct plate *plate_load(const char *path, const char *layer,
                         struct brume_error *err);
void plate_free(struct plate *plate);
#endif
