#include "lib/chunk.h"
#include <stdlib.h>
#include <string.h>
#include "lib/hash.h"
#include "lib/memory.h"
#include "lib/thread.h"

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

/* The pieces of each span. */
struct span {
    struct chunk *list;
    size_t count, room;
    bool failed;
};

struct cut {
    const unsigned char *array;
    size_t size;
    struct span *span;
};

static struct chunk *add_piece(struct span *s)
{
    struct brume_error none = {0};
    struct chunk *grown = memory_grow(s->list, &s->room, s->count + 1,
                                      sizeof *grown, &none);
    s->failed = grown == NULL;
    s->list = grown ? grown : s->list;
    return grown ? &grown[s->count++] : NULL;
}

static void cut_span(void *context, size_t index, int thread)
{
    (void)thread;
    const struct cut *cut = context;
    struct span *s = &cut->span[index];
    size_t from = index * CHUNK_SPAN, left = cut->size - from;
    size_t end = from + (left < CHUNK_SPAN ? left : (size_t)CHUNK_SPAN);
    while (from < end) {
        const unsigned char *at = cut->array + from;
        struct chunk *c = add_piece(s);
        if (!c)
            return;
        c->from = from;
        c->size = next_size(at, end - from);
        c->hash = hash_bytes(HASH_START, at, c->size);
        from += c->size;
    }
}

static struct chunk *join(const struct cut *cut, size_t spans, size_t *count,
                          struct brume_error *err)
{
    bool good = true;
    *count = 0;
    for (size_t i = 0; i < spans; i++) {
        good = good && !cut->span[i].failed;
        *count += cut->span[i].count;
    }
    struct chunk *list = good ? memory_new(*count, sizeof *list, err) : NULL;
    struct chunk *to = list;
    if (!good)
        brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    for (size_t i = 0; list && i < spans; i++) {
        const struct span *s = &cut->span[i];
        if (s->count > 0)
            memcpy(to, s->list, s->count * sizeof *to);
        to += s->count;
    }
    return list;
}

struct chunk *chunk_list(const void *array, size_t size, int threads,
                         size_t *count, struct brume_error *err)
{
    size_t spans = (size + CHUNK_SPAN - 1) / CHUNK_SPAN;
    struct cut cut = {array, size, memory_new(spans, sizeof *cut.span, err)};
    if (!cut.span)
        return NULL;
    parallel_for(threads, spans, cut_span, &cut, NULL);
    struct chunk *list = join(&cut, spans, count, err);
    for (size_t i = 0; i < spans; i++)
        free(cut.span[i].list);
    free(cut.span);
    return list;
}
