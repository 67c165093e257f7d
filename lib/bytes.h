/* bytes.h - small binary files, read byte by byte. */
#ifndef LIB_BYTES_H
#define LIB_BYTES_H
#include <stdio.h>
#include "lib/error.h"

struct bytes {
    const char *path;
    FILE *stream;
    long long length;       /* of the file                                 */
    struct brume_error *err;
};

/* Opens a file. False with err set; to be closed in both cases. `path` and
 * `err` stay in use until then. */
bool bytes_open(struct bytes *b, const char *path, struct brume_error *err);
void bytes_close(struct bytes *b);

/* The next `size` bytes; false with err set: there are not so many. */
bool bytes_read(struct bytes *b, void *to, size_t size);

/* How many bytes lie ahead; -1 with err set. */
long long bytes_ahead(struct bytes *b);

/* Records an error of the file; returns false. */
bool bytes_fail(struct bytes *b, const char *text);
#endif
