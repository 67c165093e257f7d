#include "lib/nvdb_file.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>
#include "lib/memory.h"
#include "lib/vdb_file.h"
#include "lib/vdb_module.h"

enum { MAX_GRIDS = 4096, MAJOR = 32, HEADER = 16, METADATA = 176, NAME = 256 };

enum codec { PLAIN, ZIP, BLOSC };

/* ---- bytes ---- */

static bool broken(struct nvdb_file *f, const char *what)
{
    return brume_fail_file(f->bytes.err, f->bytes.path,
                           "%s: the file is damaged or cut off", what);
}

static uint64_t number(const unsigned char *from, int size)
{
    uint64_t value = 0;
    for (int i = size - 1; i >= 0; i--)
        value = value << 8 | from[i];
    return value;
}

static bool go(struct nvdb_file *f, uint64_t at)
{
    if (fseeko(f->bytes.stream, (off_t)at, SEEK_SET) == 0)
        return true;
    return bytes_fail(&f->bytes, strerror(errno));
}

static uint64_t here(const struct nvdb_file *f)
{
    return (uint64_t)ftello(f->bytes.stream);
}

/* ---- directory ---- */

/* "NanoVDB0" began files and grids until 32.6, since when "NanoVDB1" begins a
 * grid and "NanoVDB2" a file. */
static char kind_of(const unsigned char *magic)
{
    return memcmp(magic, "NanoVDB", 7) == 0 && magic[7] <= '2' ? (char)magic[7]
                                                               : '\0';
}

static bool check_version(struct nvdb_file *f, uint64_t version)
{
    unsigned major = (unsigned)(version >> 21);
    return major == MAJOR ||
           brume_fail_file(f->bytes.err, f->bytes.path,
                           "is of NanoVDB %u.%u; versions %d.x can be read: "
                           "convert it anew with OpenVDB 9 or later",
                           major, (unsigned)(version >> 10 & 0x7ff), MAJOR);
}

static void describe(struct nvdb_record *r, unsigned type, unsigned kind)
{
    static const char *const types[] = {
        "unknown", "float",      "double",       "int16",       "int32",
        "int64",   "vec3f",      "vec3d",        "mask",        "half",
        "uint32",  "bool",       "rgba8",        "fp4",         "fp8",
        "fp16",    "fpN",        "vec4f",        "vec4d",       "index",
        "onindex", "index mask", "onindex mask", "point index", "vec3u8",
        "vec3u16", "uint8",
    };
    bool known = type < sizeof types / sizeof *types;
    snprintf(r->entry.type, sizeof r->entry.type, "%s",
             known ? types[type] : "unknown");
    r->type = (enum nvdb_type)type;
    r->entry.half = type == NVDB_FP16;
    r->entry.scalar = type == NVDB_FLOAT || type == NVDB_DOUBLE ||
                      type == NVDB_INT32 || type == NVDB_INT64 ||
                      type == NVDB_BOOL ||
                      (type >= NVDB_FP4 && type <= NVDB_FPN);
    r->entry.kind = kind <= VDB_STAGGERED ? (enum vdb_class)kind : VDB_UNKNOWN;
}

/* A name that other grids have too gets its number among them. */
static void set_name(struct nvdb_file *f, struct nvdb_record *r,
                     const char *name)
{
    unsigned short same = 0; /* there are no more than MAX_GRIDS */
    snprintf(r->entry.name, sizeof r->entry.name, "%s", name);
    for (const struct nvdb_record *o = f->record; o < r; o++)
        same += vdb_file_named(&o->entry, name) ? 1 : 0;
    if (same > 0)
        snprintf(r->entry.name, sizeof r->entry.name, "%.40s[%hu]", name, same);
}

static struct nvdb_record *add_record(struct nvdb_file *f)
{
    if (f->count == MAX_GRIDS) {
        broken(f, "has too many grids");
        return NULL;
    }
    struct nvdb_record *list = memory_grow(
        f->record, &f->capacity, f->count + 1, sizeof *list, f->bytes.err);
    if (!list)
        return NULL;
    f->record = list;
    memset(&list[f->count], 0, sizeof *list);
    return &list[f->count++];
}

/* The metadata of one grid. */
static bool read_metadata(struct nvdb_file *f)
{
    unsigned char m[METADATA];
    char name[NAME] = "";
    if (!bytes_read(&f->bytes, m, sizeof m))
        return false;
    struct nvdb_record *r = add_record(f);
    if (!r)
        return false;
    uint64_t length = number(m + 136, 4);
    if (length > NAME)
        return broken(f, "has a grid whose name is too long");
    if (!bytes_read(&f->bytes, name, length))
        return false;
    name[NAME - 1] = '\0';
    describe(r, (unsigned)number(m + 32, 4), (unsigned)number(m + 36, 4));
    set_name(f, r, name);
    r->size = number(m, 8);
    r->entry.active_voxels = (int64_t)number(m + 24, 8);
    r->codec = (unsigned)number(m + 168, 2);
    return check_version(f, number(m + 172, 4));
}

/* Finds where a packed grid ends: each block of it has its size before it, and
 * Blosc's say how much they hold. The size in the metadata does not count: some
 * programs leave out the sizes of the blocks there. */
static bool measure(struct nvdb_file *f, struct nvdb_record *r)
{
    unsigned char head[24];
    uint64_t length = (uint64_t)f->bytes.length, held = 0;
    if (r->codec > BLOSC)
        return brume_fail_file(f->bytes.err, f->bytes.path,
                               "grid '%s' is packed by a codec of number %u; "
                               "none, ZIP and Blosc can be read",
                               r->entry.name, r->codec);
    r->at = here(f);
    r->packed = r->codec == PLAIN ? r->size : 0;
    while (r->codec != PLAIN && held < r->size) {
        if (!bytes_read(&f->bytes, head, sizeof head))
            return false;
        uint64_t size = number(head, 8);
        if (size > length || r->packed > length)
            return broken(f, "has a grid outside of it");
        r->packed += 8 + size;
        held = r->codec == BLOSC ? held + number(head + 12, 4) : r->size;
        if (!go(f, r->at + r->packed))
            return false;
    }
    if (r->packed > length - r->at)
        return broken(f, "has a grid outside of it");
    return go(f, r->at + r->packed);
}

/* A header, the metadata of its grids; then over the grids. */
static bool read_segment(struct nvdb_file *f, const unsigned char *header)
{
    uint64_t grids = number(header + 12, 2);
    size_t first = f->count;
    if (!check_version(f, number(header + 8, 4)) || !go(f, here(f) + HEADER))
        return false;
    for (uint64_t i = 0; i < grids; i++)
        if (!read_metadata(f))
            return false;
    for (size_t i = first; i < f->count; i++)
        if (!measure(f, &f->record[i]))
            return false;
    return true;
}

/* A grid without a segment around it. */
static bool read_bare(struct nvdb_file *f)
{
    unsigned char g[NVDB_GRID];
    char name[NAME];
    uint64_t at = here(f);
    if (!bytes_read(&f->bytes, g, sizeof g))
        return false;
    struct nvdb_record *r = add_record(f);
    if (!r)
        return false;
    memcpy(name, g + 40, NAME);
    name[NAME - 1] = '\0';
    describe(r, (unsigned)number(g + 636, 4), (unsigned)number(g + 632, 4));
    set_name(f, r, name);
    r->at = at;
    r->size = r->packed = number(g + 32, 8);
    r->entry.active_voxels = -1;
    if (r->size > (uint64_t)f->bytes.length - at || r->size < NVDB_GRID)
        return broken(f, "has a grid outside of it");
    return check_version(f, number(g + 16, 4)) && go(f, at + r->size);
}

static bool read_directory(struct nvdb_file *f)
{
    while (here(f) < (uint64_t)f->bytes.length) {
        unsigned char header[HEADER];
        uint64_t at = here(f);
        bool whole = fread(header, 1, HEADER, f->bytes.stream) == HEADER;
        char kind = whole ? kind_of(header) : '\0';
        if (!go(f, at))
            return false;
        if (!kind)
            return at > 0 ? broken(f, "has no grid where one should begin")
                          : brume_fail_file(f->bytes.err, f->bytes.path,
                                            "is not a NanoVDB file");
        if (kind == '1' ? !read_bare(f) : !read_segment(f, header))
            return false;
    }
    return f->bytes.length > 0 || brume_fail_file(f->bytes.err, f->bytes.path,
                                                  "is not a NanoVDB file");
}

bool nvdb_file_open(struct nvdb_file *f, const char *path,
                    struct brume_error *err)
{
    memset(f, 0, sizeof *f);
    return bytes_open(&f->bytes, path, err) && read_directory(f);
}

void nvdb_file_close(struct nvdb_file *f)
{
    free(f->record);
    bytes_close(&f->bytes);
}

/* ---- the bytes of a grid ---- */

/* ZIP makes no more than 1032 bytes of one, and Blosc by LZ4 255: so memory
 * grows with the file, not with what it says. */
enum { MAX_RATIO = 1040 };

static bool unpack_zip(struct nvdb_file *f, const unsigned char *from,
                       uint64_t size, unsigned char *to, uint64_t room)
{
    uLongf made = room;
    if (size < 8 || number(from, 8) > size - 8)
        return broken(f, "has a block of the wrong size");
    int code = uncompress(to, &made, from + 8, (uLong)number(from, 8));
    return (code == Z_OK && made == room) ||
           broken(f, "has a ZIP block that can't be unpacked");
}

/* Chunks of up to a GiB, each with its size before it. */
static bool unpack_blosc(struct nvdb_file *f, const unsigned char *from,
                         uint64_t size, unsigned char *to, uint64_t room)
{
    const struct vdb_module *module = vdb_module_for(f->bytes.path,
                                                     f->bytes.err);
    while (module && room > 0) {
        if (size < 8 || number(from, 8) > size - 8)
            return broken(f, "has a block of the wrong size");
        uint64_t packed = number(from, 8);
        size_t made = module->unpack(from + 8, packed, to, room);
        if (made == 0)
            return broken(f, "has a Blosc block that can't be unpacked");
        from += 8 + packed;
        size -= 8 + packed;
        to += made;
        room -= made;
    }
    return module != NULL;
}

static bool unpack(struct nvdb_file *f, const struct nvdb_record *r,
                   unsigned char *to)
{
    if (r->codec == PLAIN)
        return bytes_read(&f->bytes, to, r->size);
    unsigned char *from = memory_new(r->packed, 1, f->bytes.err);
    bool done = from && bytes_read(&f->bytes, from, r->packed) &&
                (r->codec == ZIP ? unpack_zip : unpack_blosc)(
                    f, from, r->packed, to, r->size);
    free(from);
    return done;
}

unsigned char *nvdb_file_grid(struct nvdb_file *f, const struct nvdb_record *r)
{
    bool sound = r->codec == PLAIN ? r->size == r->packed
                                   : r->size / MAX_RATIO <= r->packed;
    if (!sound || r->size < NVDB_GRID + NVDB_TREE) {
        broken(f, "has a grid of the wrong size");
        return NULL;
    }
    unsigned char *to = memory_new(r->size, 1, f->bytes.err);
    if (to && go(f, r->at) && unpack(f, r, to)) {
        if (kind_of(to) && number(to + 636, 4) == (uint64_t)r->type)
            return to;
        broken(f, "has a grid that is not of the type in its directory");
    }
    free(to);
    return NULL;
}
