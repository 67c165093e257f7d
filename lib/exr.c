#include "lib/exr.h"
#include <errno.h>
#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <openexr.h>
#include "lib/memory.h"
#include "lib/output.h"
#include "lib/thread.h"

/* Lines of a block of ZIP compression. The last of its levels that looks no
 * further for better matches takes two thirds of the time of the default one,
 * for 1 % more bytes. */
enum { BLOCK_LINES = 16, ZIP_LEVEL = 3 };

/* A header can promise any size; beyond this no file of ours or of a plate
 * goes, and the planes would take over a GiB each. */
#define MAX_PIXELS ((int64_t)1 << 28)

/* What the library's callbacks see. */
struct session {
    const char *path;
    int fd; /* of the output; -1 when reading          */
    struct brume_error *err;
    pthread_mutex_t lock; /* of err, where several threads write */
};

/* ---- what writing and reading share ---- */

static void on_error(exr_const_context_t context, exr_result_t code,
                     const char *message)
{
    void *user = NULL;
    if (!context || exr_get_user_data(context, &user) != EXR_ERR_SUCCESS ||
        !user)
        return;
    struct session *s = user;
    pthread_mutex_lock(&s->lock);
    brume_fail_file(s->err, s->path, "%s",
                    message ? message : exr_get_default_error_message(code));
    pthread_mutex_unlock(&s->lock);
}

/* The error is the callback's where it was called: the first one stays. */
static bool check(const struct session *s, exr_result_t result)
{
    if (result == EXR_ERR_SUCCESS)
        return true;
    if (result == EXR_ERR_OUT_OF_MEMORY)
        return brume_fail(s->err, BRUME_ERR_MEMORY,
                          "no memory for the picture '%s'", s->path);
    return brume_fail_file(s->err, s->path, "%s",
                           exr_get_default_error_message(result));
}

static exr_context_initializer_t initializer(struct session *s)
{
    exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
    init.error_handler_fn = on_error;
    init.user_data = s;
    init.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    return init;
}

/* ---- writing ---- */

static int64_t write_bytes(exr_const_context_t context, void *user,
                           const void *buffer, uint64_t size, uint64_t offset,
                           exr_stream_error_func_ptr_t fail)
{
    const struct session *s = user;
    const char *from = buffer;
    uint64_t done = 0;
    while (done < size) {
        ssize_t n = pwrite(s->fd, from + done, size - done,
                           (off_t)(offset + done));
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0) {
            fail(context, EXR_ERR_WRITE_IO, "can't be written: %s",
                 strerror(errno));
            return -1;
        }
        done += (uint64_t)n;
    }
    return (int64_t)size;
}

static bool write_header(const struct session *s, exr_context_t context,
                         const struct image *image, const struct exr_text *text,
                         size_t texts)
{
    int part;
    bool ok = check(s,
                    exr_add_part(context, NULL, EXR_STORAGE_SCANLINE, &part)) &&
              check(s, exr_initialize_required_attr_simple(
                           context, part, image->width, image->height,
                           EXR_COMPRESSION_ZIP));
    for (size_t i = 0; ok && i < image->channels; i++)
        ok = check(s, exr_add_channel(context, part, image->channel[i].name,
                                      EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LINEAR,
                                      1, 1));
    for (size_t i = 0; ok && i < texts; i++)
        ok = check(
            s, exr_attr_set_string(context, part, text[i].name, text[i].value));
    return ok && check(s, exr_write_header(context));
}

/* The rows of a block, plane after plane, in the file's order of channels. */
static void fill_block(const struct image *image, int y,
                       exr_encode_pipeline_t *encode, float *block)
{
    size_t width = (size_t)image->width;
    for (int c = 0; c < encode->channel_count; c++) {
        exr_coding_channel_info_t *to = &encode->channels[c];
        const struct image_channel *from = image_find(image, to->channel_name);
        float *plane = block + (size_t)c * BLOCK_LINES * width;
        for (int line = 0; line < to->height; line++)
            image_row(image, from, y + line, plane + (size_t)line * width, 1);
        to->user_bytes_per_element = sizeof(float);
        to->user_data_type = EXR_PIXEL_FLOAT;
        to->user_pixel_stride = sizeof(float);
        to->user_line_stride = (int32_t)(width * sizeof(float));
        to->encode_from_ptr = (const uint8_t *)plane;
    }
}

/* A block as it will be in the file. */
struct packed {
    void *bytes;
    uint64_t size;
    exr_result_t result;
};

/* Blocks are packed by all threads, and written one after the other. */
struct packing {
    exr_context_t context;
    const struct image *image;
    struct packed *block;
    float *room; /* of each thread, for the samples of a block          */
    size_t samples;
};

/* In place of the library's writing, for which blocks would have to wait. */
static exr_result_t keep_packed(exr_encode_pipeline_t *encode)
{
    struct packed *to = encode->encoding_user_data;
    to->size = encode->compressed_bytes;
    to->bytes = malloc(to->size);
    if (!to->bytes)
        return EXR_ERR_OUT_OF_MEMORY;
    memcpy(to->bytes, encode->compressed_buffer, to->size);
    return EXR_ERR_SUCCESS;
}

static exr_result_t pack(const struct packing *p, int y, float *room,
                         struct packed *to)
{
    exr_encode_pipeline_t encode = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_chunk_info_t chunk = {0};
    exr_result_t result = exr_write_scanline_chunk_info(p->context, 0, y,
                                                        &chunk);
    if (result == EXR_ERR_SUCCESS)
        result = exr_encoding_initialize(p->context, 0, &chunk, &encode);
    if (result != EXR_ERR_SUCCESS)
        return result;
    fill_block(p->image, y, &encode, room);
    result = exr_encoding_choose_default_routines(p->context, 0, &encode);
    encode.encoding_user_data = to;
    encode.yield_until_ready_fn = NULL;
    encode.write_fn = keep_packed;
    if (result == EXR_ERR_SUCCESS)
        result = exr_encoding_run(p->context, 0, &encode);
    exr_encoding_destroy(p->context, &encode);
    return result;
}

static void pack_block(void *context, size_t index, int thread)
{
    const struct packing *p = context;
    float *room = p->room + (size_t)thread * p->samples;
    struct packed *block = &p->block[index];
    block->result = pack(p, (int)index * BLOCK_LINES, room, block);
}

static bool write_packed(const struct session *s, exr_context_t context,
                         const struct packed *block, size_t count)
{
    bool ok = true;
    for (size_t i = 0; ok && i < count; i++)
        ok = check(s, block[i].result) &&
             check(s, exr_write_scanline_chunk(context, 0, (int)i * BLOCK_LINES,
                                               block[i].bytes, block[i].size));
    return ok;
}

static bool write_blocks(const struct session *s, exr_context_t context,
                         const struct image *image, int threads)
{
    size_t count = ((size_t)image->height + BLOCK_LINES - 1) / BLOCK_LINES;
    struct packing p = {.context = context, .image = image};
    threads = threads > 0 ? threads : thread_processors();
    if ((size_t)threads > count)
        threads = (int)count;
    if (!memory_multiply((size_t)image->width * BLOCK_LINES, image->channels,
                         &p.samples))
        return brume_fail(s->err, BRUME_ERR_MEMORY, "too many channels");
    p.block = memory_new(count, sizeof *p.block, s->err);
    p.room = memory_new((size_t)threads * sizeof *p.room, p.samples, s->err);
    bool ok = p.block && p.room;
    if (ok) {
        parallel_for(threads, count, pack_block, &p, NULL);
        ok = write_packed(s, context, p.block, count);
    }
    for (size_t i = 0; p.block && i < count; i++)
        free(p.block[i].bytes);
    free(p.block);
    free(p.room);
    return ok;
}

static bool write_file(struct session *s, const struct image *image,
                       const struct exr_text *text, size_t texts, int threads)
{
    exr_context_initializer_t init = initializer(s);
    init.write_fn = write_bytes;
    init.zip_level = ZIP_LEVEL;
    exr_context_t context = NULL;
    bool ok = check(s, exr_start_write(&context, s->path,
                                       EXR_WRITE_FILE_DIRECTLY, &init)) &&
              write_header(s, context, image, text, texts) &&
              write_blocks(s, context, image, threads);
    if (context)
        ok = check(s, exr_finish(&context)) && ok;
    return ok;
}

bool exr_save(const char *path, const struct image *image,
              const struct exr_text *text, size_t texts, int threads,
              struct brume_error *err)
{
    if (!image_check(image, err))
        return false;
    struct output *o = output_open(path, err);
    if (!o)
        return false;
    struct session s = {path, fileno(output_stream(o)), err,
                        PTHREAD_MUTEX_INITIALIZER};
    return output_close(o, write_file(&s, image, text, texts, threads), err);
}

/* ---- reading ---- */

static bool window_size(const struct session *s, const exr_attr_box2i_t *box,
                        int *width, int *height)
{
    int64_t w = (int64_t)box->max.x - box->min.x + 1;
    int64_t h = (int64_t)box->max.y - box->min.y + 1;
    if (w < 1 || h < 1 || w > MAX_PIXELS || h > MAX_PIXELS ||
        w * h > MAX_PIXELS)
        return brume_fail_file(s->err, s->path,
                               "a window of %lld x %lld "
                               "pixels is empty or over the limit of %lld",
                               (long long)w, (long long)h,
                               (long long)MAX_PIXELS);
    *width = (int)w;
    *height = (int)h;
    return true;
}

static bool read_windows(const struct session *s, exr_context_t context,
                         struct exr_picture *picture)
{
    exr_attr_box2i_t data, display;
    if (!check(s, exr_get_data_window(context, 0, &data)) ||
        !check(s, exr_get_display_window(context, 0, &display)) ||
        !window_size(s, &data, &picture->width, &picture->height) ||
        !window_size(s, &display, &picture->full_width, &picture->full_height))
        return false;
    picture->x = (int)((int64_t)data.min.x - display.min.x);
    picture->y = (int)((int64_t)data.min.y - display.min.y);
    return true;
}

static bool make_planes(const struct session *s, exr_context_t context,
                        struct exr_picture *picture)
{
    const exr_attr_chlist_t *list;
    if (!check(s, exr_get_channels(context, 0, &list)))
        return false;
    size_t count = (size_t)list->num_channels;
    picture->name = memory_new(count, sizeof *picture->name, s->err);
    picture->plane = memory_new(count, sizeof *picture->plane, s->err);
    if (!picture->name || !picture->plane)
        return false;
    size_t pixels = (size_t)picture->width * (size_t)picture->height;
    for (size_t i = 0; i < count; i++) {
        const exr_attr_chlist_entry_t *entry = &list->entries[i];
        if (entry->x_sampling != 1 || entry->y_sampling != 1)
            return brume_fail_file(s->err, s->path,
                                   "channel %.200s has fewer "
                                   "samples than pixels, which is not "
                                   "supported",
                                   entry->name.str);
        snprintf(picture->name[i], sizeof picture->name[i], "%s",
                 entry->name.str);
        picture->plane[i] = memory_new(pixels, sizeof(float), s->err);
        if (!picture->plane[i])
            return false;
        picture->channels++;
    }
    return true;
}

/* Where a chunk goes: the plane at its corner. The library converts half to
 * float; integers come as they are and are converted afterwards. */
static void aim(exr_decode_pipeline_t *decode, struct exr_picture *picture,
                int x, int y)
{
    size_t offset = (size_t)y * (size_t)picture->width + (size_t)x;
    for (int c = 0; c < decode->channel_count; c++) {
        exr_coding_channel_info_t *to = &decode->channels[c];
        to->user_bytes_per_element = sizeof(float);
        to->user_data_type = to->data_type == EXR_PIXEL_UINT ? EXR_PIXEL_UINT
                                                             : EXR_PIXEL_FLOAT;
        to->user_pixel_stride = sizeof(float);
        to->user_line_stride = (int32_t)((size_t)picture->width *
                                         sizeof(float));
        to->decode_to_ptr = (uint8_t *)(picture->plane[c] + offset);
    }
}

static bool decode_chunk(const struct session *s, exr_context_t context,
                         const exr_chunk_info_t *chunk,
                         exr_decode_pipeline_t *decode,
                         struct exr_picture *picture, int x, int y)
{
    bool first = decode->channels == NULL;
    if (!check(s, first ? exr_decoding_initialize(context, 0, chunk, decode)
                        : exr_decoding_update(context, 0, chunk, decode)))
        return false;
    aim(decode, picture, x, y);
    if (first &&
        !check(s, exr_decoding_choose_default_routines(context, 0, decode)))
        return false;
    return check(s, exr_decoding_run(context, 0, decode));
}

static bool read_scanlines(const struct session *s, exr_context_t context,
                           struct exr_picture *picture,
                           exr_decode_pipeline_t *decode)
{
    int32_t lines;
    exr_attr_box2i_t data;
    if (!check(s, exr_get_scanlines_per_chunk(context, 0, &lines)) ||
        !check(s, exr_get_data_window(context, 0, &data)))
        return false;
    for (int y = 0; y < picture->height; y += lines) {
        exr_chunk_info_t chunk = {0};
        if (!check(s, exr_read_scanline_chunk_info(context, 0, data.min.y + y,
                                                   &chunk)) ||
            !decode_chunk(s, context, &chunk, decode, picture, 0, y))
            return false;
    }
    return true;
}

static bool read_tiles(const struct session *s, exr_context_t context,
                       struct exr_picture *picture,
                       exr_decode_pipeline_t *decode)
{
    int32_t wide, high;
    if (!check(s, exr_get_tile_sizes(context, 0, 0, 0, &wide, &high)))
        return false;
    if (wide < 1 || high < 1)
        return brume_fail_file(s->err, s->path, "tiles of %d x %d pixels", wide,
                               high);
    for (int y = 0; y < picture->height; y += high)
        for (int x = 0; x < picture->width; x += wide) {
            exr_chunk_info_t chunk = {0};
            if (!check(s, exr_read_tile_chunk_info(context, 0, x / wide,
                                                   y / high, 0, 0, &chunk)) ||
                !decode_chunk(s, context, &chunk, decode, picture, x, y))
                return false;
        }
    return true;
}

static void convert_integers(const exr_decode_pipeline_t *decode,
                             struct exr_picture *picture)
{
    size_t pixels = (size_t)picture->width * (size_t)picture->height;
    for (int c = 0; c < decode->channel_count; c++) {
        if (decode->channels[c].data_type != EXR_PIXEL_UINT)
            continue;
        for (size_t i = 0; i < pixels; i++) {
            uint32_t bits;
            memcpy(&bits, &picture->plane[c][i], sizeof bits);
            picture->plane[c][i] = (float)bits;
        }
    }
}

static bool read_pixels(const struct session *s, exr_context_t context,
                        struct exr_picture *picture)
{
    exr_storage_t storage;
    int parts;
    if (!check(s, exr_get_count(context, &parts)) ||
        !check(s, exr_get_storage(context, 0, &storage)))
        return false;
    bool tiled = storage == EXR_STORAGE_TILED;
    if (parts != 1 || (!tiled && storage != EXR_STORAGE_SCANLINE))
        return brume_fail_file(s->err, s->path,
                               "has %d parts%s; one part "
                               "of plain pixels is needed",
                               parts, parts == 1 ? " of deep pixels" : "");
    if (!read_windows(s, context, picture) || !make_planes(s, context, picture))
        return false;
    exr_decode_pipeline_t decode = EXR_DECODE_PIPELINE_INITIALIZER;
    bool ok = tiled ? read_tiles(s, context, picture, &decode)
                    : read_scanlines(s, context, picture, &decode);
    if (ok)
        convert_integers(&decode, picture);
    exr_decoding_destroy(context, &decode);
    return ok;
}

struct exr_picture *exr_load(const char *path, struct brume_error *err)
{
    struct session s = {path, -1, err, PTHREAD_MUTEX_INITIALIZER};
    exr_context_initializer_t init = initializer(&s);
    exr_context_t context = NULL;
    struct exr_picture *picture = memory_new(1, sizeof *picture, err);
    if (!picture)
        return NULL;
    bool ok = check(&s, exr_start_read(&context, path, &init)) &&
              read_pixels(&s, context, picture);
    exr_finish(&context);
    if (ok)
        return picture;
    exr_free(picture);
    return NULL;
}

bool exr_text_of(const char *path, const char *name, char *out, size_t size)
{
    struct brume_error err = {0};
    struct session s = {path, -1, &err, PTHREAD_MUTEX_INITIALIZER};
    exr_context_initializer_t init = initializer(&s);
    exr_context_t context = NULL;
    int32_t length = 0;
    const char *text = NULL;
    bool ok = exr_start_read(&context, path, &init) == EXR_ERR_SUCCESS &&
              exr_attr_get_string(context, 0, name, &length, &text) ==
                  EXR_ERR_SUCCESS &&
              length >= 0 && (size_t)length < size;
    if (ok) {
        memcpy(out, text, (size_t)length);
        out[length] = '\0';
    }
    exr_finish(&context);
    return ok;
}

void exr_free(struct exr_picture *picture)
{
    if (!picture)
        return;
    for (size_t i = 0; i < picture->channels; i++)
        free(picture->plane[i]);
    free(picture->plane);
    free(picture->name);
    free(picture);
}

const float *exr_plane(const struct exr_picture *picture, const char *name)
{
    for (size_t i = 0; i < picture->channels; i++)
        if (strcmp(picture->name[i], name) == 0)
            return picture->plane[i];
    return NULL;
}
