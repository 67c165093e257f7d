#include "lib/ppm.h"
#include <errno.h>
#include <string.h>
#include "lib/codes.h"
#include "lib/output.h"

static bool write_rows(FILE *stream, struct codes *codes)
{
    const struct image *image = codes->image;
    fprintf(stream, "P6\n# Software: Brume\n%d %d\n%d\n", image->width,
            image->height, codes->bits == 16 ? 65535 : 255);
    for (int y = 0; y < image->height; y++)
        if (fwrite(codes_row(codes, y), 1, codes->size, stream) != codes->size)
            return false;
    return fflush(stream) == 0;
}

bool ppm_save_stream(FILE *stream, const char *name, const struct image *image,
                     int bits, struct brume_error *err)
{
    struct codes codes;
    bool ok = codes_init(&codes, image, bits, false, err);
    if (ok && !write_rows(stream, &codes))
        ok = brume_fail_file(err, name, "can't be written: %s",
                             strerror(errno));
    codes_release(&codes);
    return ok;
}

bool ppm_save(const char *path, const struct image *image, int bits,
              struct brume_error *err)
{
    struct output *o = output_open(path, err);
    return o &&
           output_close(
               o, ppm_save_stream(output_stream(o), path, image, bits, err),
               err);
}
