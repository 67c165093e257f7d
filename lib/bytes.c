#include "lib/bytes.h"
#include <errno.h>
#include <string.h>

bool bytes_fail(struct bytes *b, const char *text)
{
    return brume_fail_file(b->err, b->path, "can't be read: %s", text);
}

bool bytes_open(struct bytes *b, const char *path, struct brume_error *err)
{
    *b = (struct bytes){.path = path, .err = err};
    b->stream = fopen(path, "rb");
    if (b->stream && fseeko(b->stream, 0, SEEK_END) == 0) {
        b->length = ftello(b->stream);
        if (b->length >= 0 && fseeko(b->stream, 0, SEEK_SET) == 0)
            return true;
    }
    return bytes_fail(b, strerror(errno));
}

void bytes_close(struct bytes *b)
{
    if (b->stream)
        fclose(b->stream);
}

bool bytes_read(struct bytes *b, void *to, size_t size)
{
    if (fread(to, 1, size, b->stream) == size)
        return true;
    return bytes_fail(b, ferror(b->stream) ? strerror(errno)
                                           : "it ends too early");
}

long long bytes_ahead(struct bytes *b)
{
    long long at = ftello(b->stream);
    if (at < 0)
        bytes_fail(b, strerror(errno));
    return at < 0 ? -1 : b->length - at;
}
