/* arena.h - memory with one lifetime: allocations are carved from chunks and
 * are released all at once.
 *
 * Running out of memory or over the limit gives NULL; an arena never prints
 * or exits. Memory is zeroed and aligned for any type. */
#ifndef LIB_ARENA_H
#define LIB_ARENA_H
#include <stdbool.h>
#include <stddef.h>

struct arena {
    struct arena_chunk *chunk;      /* newest first                        */
    char *at, *end;                 /* free space of the newest chunk      */
    size_t held;                    /* bytes taken from the system         */
    size_t limit;                   /* bound of `held`, 0: none            */
    bool limited;                   /* the limit refused an allocation     */
};

void arena_init(struct arena *arena, size_t limit);
void arena_release(struct arena *arena);

void *arena_alloc(struct arena *arena, size_t size);
/* `count` elements of `size`; NULL too when the product overflows. */
void *arena_array(struct arena *arena, size_t count, size_t size);
/* A copy of `length` bytes with a NUL behind them. */
char *arena_copy(struct arena *arena, const char *text, size_t length);

/* Makes `*items` (of `size` bytes each, `*room` of them) hold `need` or more;
 * the old block is left to the arena. False: no memory, nothing changed. */
bool arena_grow(struct arena *arena, void **items, size_t *room, size_t need,
                size_t size);

#endif
