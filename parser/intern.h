/* intern.h - a table from bytes to the number they were given first, so that
 * equal things reach core once. Bytes are compared, not meanings: a struct
 * with unset padding may be taken for another, never the other way round. */
#ifndef PARSER_INTERN_H
#define PARSER_INTERN_H
#include <stddef.h>
#include <stdint.h>
#include "lib/arena.h"

struct intern_entry;

/* Open addressing (Knuth, TAOCP 3, 6.4). A search for what is not there meets
 * the slots alone, which are kept small for the processor's caches. */
struct intern_slot {
    uint32_t hash;          /* its upper half                              */
    uint32_t number;        /* of the entry, from 1; 0: free               */
};

struct intern {
    struct intern_slot *slot;
    size_t slots;
    struct intern_entry **entry;
    size_t entries, room;
};

struct intern_key {
    const void *bytes;
    size_t size;
    uint64_t hash;
};

struct intern_key intern_key(const void *bytes, size_t size);

/* The id that was kept for these bytes, or -1. */
int intern_find(const struct intern *table, const struct intern_key *key);
/* Keeps a copy of the bytes in the arena. Without memory it is forgotten, no
 * more. */
void intern_keep(struct intern *table, struct arena *arena,
                 const struct intern_key *key, int id);

#endif
