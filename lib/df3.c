#include "lib/df3.h"
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "lib/memory.h"

enum { HEADER = 6 };

struct df3 {
    const char *path;
    FILE *stream;
    int size[3];  /* samples along x, y, z                   */
    size_t width; /* bytes of a sample: 1, 2 or 4            */
    struct brume_error *err;
};

static bool read_bytes(const struct df3 *d, void *to, size_t size)
{
    if (fread(to, 1, size, d->stream) == size)
        return true;
    return brume_fail_file(d->err, d->path, "can't be read: %s",
                           ferror(d->stream) ? strerror(errno)
                                             : "it ends too early");
}

/* Length of the file, its reading position back at the front; -1: error. */
static long long length(const struct df3 *d)
{
    if (fseeko(d->stream, 0, SEEK_END) == 0) {
        long long end = ftello(d->stream);
        if (end >= 0 && fseeko(d->stream, 0, SEEK_SET) == 0)
            return end;
    }
    brume_fail_file(d->err, d->path, "can't be read: %s", strerror(errno));
    return -1;
}

static bool read_header(struct df3 *d)
{
    unsigned char head[HEADER];
    long long found = length(d);
    if (found < 0)
        return false;
    if (found < HEADER)
        return brume_fail_file(d->err, d->path,
                               "is no df3 file: it has %lld "
                               "bytes, and the sizes alone take %d",
                               found, HEADER);
    if (!read_bytes(d, head, sizeof head))
        return false;
    long long samples = 1;
    for (int i = 0; i < 3; i++) {
        d->size[i] = head[2 * i] << 8 | head[2 * i + 1];
        samples *= d->size[i];
    }
    for (d->width = 1; d->width <= 4; d->width *= 2)
        if (samples > 0 && found == HEADER + samples * (long long)d->width)
            return true;
    return brume_fail_file(d->err, d->path,
                           "a df3 file of %d x %d x %d "
                           "samples has %lld, %lld or %lld bytes (8, 16 or "
                           "32 bits a sample); this has %lld",
                           d->size[0], d->size[1], d->size[2], HEADER + samples,
                           HEADER + 2 * samples, HEADER + 4 * samples, found);
}

/* The grid's bricks hold samples -1 to n along each axis. */
static struct grid *make_grid(const struct df3 *d, enum grid_filter filter)
{
    static const int32_t origin[3] = {-GRID_BRICK, -GRID_BRICK, -GRID_BRICK};
    int32_t bricks[3];
    for (int i = 0; i < 3; i++)
        bricks[i] = d->size[i] / GRID_BRICK + 2;
    struct grid *g = grid_new(origin, bricks, 0, d->err);
    if (!g)
        return NULL;
    double first = filter == GRID_NEAREST ? 0.5 : 0;
    g->filter = filter;
    g->clip = true;
    for (int i = 0; i < 3; i++) {
        g->clip_min[i] = -first;
        g->clip_max[i] = d->size[i] - first;
        g->to_world[i][i] = 1.0 / d->size[i];
        g->to_world[i][3] = first / d->size[i];
    }
    return g;
}

static float decode(const unsigned char *bytes, size_t width)
{
    static const double largest[] = {
        [1] = UINT8_MAX, [2] = UINT16_MAX, [4] = UINT32_MAX};
    uint32_t value = 0;
    for (size_t i = 0; i < width; i++)
        value = value << 8 | bytes[i];
    return (float)(value / largest[width]);
}

static int clamp(int i, int count)
{
    return i < 0 ? 0 : i < count ? i : count - 1;
}

static bool set_sample(struct grid *g, int x, int y, int z, float value,
                       struct brume_error *err)
{
    if (value == 0)
        return true;
    x += GRID_BRICK;
    y += GRID_BRICK;
    z += GRID_BRICK;
    float *brick = grid_brick(g, x / GRID_BRICK, y / GRID_BRICK, z / GRID_BRICK,
                              err);
    if (!brick)
        return false;
    brick[x % GRID_BRICK +
          GRID_BRICK * (y % GRID_BRICK + GRID_BRICK * (z % GRID_BRICK))] =
        value;
    return true;
}

/* One slice of the file into layer z of the grid, with its outer samples
 * repeated. */
static bool fill_layer(const struct df3 *d, struct grid *g,
                       const unsigned char *slice, int z)
{
    for (int y = -1; y <= d->size[1]; y++) {
        const unsigned char *row = slice + (size_t)clamp(y, d->size[1]) *
                                               (size_t)d->size[0] * d->width;
        for (int x = -1; x <= d->size[0]; x++) {
            size_t at = (size_t)clamp(x, d->size[0]) * d->width;
            if (!set_sample(g, x, y, z, decode(row + at, d->width), d->err))
                return false;
        }
    }
    return true;
}

static bool fill(const struct df3 *d, struct grid *g)
{
    size_t bytes = (size_t)d->size[0] * (size_t)d->size[1] * d->width;
    unsigned char *slice = memory_new(bytes, 1, d->err);
    bool ok = slice != NULL;
    for (int z = 0; ok && z < d->size[2]; z++) {
        ok = read_bytes(d, slice, bytes) && fill_layer(d, g, slice, z);
        if (ok && z == 0)
            ok = fill_layer(d, g, slice, -1);
        if (ok && z == d->size[2] - 1)
            ok = fill_layer(d, g, slice, z + 1);
    }
    free(slice);
    return ok;
}

static struct grid *load(struct df3 *d, enum grid_filter filter)
{
    struct grid *g = read_header(d) ? make_grid(d, filter) : NULL;
    if (g && !fill(d, g)) {
        grid_free(g);
        return NULL;
    }
    if (g)
        grid_finish(g);
    return g;
}

struct grid *df3_load(const char *path, enum grid_filter filter,
                      struct brume_error *err)
{
    struct df3 d = {.path = path, .err = err};
    d.stream = fopen(path, "rb");
    if (!d.stream) {
        brume_fail_file(err, path, "can't be read: %s", strerror(errno));
        return NULL;
    }
    struct grid *g = load(&d, filter);
    fclose(d.stream);
    return g;
}
