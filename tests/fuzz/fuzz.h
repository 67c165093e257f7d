/* fuzz.h - what is done with an input that a fuzzer made: it may be refused,
 * but must not crash, hang, or leave memory behind. */
#ifndef TESTS_FUZZ_FUZZ_H
#define TESTS_FUZZ_FUZZ_H
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include "lib/df3.h"
#include "lib/nvdb.h"
#include "lib/obj.h"
#include "lib/ply.h"
#include "lib/radiance.h"
#include "lib/raster.h"
#include "lib/vdb.h"
#include "parser/options.h"
#include "parser/parse.h"

/* What is called for each input; the name is libFuzzer's. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A scene. Its last bit says whether the parse goes on behind errors. The
 * limits are low so that inputs a second are many. */
static inline void fuzz_scene(const uint8_t *data, size_t size)
{
    struct parse_input in = {
        .path = "scene.pov",
        .text = (const char *)data,
        .length = size,
        .all_errors = size > 0 && (data[size - 1] & 1),
        .ambient = PARSE_AMBIENT_INIT,
        .limits = {.macro_depth = 100, .iterations = 200, .tokens = 5000,
                   .memory = 64 << 20, .seconds = 5},
    };
    struct parse_result result;
    struct diag diag;

    diag_init(&diag);
    if (parse_scene(&in, &result, &diag) != (diag.errors == 0))
        abort();
    brume_scene_free(result.scene);
    diag_release(&diag);
}

/* The path of a file without a place, whose text is the input. */
static inline const char *fuzz_file(const uint8_t *data, size_t size, int *fd,
                                    char path[static 32])
{
    *fd = memfd_create("fuzz", 0);
    if (*fd < 0 || write(*fd, data, size) != (ssize_t)size)
        abort();
    snprintf(path, 32, "/proc/self/fd/%d", *fd);
    return path;
}

static inline void fuzz_words(struct options *options, char *text,
                              struct diag *diag)
{
    enum { MOST = 32 };
    const char *word[MOST];
    int count = 0;
    for (char *at = strtok(text, "\n"); at && count < MOST;
         at = strtok(NULL, "\n"))
        word[count++] = at;
    options_read_words(options, count, word, diag);
}

/* An INI file; its lines are the words of a command line too. */
static inline void fuzz_options(const uint8_t *data, size_t size)
{
    struct options options;
    struct diag diag;
    char path[32], *text = calloc(1, size + 1);
    int fd;
    if (!text)
        abort();
    if (size > 0)
        memcpy(text, data, size);
    diag_init(&diag);
    options_init(&options);
    options_read_ini(&options, fuzz_file(data, size, &fd, path), NULL, &diag);
    fuzz_words(&options, text, &diag);
    options_release(&options);
    diag_release(&diag);
    close(fd);
    free(text);
}

/* A data file, for each of the readers. */
static inline void fuzz_data(const uint8_t *data, size_t size)
{
    static const char *const format[] = {"png", "ppm", "tga", "jpeg",
                                         "gif"};
    struct brume_error err[12] = {{0}};
    char path[32];
    int fd;
    fuzz_file(data, size, &fd, path);
    grid_free(df3_load(path, GRID_TRILINEAR, &err[0]));
    mesh_free(ply_load(path, &err[1]));
    mesh_free(obj_load(path, &err[2]));
    vdb_list_free(vdb_list_new(path, &err[3]));
    points_free(ply_load_points(path, NULL, &err[5]));
    grid_free(nvdb_load(path, NULL, VDB_DENSITY, &err[4]));
    radiance_free(radiance_load(path, &err[6]));
    for (int i = 0; i < 5; i++)
        raster_free(raster_load(format[i], path, &err[7 + i]));
    close(fd);
}

#endif
