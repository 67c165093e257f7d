/* Pictures of light. */
#include "lib/radiance.h"

#include <stdlib.h>

#include "lib/exr.h"
#include "lib/memory.h"

static bool fill(struct radiance *to, const struct exr_picture *from)
{
    const char *const name[4] = {"R", "G", "B", "A"};
    const float *gray = exr_plane(from, "Y");
    size_t pixels = (size_t)from->width * (size_t)from->height;

    for (size_t c = 0; c < 4; c++) {
        const float *plane = exr_plane(from, name[c]);
        if (!plane && c < 3)
            plane = gray;
        if (!plane && c < 3)
            return false;
        for (size_t i = 0; i < pixels; i++)
            to->sample[4 * i + c] = plane ? plane[i] : 1.0f;
    }
    return true;
}

static struct radiance *radiance_new(int width, int height,
                                     struct brume_error *err)
{
    struct radiance *made = memory_new(1, sizeof *made, err);
    if (!made)
        return NULL;
    made->width = width;
    made->height = height;
    made->sample = memory_new(4 * (size_t)width * (size_t)height,
                              sizeof *made->sample, err);
    if (made->sample)
        return made;
    free(made);
    return NULL;
}

struct radiance *radiance_load(const char *path, struct brume_error *err)
{
    struct exr_picture *from = exr_load(path, err);
    struct radiance *made;

    if (!from)
        return NULL;
    made = radiance_new(from->width, from->height, err);
    if (made && !fill(made, from)) {
        brume_fail(err, BRUME_ERR_FILE,
                   "%s: has neither the channels R, G and B nor Y", path);
        radiance_free(made);
        made = NULL;
    }
    exr_free(from);
    return made;
}

void radiance_free(struct radiance *radiance)
{
    if (!radiance)
        return;
    free(radiance->sample);
    free(radiance);
}
