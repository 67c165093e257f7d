#include "lib/arena.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#ifdef BRUME_FENCE
#include <sanitizer/asan_interface.h>
#endif

enum { ALIGNMENT = 16, CHUNK = 64 * 1024 };

/* Under the address sanitizer all that is not handed out is fenced off, and
 * there is a fence behind each block: running out of one shows. */
#ifdef BRUME_FENCE
enum { FENCE = ALIGNMENT };
static void fence(void *at, size_t size)
{
    ASAN_POISON_MEMORY_REGION(at, size);
}
static void hand_out(void *at, size_t size)
{
    ASAN_UNPOISON_MEMORY_REGION(at, size);
}
#else
enum { FENCE = 0 };
static void fence(void *at, size_t size)
{
    (void)at, (void)size;
}
static void hand_out(void *at, size_t size)
{
    (void)at, (void)size;
}
#endif

struct arena_chunk {
    struct arena_chunk *next;
    size_t size;
};

/* The head is padded so that what follows it is aligned. */
#define HEAD                                                                   \
    ((sizeof(struct arena_chunk) + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT)

void arena_init(struct arena *arena, size_t limit)
{
    *arena = (struct arena){.limit = limit};
}

void arena_release(struct arena *arena)
{
    struct arena_chunk *chunk = arena->chunk;
    while (chunk) {
        struct arena_chunk *next = chunk->next;
        free(chunk);
        chunk = next;
    }
    arena_init(arena, arena->limit);
}

/* Takes a chunk with room for `size` bytes; near the limit it is just that
 * large. calloc leaves fresh pages of the system untouched. */
static struct arena_chunk *take_chunk(struct arena *arena, size_t size)
{
    size_t bytes = HEAD + (size > CHUNK - HEAD ? size : CHUNK - HEAD);
    size_t left = arena->limit ? arena->limit - arena->held : SIZE_MAX;
    if (bytes > left) {
        bytes = HEAD + size;
    }
    if (bytes > left) {
        arena->limited = true;
        return NULL;
    }
    struct arena_chunk *chunk = calloc(1, bytes);
    if (chunk) {
        chunk->size = bytes;
        arena->held += bytes;
        fence((char *)chunk + HEAD, bytes - HEAD);
    }
    return chunk;
}

void *arena_alloc(struct arena *arena, size_t size)
{
    if (size > SIZE_MAX / 2) {
        return NULL;
    }
    size_t used = size;
    size = ((size ? size : 1) + FENCE + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    if (size > (size_t)(arena->end - arena->at)) {
        struct arena_chunk *chunk = take_chunk(arena, size);
        if (!chunk) {
            return NULL;
        }
        /* A block of its own goes behind the chunk in use. */
        if (size > CHUNK / 4 && arena->chunk) {
            chunk->next = arena->chunk->next;
            arena->chunk->next = chunk;
            hand_out((char *)chunk + HEAD, used);
            return (char *)chunk + HEAD;
        }
        chunk->next = arena->chunk;
        arena->chunk = chunk;
        arena->at = (char *)chunk + HEAD;
        arena->end = (char *)chunk + chunk->size;
    }
    void *block = arena->at;
    arena->at += size;
    hand_out(block, used);
    return block;
}

void *arena_array(struct arena *arena, size_t count, size_t size)
{
    if (size && count > SIZE_MAX / size) {
        return NULL;
    }
    return arena_alloc(arena, count * size);
}

char *arena_copy(struct arena *arena, const char *text, size_t length)
{
    char *copy = length < SIZE_MAX ? arena_alloc(arena, length + 1) : NULL;
    if (copy && length) {
        memcpy(copy, text, length);
    }
    return copy;
}

bool arena_grow(struct arena *arena, void **items, size_t *room, size_t need,
                size_t size)
{
    if (need <= *room) {
        return true;
    }
    size_t grown = *room > SIZE_MAX / 2 ? need : *room * 2;
    if (grown < need) {
        grown = need;
    }
    if (grown < 16) {
        grown = 16;
    }
    void *block = arena_array(arena, grown, size);
    if (!block) {
        return false;
    }
    if (*room) {
        memcpy(block, *items, *room * size);
    }
    *items = block;
    *room = grown;
    return true;
}
