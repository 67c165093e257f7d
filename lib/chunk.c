#include "lib/chunk.h"
#include <stdlib.h>
#include <string.h>
#include "lib/hash.h"
#include "lib/memory.h"

enum { WORD = sizeof(uint32_t) };

/* A piece ends where the sum of the last 64 words, each shifted by its age, has
 * zeros in its upper bits: once in 2^13 words, or 32 KiB. */
#define ENDS (UINT64_C(0x1fff) << 51)

static size_t next_size(const unsigned char *at, size_t left)
{
    size_t most = left < CHUNK_MOST ? left : (size_t)CHUNK_MOST;
    uint64_t sum = 0;
    for (size_t i = CHUNK_LEAST; i + WORD <= most; i += WORD) {
        uint32_t word;
        memcpy(&word, at + i, WORD);
        sum = (sum << 1) + (word + UINT64_C(1)) * UINT64_C(0x9e3779b97f4a7c15);
        if ((sum & ENDS) == 0)
            return i + WORD;
    }
    return most;
}

struct chunk *chunk_list(const void *array, size_t size, size_t *count,
                         struct brume_error *err)
{
    const unsigned char *at = array;
    size_t room = 0;
    struct chunk *list = memory_grow(NULL, &room, 1, sizeof *list, err);
    *count = 0;
    for (size_t from = 0; list && from < size;) {
        struct chunk *grown = memory_grow(list, &room, *count + 1, sizeof *list,
                                          err);
        if (!grown) {
            free(list);
            return NULL;
        }
        list = grown;
        struct chunk *c = &list[(*count)++];
        c->from = from;
        c->size = next_size(at + from, size - from);
        c->hash = hash_bytes(HASH_START, at + from, c->size);
        from += c->size;
    }
    return list;
}
