#include "lib/vdb_file.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include "lib/memory.h"

enum {
    OLDEST = 222,
    NEWEST = 225, /* file formats                        */
    MAX_GRIDS = 4096,
    MAX_ITEMS = 65536, /* of metadata                         */
    MAP_NAME = 64
};

/* ---- bytes ---- */

static bool broken(const struct vdb_file *f, const char *what)
{
    return brume_fail_file(f->err, f->path,
                           "%s near byte %llu: the file is damaged or cut "
                           "off",
                           what, (unsigned long long)f->at);
}

static bool get(struct vdb_file *f, void *to, size_t size)
{
    if (size > f->size - f->at)
        return broken(f, "ends too early");
    if (fread(to, 1, size, f->stream) != size)
        return brume_fail_file(f->err, f->path, "can't be read: %s",
                               ferror(f->stream) ? strerror(errno)
                                                 : "it became shorter");
    f->at += size;
    return true;
}

static bool go(struct vdb_file *f, uint64_t at)
{
    if (at > f->size)
        return broken(f, "points past its end");
    if (fseeko(f->stream, (off_t)at, SEEK_SET) != 0)
        return brume_fail_file(f->err, f->path, "can't be read: %s",
                               strerror(errno));
    f->at = at;
    return true;
}

static bool skip(struct vdb_file *f, uint64_t size)
{
    if (size > f->size - f->at)
        return broken(f, "ends too early");
    /* Small steps stay in the stream's buffer, where a seek would drop it. */
    char unused[256];
    if (size <= sizeof unused)
        return get(f, unused, (size_t)size);
    return go(f, f->at + size);
}

/* Files are little-endian, as OpenVDB's own reading assumes of its host. */
static bool get_u32(struct vdb_file *f, uint32_t *to)
{
    return get(f, to, sizeof *to);
}

static bool get_i64(struct vdb_file *f, int64_t *to)
{
    return get(f, to, sizeof *to);
}

/* A string with its length before it; what does not fit in `to` is cut. */
static bool get_string(struct vdb_file *f, char *to, size_t size)
{
    uint32_t length;
    if (!get_u32(f, &length))
        return false;
    size_t kept = length < size ? length : size - 1;
    if (!get(f, to, kept))
        return false;
    to[kept] = '\0';
    return skip(f, length - kept);
}

/* ---- header and directory ---- */

static bool read_header(struct vdb_file *f, bool *offsets)
{
    static const char magic[8] = " BDV";
    char start[8], flag, identifier[36];
    if (f->size < sizeof start || !get(f, start, sizeof start) ||
        memcmp(start, magic, sizeof magic) != 0)
        return brume_fail_file(f->err, f->path, "is not a VDB file");
    if (!get_u32(f, &f->version))
        return false;
    if (f->version < OLDEST || f->version > NEWEST)
        return brume_fail_file(f->err, f->path,
                               "has VDB format %u; formats %d to %d can be "
                               "read (OpenVDB 2 to 13): save it again with "
                               "such a version",
                               f->version, OLDEST, NEWEST);
    if (!get_u32(f, &f->library[0]) || !get_u32(f, &f->library[1]) ||
        !get(f, &flag, 1) || !get(f, identifier, sizeof identifier))
        return false;
    *offsets = flag != 0;
    return true;
}

static enum vdb_class class_of(const char *name)
{
    static const char *const names[] = {"unknown", "level set", "fog volume",
                                        "staggered"};
    for (int i = VDB_LEVEL_SET; i <= VDB_STAGGERED; i++)
        if (strcmp(name, names[i]) == 0)
            return (enum vdb_class)i;
    return VDB_UNKNOWN;
}

/* The value of one item of metadata, whose size stands before it. */
static bool read_item(struct vdb_file *f, const char *name, const char *type,
                      struct vdb_entry *entry)
{
    char class[32];
    uint32_t size;
    if (!get_u32(f, &size))
        return false;
    if (entry && strcmp(name, "class") == 0 && size < sizeof class) {
        class[size] = '\0';
        if (!get(f, class, size))
            return false;
        entry->kind = class_of(class);
        return true;
    }
    if (entry && strcmp(name, "file_voxel_count") == 0 &&
        strcmp(type, "int64") == 0 && size == sizeof(int64_t))
        return get_i64(f, &entry->active_voxels);
    return skip(f, size);
}

/* `entry` is NULL for the metadata of the whole file. */
static bool read_metadata(struct vdb_file *f, struct vdb_entry *entry)
{
    uint32_t count;
    if (!get_u32(f, &count))
        return false;
    if (count > MAX_ITEMS)
        return broken(f, "has too much metadata");
    for (uint32_t i = 0; i < count; i++) {
        char name[64], type[64];
        if (!get_string(f, name, sizeof name) ||
            !get_string(f, type, sizeof type) ||
            !read_item(f, name, type, entry))
            return false;
    }
    return true;
}

/* Repeated names are saved with a separator and a number behind them. */
static void show_name(struct vdb_entry *e, const char *unique)
{
    enum { SEPARATOR = 0x1e, ROOM = sizeof e->name - sizeof "[12345678]" };
    const char *number = strchr(unique, SEPARATOR);
    if (number)
        snprintf(e->name, sizeof e->name, "%.*s[%.8s]",
                 number - unique < ROOM ? (int)(number - unique) : ROOM, unique,
                 number + 1);
    else
        snprintf(e->name, sizeof e->name, "%.*s", (int)(sizeof e->name - 1),
                 unique);
}

bool vdb_file_named(const struct vdb_entry *e, const char *name)
{
    size_t plain = strcspn(e->name, "[");
    return strcmp(e->name, name) == 0 ||
           (strlen(name) == plain && strncmp(e->name, name, plain) == 0);
}

bool vdb_check_class(const struct vdb_entry *e, const char *path,
                     struct brume_error *err)
{
    return e->kind != VDB_LEVEL_SET ||
           brume_fail_file(err, path,
                           "grid '%s' is a level set, a surface: convert it to "
                           "a fog volume (Houdini: VDB Convert, SDF to Fog; "
                           "OpenVDB: sdfToFogVolume)",
                           e->name);
}

/* "Tree_float_5_4_3_HalfFloat", in r->tree, to its parts. */
static void split_type(struct vdb_record *r)
{
    static const char half[] = "_HalfFloat", prefix[] = "Tree_";
    static const char *const types[] = {"float", "double", "int32", "int64",
                                        "bool",  "vec3s",  "vec3d"};
    enum { SCALARS = 5 };
    struct vdb_entry *e = &r->entry;
    size_t length = strlen(r->tree), end = strlen(half);
    e->half = length > end && strcmp(r->tree + length - end, half) == 0;
    if (e->half)
        r->tree[length - end] = '\0';
    const char *from = strncmp(r->tree, prefix, strlen(prefix)) == 0
                           ? r->tree + strlen(prefix)
                           : r->tree;
    snprintf(e->type, sizeof e->type, "%.*s", (int)strcspn(from, "_"), from);
    char usual[64];
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        snprintf(usual, sizeof usual, "Tree_%s_5_4_3", types[i]);
        if (strcmp(r->tree, usual) == 0)
            *(i < SCALARS ? &e->scalar : &e->vector) = true;
    }
}

static bool read_grid(struct vdb_file *f, struct vdb_record *r)
{
    uint64_t at;
    uint32_t length;
    if (!go(f, r->grid_at) || !get_u32(f, &r->compression) ||
        !read_metadata(f, &r->entry))
        return false;
    r->transform_at = at = f->at;
    if (!get_u32(f, &length))
        return false;
    if (length >= MAP_NAME)
        return broken(f, "has a transform without a proper name");
    return go(f, at) && get_string(f, r->map, sizeof r->map);
}

/* A descriptor, then the head of its grid. */
static bool read_record(struct vdb_file *f, struct vdb_record *r)
{
    int64_t begin, blocks, end;
    if (!get_string(f, r->unique, sizeof r->unique) ||
        !get_string(f, r->tree, sizeof r->tree) ||
        !get_string(f, r->parent, sizeof r->parent) || !get_i64(f, &begin) ||
        !get_i64(f, &blocks) || !get_i64(f, &end))
        return false;
    if (begin < 0 || end < begin || (uint64_t)end > f->size)
        return broken(f, "has a grid outside of it");
    show_name(&r->entry, r->unique);
    split_type(r);
    r->entry.active_voxels = -1;
    r->grid_at = (uint64_t)begin;
    return read_grid(f, r) && go(f, (uint64_t)end);
}

static bool read_directory(struct vdb_file *f)
{
    uint32_t count;
    if (!get_u32(f, &count))
        return false;
    if (count > MAX_GRIDS)
        return broken(f, "has too many grids");
    for (uint32_t i = 0; i < count; i++) {
        struct vdb_record *list = memory_grow(
            f->record, &f->capacity, f->count + 1, sizeof *list, f->err);
        if (!list)
            return false;
        f->record = list;
        memset(&list[f->count], 0, sizeof *list);
        if (!read_record(f, &list[f->count++]))
            return false;
    }
    return true;
}

bool vdb_file_open(struct vdb_file *f, const char *path,
                   struct brume_error *err)
{
    memset(f, 0, sizeof *f);
    f->path = path;
    f->err = err;
    f->stream = fopen(path, "rb");
    if (!f->stream || fseeko(f->stream, 0, SEEK_END) != 0)
        return brume_fail_file(err, path, "can't be read: %s", strerror(errno));
    off_t size = ftello(f->stream);
    f->size = size > 0 ? (uint64_t)size : 0;
    bool offsets = false;
    if (!go(f, 0) || !read_header(f, &offsets))
        return false;
    if (!offsets)
        return brume_fail_file(err, path,
                               "was written as a stream, without "
                               "a directory of its grids: save it as a file");
    return read_metadata(f, NULL) && read_directory(f);
}

void vdb_file_close(struct vdb_file *f)
{
    free(f->record);
    if (f->stream)
        fclose(f->stream);
}

/* ---- trees ---- */

enum { ZIP = 1, ACTIVE_VALUES = 2, BLOSC = 4 };

enum { /* what stands before the values of a node     */
       ONE_INACTIVE = 2,
       MASK = 3,
       MASK_ONE = 4,
       MASK_TWO = 5,
       ALL_VALUES = 6
};

enum {
    UPPER_BYTES = 32768 / 8,
    LOWER_BYTES = 4096 / 8,
    LEAF_BYTES = 512 / 8,
    ROOT_CHILD = 4096 /* samples along a side                        */
};

struct walk {
    struct vdb_file *f;
    const struct vdb_layout *layout;
    uint16_t *active; /* of each leaf, in the order of the file      */
    size_t leaves, capacity;
};

static unsigned ones(const unsigned char *mask, size_t size)
{
    unsigned count = 0;
    for (size_t i = 0; i < size; i++)
        count += (unsigned)__builtin_popcount(mask[i]);
    return count;
}

/* Blosc reads a header of 16 bytes, and then as much as that says. */
static bool check_blosc(struct vdb_file *f, uint64_t size, uint64_t expected)
{
    struct {
        unsigned char kind[4];
        uint32_t bytes, block, packed;
    } head;
    if (size < sizeof head || !get(f, &head, sizeof head) ||
        head.bytes != expected || head.packed != size)
        return broken(f, "has a Blosc block of the wrong size");
    return skip(f, size - sizeof head);
}

/* One block of `count` values; ZIP and Blosc write its size before it, which
 * is negative where the values did not get smaller. */
static bool check_block(struct walk *w, unsigned count)
{
    struct vdb_file *f = w->f;
    uint64_t expected = (uint64_t)count * w->layout->stored;
    uint32_t compression = w->layout->compression;
    if (count == 0 && w->layout->stored != w->layout->value)
        return true; /* of no halves, OpenVDB writes no size either */
    if (!(compression & (ZIP | BLOSC)))
        return skip(f, expected);
    int64_t size;
    if (!get_i64(f, &size))
        return false;
    if (size <= 0 && (size < -INT32_MAX || (uint64_t)-size != expected))
        return broken(f, "has a block of the wrong size");
    if (size <= 0)
        return skip(f, expected);
    return compression & BLOSC ? check_blosc(f, (uint64_t)size, expected)
                               : skip(f, (uint64_t)size);
}

/* The values of a node of `total`, of which the mask makes some active. */
static bool check_values(struct walk *w, unsigned total, unsigned active)
{
    signed char kind;
    if (!get(w->f, &kind, 1))
        return false;
    unsigned values = kind == MASK_TWO                           ? 2
                      : kind == ONE_INACTIVE || kind == MASK_ONE ? 1
                                                                 : 0;
    if (!skip(w->f, values * w->layout->value))
        return false;
    if (kind >= MASK && kind <= MASK_TWO && !skip(w->f, total / 8))
        return false;
    bool fewer = w->layout->compression & ACTIVE_VALUES && kind != ALL_VALUES;
    return check_block(w, fewer ? active : total);
}

static bool check_leaf_topology(struct walk *w)
{
    unsigned char mask[LEAF_BYTES];
    uint16_t *active = memory_grow(w->active, &w->capacity, w->leaves + 1,
                                   sizeof *active, w->f->err);
    if (!active)
        return false;
    w->active = active;
    if (!get(w->f, mask, sizeof mask))
        return false;
    w->active[w->leaves++] = (uint16_t)ones(mask, sizeof mask);
    return true;
}

static bool disjoint(const unsigned char *a, const unsigned char *b,
                     size_t size)
{
    for (size_t i = 0; i < size; i++)
        if (a[i] & b[i])
            return false;
    return true;
}

/* Nodes with children: `size` bytes a mask. The order of the children among
 * themselves does not matter here, their number does. */
static bool check_inner(struct walk *w, size_t size)
{
    unsigned char child[UPPER_BYTES], value[UPPER_BYTES];
    if (!get(w->f, child, size) || !get(w->f, value, size))
        return false;
    if (!disjoint(child, value, size))
        return broken(w->f, "has a node that is both a value and a child");
    if (!check_values(w, (unsigned)size * 8, ones(value, size)))
        return false;
    unsigned children = ones(child, size);
    for (unsigned i = 0; i < children; i++)
        if (!(size == UPPER_BYTES ? check_inner(w, LOWER_BYTES)
                                  : check_leaf_topology(w)))
            return false;
    return true;
}

static bool get_corner(struct vdb_file *f, int32_t at[3])
{
    if (!get(f, at, 3 * sizeof *at))
        return false;
    for (int i = 0; i < 3; i++)
        if (at[i] % ROOT_CHILD != 0)
            return broken(f, "has a node off the lattice of nodes");
    return true;
}

static bool after(const int32_t a[3], const int32_t b[3])
{
    for (int i = 0; i < 3; i++)
        if (a[i] != b[i])
            return a[i] > b[i];
    return false;
}

static bool check_root(struct walk *w)
{
    struct vdb_file *f = w->f;
    uint32_t buffers, tiles, children;
    int32_t at[3], last[3];
    if (!get_u32(f, &buffers) || !skip(f, w->layout->value) ||
        !get_u32(f, &tiles) || !get_u32(f, &children))
        return false;
    if (buffers != 1)
        return broken(f, "has leaves of several buffers");
    for (uint32_t i = 0; i < tiles; i++) {
        unsigned char active;
        if (!get_corner(f, at) || !skip(f, w->layout->value) ||
            !get(f, &active, 1))
            return false;
        if (active > 1)
            return broken(f, "has a tile that is neither on nor off");
    }
    /* Buffers follow in the order of the corners, so topology must too. */
    for (uint32_t i = 0; i < children; i++) {
        if (!get_corner(f, at))
            return false;
        if (i > 0 && !after(at, last))
            return broken(f, "has nodes out of order");
        memcpy(last, at, sizeof last);
        if (!check_inner(w, UPPER_BYTES))
            return false;
    }
    return true;
}

static bool check_buffers(struct walk *w)
{
    enum { CORNER_BYTES = 12 };
    for (size_t i = 0; i < w->leaves; i++) {
        if (!skip(w->f, LEAF_BYTES))
            return false;
        if (!(w->layout->bits
                  ? skip(w->f, CORNER_BYTES + LEAF_BYTES)
                  : check_values(w, GRID_BRICK_VOXELS, w->active[i])))
            return false;
    }
    return true;
}

bool vdb_file_check_tree(struct vdb_file *f, uint64_t at,
                         const struct vdb_layout *layout)
{
    struct walk w = {.f = f, .layout = layout};
    bool ok = go(f, at) && check_root(&w) && check_buffers(&w);
    free(w.active);
    return ok;
}
