/* memory.h - sizes multiplied through one checked helper, and arrays that
 * grow by doubling. Sizes are bytes unless they are called counts. */
#ifndef LIB_MEMORY_H
#define LIB_MEMORY_H
#include <stddef.h>
#include "lib/error.h"

/* False when a * b does not fit; *product is then untouched. */
bool memory_multiply(size_t a, size_t b, size_t *product);

/* `count` zeroed items of `size` bytes; NULL with err set when there is not
 * so much memory. Freed with free(). Never NULL for a count of 0. */
void *memory_new(size_t count, size_t size, struct brume_error *err);

/* Room for `count` items in an array that holds *capacity of them now, and
 * returns the array, perhaps moved. NULL with err set when there is not so
 * much memory: the old array is then as it was. */
void *memory_grow(void *array, size_t *capacity, size_t count, size_t size,
                  struct brume_error *err);

/* A copy of a string, freed with free(); NULL with err set. */
char *memory_string(const char *text, struct brume_error *err);
#endif
