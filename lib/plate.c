#include "lib/plate.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "lib/exr.h"
#include "lib/memory.h"

/* The planes of a plate's channels; NULL: not in the file. */
struct planes {
    const float *color[3], *alpha, *depth;
};

/* ---- channels ----------------------------------------------------------- */

/* That of "layer.middle.name", as far as there are layer and middle. */
static const float *channel(const struct exr_picture *from, const char *layer,
                            const char *middle, const char *name)
{
    char whole[256];
    snprintf(whole, sizeof whole, "%s%s%s%s%s", layer ? layer : "",
             layer ? "." : "", middle, *middle ? "." : "", name);
    return exr_plane(from, whole);
}

static bool find_colors(const struct exr_picture *from, const char *layer,
                        const char *middle, struct planes *out)
{
    static const char *const names[] = {"R", "G", "B"};
    const float *gray = channel(from, layer, middle, "Y");
    for (int i = 0; i < 3; i++) {
        out->color[i] = channel(from, layer, middle, names[i]);
        if (!out->color[i])
            out->color[i] = gray;
    }
    out->alpha = channel(from, layer, middle, "A");
    return out->color[0] && out->color[1] && out->color[2];
}

/* The first of the file's channels, as far as there is room. */
static void list_channels(const struct exr_picture *from, char *out,
                          size_t size)
{
    size_t used = 0;
    *out = '\0';
    for (size_t i = 0; i < from->channels && used < size; i++)
        used += (size_t)snprintf(out + used, size - used, "%s%.60s",
                                 i > 0 ? ", " : "", from->name[i]);
    if (used >= size && size > 4)
        memcpy(out + size - 4, "...", 4);
}

static bool find_planes(const struct exr_picture *from, const char *path,
                        const char *layer, struct planes *out,
                        struct brume_error *err)
{
    char list[300];
    if (!find_colors(from, layer, "", out) &&
        !(layer && find_colors(from, layer, "Combined", out))) {
        list_channels(from, list, sizeof list);
        if (layer)
            return brume_fail_file(err, path,
                                   "has no layer '%.100s' with channels R, G "
                                   "and B, or Y; its channels are %s",
                                   layer, list);
        return brume_fail_file(err, path,
                               "has neither the channels R, G and B nor Y; its "
                               "channels are %s",
                               list);
    }
    out->depth = channel(from, layer, "", "Z");
    if (!out->depth && layer)
        out->depth = channel(from, layer, "Depth", "Z");
    return true;
}

/* ---- pixels ------------------------------------------------------------- */

static void take_color(struct plate *p, const struct planes *from, size_t i,
                       size_t to)
{
    float *c = p->radiance + 3 * to, a = from->alpha ? from->alpha[i] : 1.0f;
    bool finite = isfinite(a);
    for (int k = 0; k < 3; k++) {
        c[k] = from->color[k][i];
        finite = finite && isfinite(c[k]);
    }
    if (!finite) {
        c[0] = c[1] = c[2] = 0.0f;
        a = 1.0f;
        p->faulty++;
    }
    if (p->alpha)
        p->alpha[to] = fminf(fmaxf(a, 0.0f), 1.0f);
}

static void take_depth(struct plate *p, const struct planes *from, size_t i,
                       size_t to)
{
    float z = from->depth[i];
    bool good = z > 0.0f;
    p->depth[to] = good ? z : INFINITY;
    p->depthless += !good;
}

static void fill(struct plate *p, const struct exr_picture *from,
                 const struct planes *planes)
{
    size_t pixels = (size_t)p->width * (size_t)p->height;
    for (size_t i = 0; p->depth && i < pixels; i++)
        p->depth[i] = INFINITY;
    for (int y = 0; y < from->height; y++)
        for (int x = 0; x < from->width; x++) {
            int64_t column = (int64_t)x + from->x, row = (int64_t)y + from->y;
            if (column < 0 || row < 0 || column >= p->width || row >= p->height)
                continue;
            size_t i = (size_t)y * (size_t)from->width + (size_t)x;
            size_t to = (size_t)row * (size_t)p->width + (size_t)column;
            take_color(p, planes, i, to);
            if (p->depth)
                take_depth(p, planes, i, to);
        }
}

static bool is_cropped(const struct exr_picture *from)
{
    return from->x > 0 || from->y > 0 ||
           (int64_t)from->x + from->width < from->full_width ||
           (int64_t)from->y + from->height < from->full_height;
}

static struct plate *make(const struct exr_picture *from,
                          const struct planes *planes, struct brume_error *err)
{
    struct plate *p = memory_new(1, sizeof *p, err);
    if (!p)
        return NULL;
    p->width = from->full_width;
    p->height = from->full_height;
    size_t pixels = (size_t)p->width * (size_t)p->height;
    bool clear = planes->alpha || is_cropped(from);
    p->radiance = memory_new(3 * pixels, sizeof *p->radiance, err);
    p->alpha = clear ? memory_new(pixels, sizeof *p->alpha, err) : NULL;
    p->depth = planes->depth ? memory_new(pixels, sizeof *p->depth, err) : NULL;
    if (p->radiance && (p->alpha || !clear) && (p->depth || !planes->depth)) {
        fill(p, from, planes);
        return p;
    }
    plate_free(p);
    return NULL;
}

struct plate *plate_load(const char *path, const char *layer,
                         struct brume_error *err)
{
    struct exr_picture *from = exr_load(path, err);
    struct planes planes;
    struct plate *p = NULL;
    if (from && find_planes(from, path, layer, &planes, err))
        p = make(from, &planes, err);
    exr_free(from);
    return p;
}

void plate_free(struct plate *plate)
{
    if (!plate)
        return;
    free(plate->radiance);
    free(plate->alpha);
    free(plate->depth);
    free(plate);
}
