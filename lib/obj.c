#include "lib/obj.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "lib/scan.h"

enum { VERTEX, UV, NORMAL, KINDS };

struct corner {
    uint32_t index[KINDS]; /* MESH_NONE where there is none       */
};

struct obj {
    struct scan scan;
    struct mesh *mesh;
    struct brume_error *err;
};

/* The next word of a statement: a backslash continues it on the next line. */
static bool next_word(struct obj *o)
{
    while (scan_word(&o->scan)) {
        if (strcmp(o->scan.word, "\\") != 0)
            return true;
        if (!scan_line(&o->scan))
            return false;
    }
    return false;
}

/* Up to `count` numbers, `needed` at least; the others stay 0. */
static bool read_numbers(struct obj *o, const char *what, double *to,
                         int needed, int count)
{
    for (int i = 0; i < count; i++) {
        to[i] = 0;
        if (next_word(o)) {
            if (!scan_number(&o->scan, &to[i]))
                return false;
        } else if (i < needed) {
            return scan_fail(&o->scan, "%s of %d numbers; it has %d", what, i,
                             needed);
        }
    }
    return true;
}

static bool read_vertex(struct obj *o)
{
    double p[3];
    if (!read_numbers(o, "a vertex", p, 3, 3))
        return false;
    for (int i = 0; i < 3; i++)
        if (!isfinite(p[i]))
            return scan_fail(&o->scan, "a vertex has the coordinate %g", p[i]);
    return mesh_add_vertex(o->mesh, p, o->err);
}

static bool read_uv(struct obj *o)
{
    double p[2];
    if (!read_numbers(o, "a texture coordinate", p, 1, 2))
        return false;
    float uv[2] = {(float)p[0], (float)p[1]};
    return mesh_add_uv(o->mesh, uv, o->err);
}

static bool read_normal(struct obj *o)
{
    double p[3];
    if (!read_numbers(o, "a normal", p, 3, 3))
        return false;
    float n[3] = {(float)p[0], (float)p[1], (float)p[2]};
    return mesh_add_normal(o->mesh, n, o->err);
}

/* "7" or "-1" as an index from 0 into the `count` items so far. */
static bool read_index(struct obj *o, const char *text, const char *what,
                       size_t count, uint32_t *index)
{
    double value;
    if (!scan_is_number(&o->scan, text, &value) || floor(value) != value)
        return scan_fail(&o->scan, "'%.40s' is not the number of a %s", text,
                         what);
    double at = value < 0 ? (double)count + value : value - 1;
    if (!(at >= 0 && at < (double)count))
        return scan_fail(&o->scan,
                         "a face names %s %.0f; there are %zu so "
                         "far",
                         what, value, count);
    *index = (uint32_t)at;
    return true;
}

/* A word of a face: v, v/vt, v//vn or v/vt/vn. */
static bool read_corner(struct obj *o, struct corner *corner)
{
    static const char *const what[] = {"vertex", "texture coordinate",
                                       "normal"};
    const size_t count[] = {o->mesh->vertices, o->mesh->uvs, o->mesh->normals};
    char text[SCAN_WORD], *part = text;
    snprintf(text, sizeof text, "%s", o->scan.word);
    for (int kind = 0; kind < KINDS; kind++) {
        corner->index[kind] = MESH_NONE;
        if (!part)
            continue;
        char *end = strchr(part, '/');
        if (end)
            *end = '\0';
        if ((*part || kind == VERTEX) &&
            !read_index(o, part, what[kind], count[kind], &corner->index[kind]))
            return false;
        part = end ? end + 1 : NULL;
    }
    return true;
}

static bool add_triangle(struct obj *o, const struct corner corner[3])
{
    uint32_t index[KINDS][3];
    bool whole[KINDS] = {true, true, true};
    for (int kind = 0; kind < KINDS; kind++)
        for (int c = 0; c < 3; c++) {
            index[kind][c] = corner[c].index[kind];
            whole[kind] = whole[kind] && index[kind][c] != MESH_NONE;
        }
    return mesh_add_triangle(o->mesh, index[VERTEX],
                             whole[NORMAL] ? index[NORMAL] : NULL,
                             whole[UV] ? index[UV] : NULL, o->err);
}

static bool read_face(struct obj *o)
{
    struct corner t[3];
    int corners = 0;
    for (; next_word(o); corners++) {
        if (!read_corner(o, &t[corners < 2 ? corners : 2]))
            return false;
        if (corners < 2)
            continue;
        if (!add_triangle(o, t))
            return false;
        t[1] = t[2];
    }
    return corners >= 3 ||
           scan_fail(&o->scan, "a face of %d corners; it has 3 at least",
                     corners);
}

static bool read_line(struct obj *o)
{
    if (!scan_word(&o->scan))
        return true;
    const char *word = o->scan.word;
    if (strcmp(word, "v") == 0)
        return read_vertex(o);
    if (strcmp(word, "vt") == 0)
        return read_uv(o);
    if (strcmp(word, "vn") == 0)
        return read_normal(o);
    return strcmp(word, "f") != 0 || read_face(o);
}

static bool load(struct obj *o, const char *path)
{
    o->mesh = mesh_new(o->err);
    if (!o->mesh || !scan_open(&o->scan, path, o->err))
        return false;
    while (scan_line(&o->scan))
        if (!read_line(o))
            return false;
    if (o->mesh->triangles == 0)
        return brume_fail_file(o->err, path, "has no faces");
    mesh_mend(o->mesh);
    return true;
}

struct mesh *obj_load(const char *path, struct brume_error *err)
{
    struct obj o = {.err = err};
    bool ok = load(&o, path);
    scan_close(&o.scan);
    if (ok)
        return o.mesh;
    mesh_free(o.mesh);
    return NULL;
}
