/* df3.h - POV-Ray's density files: three big-endian 16-bit sizes, then the
 * samples as unsigned big-endian integers of 8, 16 or 32 bits, x fastest;
 * which of these, the file's length tells. Read as written by many programs,
 * as POV-Ray 3.7's documentation (density_file) describes them. */
#ifndef LIB_DF3_H
#define LIB_DF3_H
#include "lib/error.h"
#include "lib/grid.h"

/* The file as a grid over the unit cube: value / largest integer, sample i of
 * n from i / n on to the next, or interpolated from i / n on and constant
 * behind the last, as POV-Ray 3.7 has it; nothing outside the cube (clip).
 * False sizes are BRUME_ERR_FILE with the length expected and found. */
struct grid *df3_load(const char *path, enum grid_filter filter,
                      struct brume_error *err);
#endif
