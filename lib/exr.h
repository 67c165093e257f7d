/* exr.h - OpenEXR files through OpenEXR's C core.
 *
 * Errors are BRUME_ERR_FILE and name the file. Samples are passed as they
 * are, NaN and infinity too. */
#ifndef LIB_EXR_H
#define LIB_EXR_H
#include <stdbool.h>
#include <stddef.h>
#include "lib/error.h"
#include "lib/image.h"

struct exr_text {           /* a string of the file's header              */
    const char *name, *value;
};

/* Writes a single-part scanline file: all channels 32-bit float, ZIP in
 * blocks of 16 lines, data window = display window, packed by so many threads
 * (0: as many as processors). The bytes depend on the other arguments (and
 * zlib) alone. The file appears only when it is complete. */
bool exr_save(const char *path, const struct image *image,
              const struct exr_text *text, size_t texts, int threads,
              struct brume_error *err);

struct exr_picture {
    int width, height;          /* of the data window                     */
    int x, y;                   /* its corner relative to the display's   */
    int full_width, full_height;        /* the display window's size      */
    size_t channels;
    char (*name)[256];
    float **plane;              /* per channel width * height samples     */
};

/* Reads all half, float and integer channels of a single-part file of scan
 * lines or tiles (the largest level of these). */
struct exr_picture *exr_load(const char *path, struct brume_error *err);
void exr_free(struct exr_picture *picture);

/* The string of that name in the header of the file's first part; false where
 * there is none, the file can't be read, or `size` bytes do not hold it. */
bool exr_text_of(const char *path, const char *name, char *out, size_t size);

/* The plane of a channel, or NULL. */
const float *exr_plane(const struct exr_picture *picture, const char *name);
#endif
