/* flat.h - the host's copy of the flat scene: grows the arrays that
 * physics/scene.h lists, and owns them. */
#ifndef CORE_FLAT_H
#define CORE_FLAT_H
#include "core/matrix.h"
#include "core/physics/scene.h"
#include "core/scene.h"

struct flat {
    flat_scene view;        /* its pointers and counts follow the arrays   */
#define X(type, name) type *name; size_t name##_count, name##_capacity;
    SCENE_ARRAYS(X)
#undef X
    /* Of procedures, cell by cell: the largest of their values. */
    float *bounds;
    size_t bounds_count, bounds_capacity;
    /* How far what is in the field moves in a frame (drift.h); or NULL. */
    float *drift;
    /* What the first of two halves of the photons gave the field's blocks (see
     * half.h), and that half's part of all photons; or NULL. */
    float *half;
    double half_part;
    /* A tree that is left to the backend (order.h); or NULL. */
    struct tree_order *order;
    /* What a backend found out before it was opened (backend.h); or NULL. */
    void *looked;
    void (*forget)(void *looked);
    /* How unit space lies: p_unit = (p - centre) unit. */
    double unit, centre[3];
    matrix to_unit, from_unit;
};

/* Room for `more` items at the end of an array, zeroed and counted in. NULL
 * with err set when out of memory. */
#define FLAT_EXTEND(flat, name, more, err)                                    \
    flat_extend((void **)&(flat)->name, &(flat)->name##_capacity,             \
                &(flat)->name##_count, more, sizeof *(flat)->name, err)

void *flat_extend(void **array, size_t *capacity, size_t *count, size_t more,
                  size_t size, struct brume_error *err);

/* Points the view at the arrays; after every extension before use. */
void flat_view(struct flat *flat);

uint64_t flat_bytes(const struct flat *flat);

struct flat *flat_new(struct brume_error *err);
void flat_free(struct flat *flat);
#endif
