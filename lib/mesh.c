#include "lib/mesh.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "lib/memory.h"

struct mesh *mesh_new(struct brume_error *err)
{
    return memory_new(1, sizeof(struct mesh), err);
}

void mesh_free(struct mesh *m)
{
    if (!m || __atomic_fetch_sub(&m->shares, 1, __ATOMIC_ACQ_REL) > 0)
        return;
    free(m->position);
    free(m->normal);
    free(m->uv);
    free(m->corner);
    free(m->corner_normal);
    free(m->corner_uv);
    free(m);
}

struct mesh *mesh_share(struct mesh *m)
{
    __atomic_fetch_add(&m->shares, 1, __ATOMIC_RELAXED);
    return m;
}

/* Room for one item more: the array, perhaps moved; NULL with err set. The
 * last index is MESH_NONE, so it names nothing. */
static void *one_more(void *array, size_t *capacity, size_t count, size_t size,
                      struct brume_error *err)
{
    if (count >= MESH_NONE) {
        brume_fail(err, BRUME_ERR_LIMIT,
                   "a mesh has more than %u vertices "
                   "or triangles",
                   MESH_NONE);
        return NULL;
    }
    return memory_grow(array, capacity, count + 1, size, err);
}

bool mesh_add_vertex(struct mesh *m, const double p[3], struct brume_error *err)
{
    void *array = one_more(m->position, &m->vertex_capacity, m->vertices,
                           sizeof *m->position, err);
    if (!array)
        return false;
    m->position = array;
    memcpy(m->position[m->vertices++], p, sizeof *m->position);
    return true;
}

bool mesh_add_normal(struct mesh *m, const float n[3], struct brume_error *err)
{
    void *array = one_more(m->normal, &m->normal_capacity, m->normals,
                           sizeof *m->normal, err);
    if (!array)
        return false;
    m->normal = array;
    memcpy(m->normal[m->normals++], n, sizeof *m->normal);
    return true;
}

bool mesh_add_uv(struct mesh *m, const float uv[2], struct brume_error *err)
{
    void *array = one_more(m->uv, &m->uv_capacity, m->uvs, sizeof *m->uv, err);
    if (!array)
        return false;
    m->uv = array;
    memcpy(m->uv[m->uvs++], uv, sizeof *m->uv);
    return true;
}

typedef uint32_t (*corners)[3];

static const uint32_t no_corners[3] = {MESH_NONE, MESH_NONE, MESH_NONE};

/* One of the optional arrays beside `corner`, which has a capacity in common
 * with it: made, with MESH_NONE for the triangles so far, when it is needed
 * first. */
static bool fit_optional(corners *array, bool needed, size_t count,
                         size_t capacity, struct brume_error *err)
{
    bool first = !*array;
    if (first && !needed)
        return true;
    size_t old_capacity = 0;
    corners grown = memory_grow(*array, &old_capacity, capacity, sizeof *grown,
                                err);
    if (!grown)
        return false;
    *array = grown;
    for (size_t i = 0; first && i < count; i++)
        memcpy(grown[i], no_corners, sizeof no_corners);
    return true;
}

static bool fit_triangle(struct mesh *m, bool normal, bool uv,
                         struct brume_error *err)
{
    size_t n = m->triangles, capacity = m->triangle_capacity;
    corners array = one_more(m->corner, &capacity, n, sizeof *array, err);
    if (!array)
        return false;
    m->corner = array;
    bool same = capacity == m->triangle_capacity;
    if (!(same && (m->corner_normal || !normal)) &&
        !fit_optional(&m->corner_normal, normal, n, capacity, err))
        return false;
    if (!(same && (m->corner_uv || !uv)) &&
        !fit_optional(&m->corner_uv, uv, n, capacity, err))
        return false;
    m->triangle_capacity = capacity;
    return true;
}

bool mesh_add_triangle(struct mesh *m, const uint32_t corner[3],
                       const uint32_t normal[3], const uint32_t uv[3],
                       struct brume_error *err)
{
    if (!fit_triangle(m, normal != NULL, uv != NULL, err))
        return false;
    size_t n = m->triangles++;
    memcpy(m->corner[n], corner, sizeof no_corners);
    if (m->corner_normal)
        memcpy(m->corner_normal[n], normal ? normal : no_corners,
               sizeof no_corners);
    if (m->corner_uv)
        memcpy(m->corner_uv[n], uv ? uv : no_corners, sizeof no_corners);
    return true;
}

static bool usable_normal(const struct mesh *m, uint32_t index)
{
    if (index >= m->normals)
        return false;
    const float *n = m->normal[index];
    double square = (double)n[0] * n[0] + (double)n[1] * n[1] +
                    (double)n[2] * n[2];
    return isfinite(square) && square > 0;
}

void mesh_mend(struct mesh *m)
{
    for (size_t t = 0; m->corner_normal && t < m->triangles; t++)
        for (int c = 0; c < 3; c++)
            if (!usable_normal(m, m->corner_normal[t][c])) {
                memcpy(m->corner_normal[t], no_corners, sizeof no_corners);
                break;
            }
    for (size_t i = 0; i < m->uvs; i++)
        for (int k = 0; k < 2; k++)
            if (!isfinite(m->uv[i][k]))
                m->uv[i][k] = 0;
}

static bool check_corner(size_t triangle, const char *what, uint32_t index,
                         size_t count, struct brume_error *err)
{
    return index < count ||
           brume_fail(err, BRUME_ERR_SCENE,
                      "triangle %zu of a mesh names %s %u; the mesh has %zu, "
                      "counted from 0",
                      triangle, what, index, count);
}

static bool check_triangle(const struct mesh *m, size_t t,
                           struct brume_error *err)
{
    for (int c = 0; c < 3; c++) {
        if (!check_corner(t, "vertex", m->corner[t][c], m->vertices, err))
            return false;
        if (m->corner_normal && m->corner_normal[t][0] != MESH_NONE &&
            !check_corner(t, "normal", m->corner_normal[t][c], m->normals, err))
            return false;
        if (m->corner_uv && m->corner_uv[t][0] != MESH_NONE &&
            !check_corner(t, "uv", m->corner_uv[t][c], m->uvs, err))
            return false;
    }
    return true;
}

bool mesh_check(const struct mesh *m, struct brume_error *err)
{
    for (size_t v = 0; v < m->vertices; v++)
        for (int i = 0; i < 3; i++)
            if (!isfinite(m->position[v][i]))
                return brume_fail(err, BRUME_ERR_SCENE,
                                  "vertex %zu of a mesh has a coordinate "
                                  "that is not finite",
                                  v);
    for (size_t t = 0; t < m->triangles; t++)
        if (!check_triangle(m, t, err))
            return false;
    return true;
}

/* A copy of `count` items; NULL stays NULL. *good turns false where there is
 * no memory. */
static void *copy_items(const void *from, size_t count, size_t size, bool *good,
                        struct brume_error *err)
{
    if (!from)
        return NULL;
    void *out = memory_new(count, size, err);
    if (!out)
        *good = false;
    else
        memcpy(out, from, count * size);
    return out;
}

struct mesh *mesh_copy(const struct mesh *m, struct brume_error *err)
{
    struct mesh *out = memory_new(1, sizeof *out, err);
    bool good = true;
    if (!out)
        return NULL;
    *out = *m;
    out->shares = 0;
#define COPY(array, count)                                                     \
    out->array = copy_items(m->array, m->count, sizeof *m->array, &good, err)
    COPY(position, vertices);
    COPY(normal, normals);
    COPY(uv, uvs);
    COPY(corner, triangles);
    COPY(corner_normal, triangles);
    COPY(corner_uv, triangles);
#undef COPY
    out->vertex_capacity = m->vertices;
    out->normal_capacity = m->normals;
    out->uv_capacity = m->uvs;
    out->triangle_capacity = m->triangles;
    if (good)
        return out;
    mesh_free(out);
    return NULL;
}
