#include "lib/tga.h"
#include "lib/bytes.h"

enum { HEADER = 18 };
enum { TGA_PALETTE = 1, TGA_COLOR = 2, TGA_GREY = 3, TGA_RUNS = 8 };
enum { FROM_RIGHT = 0x10, FROM_TOP = 0x20 };

struct tga {
    struct bytes bytes;
    int kind; /* TGA_PALETTE, _COLOR or _GREY                */
    bool runs;
    int width, height;
    int size; /* bytes of a pixel                            */
    int descriptor;
    int colors, first, color_size;
    int left;      /* pixels of the present packet, if there are
                               runs; repeated if                           */
    bool repeated; /* ... this                                    */
    unsigned char pixel[4];
};

static int two(const unsigned char *at)
{
    return at[0] | at[1] << 8;
}

static bool is_supported(const struct tga *t, int pixel_bits, int color_bits)
{
    if (t->colors > 0 && (color_bits < 15 || color_bits > 32))
        return false;
    switch (t->kind) {
    case TGA_PALETTE:
        return pixel_bits == 8 && t->colors > 0 && t->first + t->colors <= 256;
    case TGA_COLOR:
        return pixel_bits == 15 || pixel_bits == 16 || pixel_bits == 24 ||
               pixel_bits == 32;
    case TGA_GREY:
        return pixel_bits == 8;
    default:
        return false;
    }
}

static bool read_header(struct tga *t)
{
    unsigned char head[HEADER], skipped[255];
    if (!bytes_read(&t->bytes, head, sizeof head))
        return false;
    t->kind = head[2] & ~TGA_RUNS;
    t->runs = (head[2] & TGA_RUNS) != 0;
    t->first = two(head + 3);
    t->colors = head[1] == 1 ? two(head + 5) : 0;
    t->color_size = (head[7] + 7) / 8;
    t->width = two(head + 12);
    t->height = two(head + 14);
    t->size = (head[16] + 7) / 8;
    t->descriptor = head[17];
    if (!is_supported(t, head[16], head[7]))
        return bytes_fail(&t->bytes, "it is none of the kinds of Targa files "
                                     "that are known");
    return bytes_read(&t->bytes, skipped, head[0]);
}

/* Blue, green, red to red, green, blue. */
static void turn(const unsigned char *from, int size, uint8_t out[3])
{
    int packed = two(from);
    for (int i = 0; i < 3; i++)
        out[i] = size > 2 ? from[2 - i]
                          : (uint8_t)((packed >> (10 - 5 * i) & 31) << 3);
}

static bool read_palette(struct tga *t, uint8_t palette[256][3])
{
    unsigned char color[4];
    for (int i = 0; i < t->colors; i++) {
        if (!bytes_read(&t->bytes, color, (size_t)t->color_size))
            return false;
        if (t->kind == TGA_PALETTE)
            turn(color, t->color_size, palette[t->first + i]);
    }
    return true;
}

/* The next pixel's bytes into t->pixel. */
static bool next_pixel(struct tga *t)
{
    unsigned char head;
    bool fresh = !t->runs;
    if (t->runs && t->left == 0) {
        if (!bytes_read(&t->bytes, &head, 1))
            return false;
        t->left = (head & 127) + 1;
        t->repeated = head > 127;
        fresh = true;
    }
    t->left--;
    return (!fresh && t->repeated) ||
           bytes_read(&t->bytes, t->pixel, (size_t)t->size);
}

static void store(const struct tga *t, struct raster *raster, int x, int y)
{
    int column = t->descriptor & FROM_RIGHT ? t->width - 1 - x : x;
    int row = t->descriptor & FROM_TOP ? y : t->height - 1 - y;
    uint16_t *out = raster->sample +
                    ((size_t)row * (size_t)t->width + (size_t)column) *
                        (size_t)raster->channels;
    uint8_t color[3];
    if (raster->channels == 1) {
        out[0] = t->pixel[0];
        return;
    }
    turn(t->pixel, t->size, color);
    for (int i = 0; i < 3; i++)
        out[i] = color[i];
    if (raster->channels == 4)
        out[3] = t->pixel[3];
}

static bool read_pixels(struct tga *t, struct raster *raster)
{
    for (int y = 0; y < t->height; y++)
        for (int x = 0; x < t->width; x++) {
            if (!next_pixel(t))
                return false;
            store(t, raster, x, y);
        }
    return true;
}

/* A run of 128 pixels takes a byte more than one pixel. */
static bool is_long_enough(struct tga *t)
{
    long long pixels = (long long)t->width * t->height;
    long long least = t->runs ? (pixels + 127) / 128 * (1 + t->size)
                              : pixels * t->size;
    long long ahead = bytes_ahead(&t->bytes);
    return ahead >= 0 &&
           (ahead >= least || bytes_fail(&t->bytes, "it ends too early"));
}

static struct raster *read_picture(struct tga *t)
{
    uint8_t palette[256][3] = {{0}};
    if (!read_header(t) || !read_palette(t, palette) || !is_long_enough(t))
        return NULL;
    int channels = t->kind != TGA_COLOR ? 1 : t->size == 4 ? 4 : 3;
    struct raster *raster = raster_new(t->width, t->height, channels, 255,
                                       t->bytes.path, t->bytes.err);
    if (!raster)
        return NULL;
    if (t->kind == TGA_PALETTE) {
        raster->colors = t->first + t->colors;
        for (int i = 0; i < 3 * 256; i++)
            raster->palette[i / 3][i % 3] = palette[i / 3][i % 3];
    }
    if (read_pixels(t, raster))
        return raster;
    raster_free(raster);
    return NULL;
}

struct raster *tga_load(const char *path, struct brume_error *err)
{
    struct tga t = {0};
    struct raster *raster = bytes_open(&t.bytes, path, err) ? read_picture(&t)
                                                            : NULL;
    bytes_close(&t.bytes);
    return raster;
}
