#include "parser/intern.h"

#include <string.h>

/* FNV-1a (Fowler, Noll, Vo) with eight bytes for one, which sixty-four bits of
 * hash allow; the fold lets the low bits depend on the high ones. */
static uint64_t hash_of(const void *bytes, size_t size)
{
    const unsigned char *byte = bytes;
    uint64_t hash = UINT64_C(0xcbf29ce484222325);

    for (size_t i = 0; i < size; i += 8) {
        uint64_t word = 0;
        memcpy(&word, byte + i, size - i < 8 ? size - i : 8);
        hash = (hash ^ word) * UINT64_C(0x100000001b3);
        hash ^= hash >> 32;
    }
    return hash;
}

int intern_find(const struct intern *table, const void *bytes, size_t size)
{
    uint64_t hash = hash_of(bytes, size);

    if (!table->buckets)
        return -1;
    const struct intern_entry *entry =
        table->bucket[hash & (table->buckets - 1)];
    for (; entry; entry = entry->next)
        if (entry->hash == hash && entry->size == size &&
            !memcmp(entry->bytes, bytes, size))
            return entry->id;
    return -1;
}

static void widen(struct intern *table, struct arena *arena)
{
    size_t buckets = table->buckets ? 4 * table->buckets : 64;
    struct intern_entry **bucket = arena_array(arena, buckets, sizeof *bucket);

    if (!bucket)
        return;
    for (size_t i = 0; i < table->buckets; i++) {
        struct intern_entry *next, *entry = table->bucket[i];
        for (; entry; entry = next) {
            next = entry->next;
            entry->next = bucket[entry->hash & (buckets - 1)];
            bucket[entry->hash & (buckets - 1)] = entry;
        }
    }
    table->bucket = bucket;
    table->buckets = buckets;
}

void intern_keep(struct intern *table, struct arena *arena, const void *bytes,
                 size_t size, int id)
{
    if (table->entries >= table->buckets)
        widen(table, arena);
    struct intern_entry *entry = arena_alloc(arena, sizeof *entry);
    void *copy = arena_alloc(arena, size);
    if (!entry || !copy || !table->buckets)
        return;
    memcpy(copy, bytes, size);
    entry->hash = hash_of(bytes, size);
    entry->size = size;
    entry->id = id;
    entry->bytes = copy;
    entry->next = table->bucket[entry->hash & (table->buckets - 1)];
    table->bucket[entry->hash & (table->buckets - 1)] = entry;
    table->entries++;
}
