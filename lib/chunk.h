/* chunk.h - an array in pieces whose ends its contents choose, so that a part
 * that is the same in two arrays is the same pieces in both, wherever it is
 * [Muthitacharoen, Chen, Mazieres 2001]. */
#ifndef LIB_CHUNK_H
#define LIB_CHUNK_H
#include <stddef.h>
#include <stdint.h>
#include "lib/error.h"

/* In bytes. No piece goes over a multiple of CHUNK_SPAN, so that threads can
 * cut an array side by side. */
enum { CHUNK_LEAST = 1 << 14, CHUNK_MOST = 1 << 18, CHUNK_SPAN = 1 << 21 };

struct chunk {
    size_t from, size;
    uint64_t hash;
};

/* In their order, freed with free(); NULL with err set when out of memory.
 * Parts are the same where they are moved by a multiple of four bytes. Of so
 * many threads, as parallel_for. */
struct chunk *chunk_list(const void *array, size_t size, int threads,
                         size_t *count, struct brume_error *err);
#endif
