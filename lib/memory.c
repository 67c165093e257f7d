#include "lib/memory.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_CAPACITY = 16 };

bool memory_multiply(size_t a, size_t b, size_t *product)
{
    if (b != 0 && a > SIZE_MAX / b)
        return false;
    *product = a * b;
    return true;
}

static void *fail(size_t count, size_t size, struct brume_error *err)
{
    brume_fail(err, BRUME_ERR_MEMORY, "no memory for %zu items of %zu bytes",
               count, size);
    return NULL;
}

void *memory_new(size_t count, size_t size, struct brume_error *err)
{
    void *p = calloc(count > 0 ? count : 1, size);
    return p ? p : fail(count, size, err);
}

void *memory_grow(void *array, size_t *capacity, size_t count, size_t size,
                  struct brume_error *err)
{
    if (array && count <= *capacity)
        return array;
    size_t wanted = *capacity > FIRST_CAPACITY / 2 ? *capacity
                                                   : FIRST_CAPACITY / 2;
    wanted = wanted <= SIZE_MAX / 2 ? wanted * 2 : count;
    if (wanted < count)
        wanted = count;
    size_t bytes;
    if (!memory_multiply(wanted, size, &bytes))
        return fail(wanted, size, err);
    void *p = realloc(array, bytes);
    if (!p)
        return fail(wanted, size, err);
    *capacity = wanted;
    return p;
}

char *memory_string(const char *text, struct brume_error *err)
{
    size_t bytes = strlen(text) + 1;
    char *copy = memory_new(bytes, 1, err);
    return copy ? memcpy(copy, text, bytes) : NULL;
}
