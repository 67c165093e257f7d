#include "core/flat.h"
#include "core/order.h"
#include <stdlib.h>
#include <string.h>
#include "lib/memory.h"

void *flat_extend(void **array, size_t *capacity, size_t *count, size_t more,
                  size_t size, struct brume_error *err)
{
    void *grown = memory_grow(*array, capacity, *count + more, size, err);
    if (!grown)
        return NULL;
    *array = grown;
    void *first = (char *)grown + *count * size;
    memset(first, 0, more * size);
    *count += more;
    return first;
}

void flat_view(struct flat *flat)
{
#define X(type, name)                                                          \
    flat->view.name = flat->name;                                              \
    flat->view.name##_count = flat->name##_count;
    SCENE_ARRAYS(X)
#undef X
}

uint64_t flat_bytes(const struct flat *flat)
{
    uint64_t bytes = sizeof *flat;
#define X(type, name) bytes += flat->name##_capacity * sizeof(type);
    SCENE_ARRAYS(X)
#undef X
    return bytes;
}

struct flat *flat_new(struct brume_error *err)
{
    struct flat *flat = memory_new(1, sizeof *flat, err);
    if (flat)
        flat->view.bvh_root = -1;
    return flat;
}

void flat_free(struct flat *flat)
{
    if (!flat)
        return;
#define X(type, name) free(flat->name);
    SCENE_ARRAYS(X)
#undef X
    free(flat->bounds);
    free(flat->drift);
    free(flat->half);
    order_free(flat->order);
    if (flat->looked)
        flat->forget(flat->looked);
    free(flat);
}
