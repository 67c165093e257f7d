#include "lib/ply.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "lib/memory.h"
#include "lib/scan.h"

enum { MAX_ELEMENTS = 32, MAX_PROPERTIES = 64 };

enum format { ASCII, LITTLE, BIG };

enum type {
    INT8,
    UINT8,
    INT16,
    UINT16,
    INT32,
    UINT32,
    FLOAT32,
    FLOAT64,
    NO_TYPE
};

/* What a property is to us: an index of a vertex's values, or a face's list. */
enum role {
    X,
    Y,
    Z,
    NX,
    NY,
    NZ,
    U,
    V,
    RADIUS,
    MASS,
    VALUE,
    VERTEX_VALUES,
    CORNERS,
    SKIPPED
};

struct property {
    enum type type, count_type; /* count_type: NO_TYPE if no list      */
    enum role role;
    bool wanted; /* it is the points' value, whatever else it is */
};

struct element {
    char name[32];
    double count; /* as the header says                  */
    int properties;
    struct property property[MAX_PROPERTIES];
};

struct ply {
    struct scan scan;
    enum format format;
    int elements;
    struct element element[MAX_ELEMENTS];
    const struct element *vertex, *face;
    bool has_normal, has_uv, has_value;
    struct mesh *mesh; /* one of these two is made                  */
    struct points *points;
    const char *value;  /* name of the property of role VALUE, or NULL */
    size_t capacity[4]; /* of the arrays of points                   */
    char held[512];     /* names of the vertices' further properties */
    struct brume_error *err;
};

/* ---- header ---- */

static enum type type_named(const char *name)
{
    static const char *const names[][2] = {
        {"char", "int8"},     {"uchar", "uint8"},    {"short", "int16"},
        {"ushort", "uint16"}, {"int", "int32"},      {"uint", "uint32"},
        {"float", "float32"}, {"double", "float64"},
    };
    for (int i = 0; i < NO_TYPE; i++)
        if (strcmp(name, names[i][0]) == 0 || strcmp(name, names[i][1]) == 0)
            return (enum type)i;
    return NO_TYPE;
}

static enum role role_named(const char *element, const char *name, bool list)
{
    static const struct {
        const char *name;
        enum role role;
    } values[] = {
        {"x", X},           {"y", Y},           {"z", Z},
        {"nx", NX},         {"ny", NY},         {"nz", NZ},
        {"u", U},           {"s", U},           {"texture_u", U},
        {"v", V},           {"t", V},           {"texture_v", V},
        {"radius", RADIUS}, {"pscale", RADIUS}, {"mass", MASS},
    };
    if (strcmp(element, "face") == 0 && list &&
        (strcmp(name, "vertex_indices") == 0 ||
         strcmp(name, "vertex_index") == 0))
        return CORNERS;
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        if (strcmp(element, "vertex") == 0 && !list &&
            strcmp(name, values[i].name) == 0)
            return values[i].role;
    return SKIPPED;
}

static bool read_type(struct ply *p, enum type *type)
{
    if (!scan_word(&p->scan))
        return scan_fail(&p->scan, "a property without a type");
    *type = type_named(p->scan.word);
    return *type != NO_TYPE ||
           scan_fail(&p->scan, "unknown type '%.40s'", p->scan.word);
}

static void note_name(struct ply *p, const char *name)
{
    size_t used = strlen(p->held);
    snprintf(p->held + used, sizeof p->held - used, "%s%.64s",
             used > 0 ? ", " : "", name);
}

/* "property TYPE NAME" or "property list TYPE TYPE NAME". */
static bool read_property(struct ply *p)
{
    struct scan *s = &p->scan;
    if (p->elements == 0)
        return scan_fail(s, "a property before the first element");
    struct element *e = &p->element[p->elements - 1];
    if (e->properties == MAX_PROPERTIES)
        return scan_fail(s, "element %s has over %d properties", e->name,
                         MAX_PROPERTIES);
    struct property *to = &e->property[e->properties++];
    to->count_type = NO_TYPE;
    if (!scan_word(s))
        return scan_fail(s, "a property without a type");
    bool list = strcmp(s->word, "list") == 0;
    to->type = type_named(s->word);
    if (list ? !read_type(p, &to->count_type) || !read_type(p, &to->type)
             : to->type == NO_TYPE)
        return scan_fail(s, "unknown type '%.40s'", s->word);
    if (list && to->count_type >= FLOAT32)
        return scan_fail(s, "the length of a list is not an integer");
    if (!scan_word(s))
        return scan_fail(s, "a property without a name");
    to->role = role_named(e->name, s->word, list);
    if (strcmp(e->name, "vertex") == 0 && !list) {
        to->wanted = p->value && strcmp(s->word, p->value) == 0;
        p->has_value |= to->wanted;
        if (to->role > Z)
            note_name(p, s->word);
    }
    if (to->role == CORNERS && to->type >= FLOAT32)
        return scan_fail(s, "vertex indices are not integers");
    return true;
}

/* "element NAME COUNT" */
static bool read_element(struct ply *p)
{
    struct scan *s = &p->scan;
    if (p->elements == MAX_ELEMENTS)
        return scan_fail(s, "over %d elements", MAX_ELEMENTS);
    struct element *e = &p->element[p->elements++];
    if (!scan_word(s))
        return scan_fail(s, "an element without a name");
    snprintf(e->name, sizeof e->name, "%.31s", s->word);
    if (!scan_word(s))
        return scan_fail(s, "element %s without its count", e->name);
    if (!scan_number(s, &e->count))
        return false;
    if (!(e->count >= 0 && e->count < 0x1p53 && floor(e->count) == e->count))
        return scan_fail(s, "element %s has the count %.40s", e->name, s->word);
    return true;
}

/* "format NAME 1.0" */
static bool read_format(struct ply *p)
{
    static const char *const names[] = {"ascii", "binary_little_endian",
                                        "binary_big_endian"};
    struct scan *s = &p->scan;
    if (scan_word(s))
        for (int i = ASCII; i <= BIG; i++)
            if (strcmp(s->word, names[i]) == 0) {
                p->format = (enum format)i;
                return true;
            }
    return scan_fail(s, "unknown format '%.40s'", s->word);
}

static const struct element *find_element(const struct ply *p, const char *name)
{
    for (int i = 0; i < p->elements; i++)
        if (strcmp(p->element[i].name, name) == 0)
            return &p->element[i];
    return NULL;
}

static bool has_role(const struct element *e, enum role role)
{
    for (int i = 0; i < e->properties; i++)
        if (e->property[i].role == role)
            return true;
    return false;
}

/* The properties of the vertices, where none of the wanted ones is there. */
static bool check_points(struct ply *p)
{
    if (!p->value || p->has_value)
        return true;
    return brume_fail_file(
        p->err, p->scan.path, "has no property '%s' of its points%s%s",
        p->value, p->held[0] ? "; beside x, y and z they have " : "", p->held);
}

static bool check_header(struct ply *p)
{
    p->vertex = find_element(p, "vertex");
    p->face = find_element(p, "face");
    if (!p->vertex || !has_role(p->vertex, X) || !has_role(p->vertex, Y) ||
        !has_role(p->vertex, Z))
        return scan_fail(&p->scan, "no vertices with x, y and z");
    if (p->points)
        return check_points(p);
    if (!p->face || !has_role(p->face, CORNERS))
        return scan_fail(&p->scan, "no faces with vertex_indices");
    if (p->vertex->count >= MESH_NONE)
        return scan_fail(&p->scan, "%.0f vertices; the limit is %u",
                         p->vertex->count, MESH_NONE - 1);
    p->has_normal = has_role(p->vertex, NX) && has_role(p->vertex, NY) &&
                    has_role(p->vertex, NZ);
    p->has_uv = has_role(p->vertex, U) && has_role(p->vertex, V);
    return true;
}

static bool read_header(struct ply *p)
{
    struct scan *s = &p->scan;
    bool formatted = false;
    if (!scan_line(s) || !scan_word(s) || strcmp(s->word, "ply") != 0)
        return brume_fail_file(p->err, s->path, "is not a PLY file");
    while (scan_line(s)) {
        if (!scan_word(s))
            continue;
        bool ok = true;
        if (strcmp(s->word, "end_header") == 0) {
            while (scan_word(s)) /* to the end of the line              */
                ;
            return formatted ? check_header(p)
                             : scan_fail(s, "no format was given");
        }
        if (strcmp(s->word, "format") == 0)
            ok = formatted = read_format(p);
        else if (strcmp(s->word, "element") == 0)
            ok = read_element(p);
        else if (strcmp(s->word, "property") == 0)
            ok = read_property(p);
        else if (strcmp(s->word, "comment") != 0 &&
                 strcmp(s->word, "obj_info") != 0)
            ok = scan_fail(s, "unknown word '%.40s' in the header", s->word);
        if (!ok)
            return false;
    }
    return scan_fail(s, "the file ends in its header");
}

/* ---- body ---- */

static double decode(uint64_t bits, enum type type)
{
    uint32_t low = (uint32_t)bits;
    float single;
    double full;
    switch (type) {
    case INT8:
        return (int8_t)bits;
    case UINT8:
        return (uint8_t)bits;
    case INT16:
        return (int16_t)bits;
    case UINT16:
        return (uint16_t)bits;
    case INT32:
        return (int32_t)bits;
    case UINT32:
        return low;
    case FLOAT32:
        memcpy(&single, &low, sizeof single);
        return single;
    default:
        memcpy(&full, &bits, sizeof full);
        return full;
    }
}

static bool read_binary(struct ply *p, enum type type, double *value)
{
    static const int sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    uint64_t bits = 0;
    for (int i = 0; i < sizes[type]; i++) {
        int c = getc_unlocked(p->scan.stream);
        if (c == EOF)
            return brume_fail_file(p->err, p->scan.path,
                                   "ends too early: its header promises %.0f "
                                   "vertices and %.0f faces",
                                   p->vertex->count,
                                   p->face ? p->face->count : 0);
        bits = p->format == BIG ? bits << 8 | (uint64_t)c
                                : bits | (uint64_t)c << 8 * i;
    }
    *value = decode(bits, type);
    return true;
}

static bool read_value(struct ply *p, enum type type, double *value)
{
    if (p->format != ASCII)
        return read_binary(p, type, value);
    if (!scan_any_word(&p->scan))
        return scan_fail(&p->scan,
                         "the file ends too early: its header "
                         "promises %.0f vertices and %.0f faces",
                         p->vertex->count, p->face ? p->face->count : 0);
    return scan_number(&p->scan, value);
}

/* An error in the present line or, in a binary file, in an item. */
static bool fail_item(struct ply *p, const char *what, double item,
                      const char *wrong, double value)
{
    if (p->format == ASCII)
        return scan_fail(&p->scan, "%s %.0f %s %.15g", what, item, wrong,
                         value);
    return brume_fail_file(p->err, p->scan.path, "%s %.0f %s %.15g", what, item,
                           wrong, value);
}

static bool read_corner(struct ply *p, double face, enum type type,
                        uint32_t *index)
{
    double value;
    if (!read_value(p, type, &value))
        return false;
    if (!(value >= 0 && value < p->vertex->count && floor(value) == value))
        return fail_item(p, "face", face, "names vertex", value);
    *index = (uint32_t)value;
    return true;
}

/* A fan around the first corner, made while the corners are read. */
static bool read_polygon(struct ply *p, double face, enum type type,
                         double corners)
{
    uint32_t t[3] = {0, 0, 0};
    for (double i = 0; i < corners; i++) {
        if (!read_corner(p, face, type, i == 0 ? &t[0] : &t[2]))
            return false;
        if (i >= 2 && !mesh_add_triangle(p->mesh, t, p->has_normal ? t : NULL,
                                         p->has_uv ? t : NULL, p->err))
            return false;
        t[1] = t[2];
    }
    return true;
}

static bool read_list(struct ply *p, double item, const struct property *list)
{
    double length, unused;
    if (!read_value(p, list->count_type, &length))
        return false;
    if (!(length >= 0 && length <= UINT32_MAX && floor(length) == length))
        return fail_item(p, "item", item, "has a list of length", length);
    if (list->role == CORNERS)
        return read_polygon(p, item, list->type, length);
    for (double i = 0; i < length; i++)
        if (!read_value(p, list->type, &unused))
            return false;
    return true;
}

static bool add_vertex(struct ply *p, double item,
                       const double value[VERTEX_VALUES])
{
    for (int i = X; i <= Z; i++)
        if (!isfinite(value[i]))
            return fail_item(p, "vertex", item, "has the coordinate", value[i]);
    if (!mesh_add_vertex(p->mesh, value, p->err))
        return false;
    float normal[3] = {(float)value[NX], (float)value[NY], (float)value[NZ]};
    float uv[2] = {(float)value[U], (float)value[V]};
    return (!p->has_normal || mesh_add_normal(p->mesh, normal, p->err)) &&
           (!p->has_uv || mesh_add_uv(p->mesh, uv, p->err));
}

/* Numbers that a file has of its points, one more each. */
static bool add_number(struct ply *p, double **array, int which,
                       const double *from, size_t count)
{
    size_t used = p->points->count * count;
    double *grown = memory_grow(*array, &p->capacity[which], used + count,
                                sizeof *grown, p->err);
    if (!grown)
        return false;
    *array = grown;
    memcpy(grown + used, from, count * sizeof *grown);
    return true;
}

static bool add_point(struct ply *p, const double value[VERTEX_VALUES])
{
    struct points *to = p->points;
    double **array[] = {&to->radius, &to->mass, &to->value};
    if (!add_number(p, &to->at, 0, value, 3))
        return false;
    for (int i = 0; i < 3; i++)
        if ((i == 2 ? p->has_value
                    : has_role(p->vertex, (enum role)(RADIUS + i))) &&
            !add_number(p, array[i], i + 1, &value[RADIUS + i], 1))
            return false;
    to->count++;
    return true;
}

static bool read_item(struct ply *p, const struct element *e, double item)
{
    double value[VERTEX_VALUES] = {0}, unused;
    for (int i = 0; i < e->properties; i++) {
        const struct property *from = &e->property[i];
        bool ok = from->count_type != NO_TYPE
                      ? read_list(p, item, from)
                      : read_value(p, from->type,
                                   from->role < VERTEX_VALUES
                                       ? &value[from->role]
                                       : &unused);
        if (!ok)
            return false;
        if (from->wanted)
            value[VALUE] = from->role < VERTEX_VALUES ? value[from->role]
                                                      : unused;
    }
    if (e != p->vertex)
        return true;
    return p->points ? add_point(p, value) : add_vertex(p, item, value);
}

/* Nothing of ours stands behind the last of vertex and face. */
static bool read_body(struct ply *p)
{
    const struct element *last = !p->points && p->face > p->vertex ? p->face
                                                                   : p->vertex;
    for (const struct element *e = p->element; e <= last; e++)
        for (double i = 0; e->properties > 0 && i < e->count; i++)
            if (!read_item(p, e, i))
                return false;
    return true;
}

static bool read_file(struct ply *p, const char *path)
{
    bool ok = scan_open(&p->scan, path, p->err) && read_header(p) &&
              read_body(p);
    scan_close(&p->scan);
    return ok;
}

struct mesh *ply_load(const char *path, struct brume_error *err)
{
    struct mesh *mesh = NULL;
    struct ply *p = memory_new(1, sizeof *p, err);
    if (!p)
        return NULL;
    p->err = err;
    p->mesh = mesh_new(err);
    if (p->mesh && read_file(p, path)) {
        mesh_mend(p->mesh);
        mesh = p->mesh;
    } else
        mesh_free(p->mesh);
    free(p);
    return mesh;
}

void points_free(struct points *points)
{
    if (!points)
        return;
    free(points->at);
    free(points->radius);
    free(points->mass);
    free(points->value);
    free(points);
}

struct points *ply_load_points(const char *path, const char *value,
                               struct brume_error *err)
{
    struct points *points = NULL;
    struct ply *p = memory_new(1, sizeof *p, err);
    if (!p)
        return NULL;
    p->err = err;
    p->value = value;
    p->points = memory_new(1, sizeof *p->points, err);
    if (p->points && read_file(p, path))
        points = p->points;
    else
        points_free(p->points);
    free(p);
    return points;
}
