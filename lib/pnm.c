#include "lib/pnm.h"
#include <ctype.h>
#include "lib/bytes.h"

/* The next byte; a comment counts as the end of its line. */
static int next(struct bytes *b)
{
    int c = getc(b->stream);
    if (c != '#')
        return c;
    while (c != '\n' && c != '\r' && c != EOF)
        c = getc(b->stream);
    return c;
}

/* A number and the one byte behind it; -1 with err set: there is none. */
static long number(struct bytes *b, long most)
{
    long value = 0;
    int c = next(b);
    while (isspace(c))
        c = next(b);
    if (!isdigit(c)) {
        bytes_fail(b, c == EOF ? "it ends too early"
                               : "a number is missing in it");
        return -1;
    }
    for (; isdigit(c); c = next(b)) {
        value = 10 * value + (c - '0');
        if (value > most) {
            bytes_fail(b, "a number in it is too large");
            return -1;
        }
    }
    return value;
}

/* Samples of the raster in its file's order. */
static size_t samples(const struct raster *raster)
{
    return (size_t)raster->width * (size_t)raster->height *
           (size_t)raster->channels;
}

static bool read_plain(struct bytes *b, struct raster *raster)
{
    for (size_t i = 0; i < samples(raster); i++) {
        long value = number(b, (long)raster->max);
        if (value < 0)
            return false;
        raster->sample[i] = (uint16_t)value;
    }
    return true;
}

static bool read_binary(struct bytes *b, struct raster *raster)
{
    size_t size = raster->max > 255 ? 2 : 1;
    for (size_t i = 0; i < samples(raster); i++) {
        unsigned char byte[2] = {0};
        if (!bytes_read(b, byte + 2 - size, size))
            return false;
        raster->sample[i] = (uint16_t)(byte[0] << 8 | byte[1]);
        if (raster->sample[i] > raster->max)
            raster->sample[i] = (uint16_t)raster->max;
    }
    return true;
}

/* Each sample of a plain file has a digit and a blank, but the last. */
static bool is_long_enough(struct bytes *b, double samples, bool plain,
                           long max)
{
    double least = plain ? 2 * samples - 1 : samples * (max > 255 ? 2 : 1);
    long long ahead = bytes_ahead(b);
    return ahead >= 0 &&
           ((double)ahead >= least || bytes_fail(b, "it ends too early"));
}

static struct raster *read_picture(struct bytes *b)
{
    char magic[2];
    if (!bytes_read(b, magic, sizeof magic))
        return NULL;
    if (magic[0] != 'P' || !(magic[1] == '2' || magic[1] == '3' ||
                             magic[1] == '5' || magic[1] == '6')) {
        bytes_fail(b, "it does not begin with P2, P3, P5 or P6");
        return NULL;
    }
    bool plain = magic[1] < '4';
    int channels = (magic[1] - '0') % 3 == 2 ? 1 : 3;
    long width = number(b, RASTER_MOST);
    long height = width < 0 ? -1 : number(b, RASTER_MOST);
    long max = height < 0 ? -1 : number(b, UINT16_MAX);
    if (max < 0)
        return NULL;
    if (max == 0) {
        bytes_fail(b, "its greatest value is 0");
        return NULL;
    }
    if (!is_long_enough(b, (double)width * (double)height * channels, plain,
                        max))
        return NULL;
    struct raster *raster = raster_new(width, height, channels, (unsigned)max,
                                       b->path, b->err);
    if (!raster || (plain ? read_plain(b, raster) : read_binary(b, raster)))
        return raster;
    raster_free(raster);
    return NULL;
}

struct raster *pnm_load(const char *path, struct brume_error *err)
{
    struct bytes b;
    struct raster *raster = bytes_open(&b, path, err) ? read_picture(&b) : NULL;
    bytes_close(&b);
    return raster;
}
