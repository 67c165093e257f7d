/* intern.h - a table from bytes to the number they were given first, so that
 * equal things reach core once. Bytes are compared, not meanings: a struct
 * with unset padding may be taken for another, never the other way round. */
#ifndef PARSER_INTERN_H
#define PARSER_INTERN_H
#include <stddef.h>
#include <stdint.h>
#include "lib/arena.h"

struct intern_entry {
    struct intern_entry *next;
    uint64_t hash;
    size_t size;
    int id;
    const void *bytes;
};

struct intern {
    struct intern_entry **bucket;
    size_t buckets, entries;
};

/* The id that was kept for these bytes, or -1. */
int intern_find(const struct intern *table, const void *bytes, size_t size);
/* Keeps a copy in the arena. Without memory it is forgotten, no more. */
void intern_keep(struct intern *table, struct arena *arena, const void *bytes,
                 size_t size, int id);

#endif
