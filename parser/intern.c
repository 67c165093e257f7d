#include "parser/intern.h"

#include <stdbool.h>
#include <string.h>

struct intern_entry {
    struct intern_key key; /* of the bytes below                          */
    int id;
    unsigned char bytes[];
};

/* FNV-1a (Fowler, Noll, Vo) with eight bytes for one, which sixty-four bits of
 * hash allow; the fold lets the low bits depend on the high ones. */
static uint64_t mix(uint64_t hash, const void *bytes, size_t size)
{
    uint64_t word = 0;

    memcpy(&word, bytes, size);
    hash = (hash ^ word) * UINT64_C(0x100000001b3);
    return hash ^ hash >> 32;
}

static uint64_t hash_of(const void *bytes, size_t size)
{
    const unsigned char *byte = bytes;
    uint64_t hash = UINT64_C(0xcbf29ce484222325);

    for (; size >= 8; size -= 8, byte += 8)
        hash = mix(hash, byte, 8);
    return size > 0 ? mix(hash, byte, size) : hash;
}

struct intern_key intern_key(const void *bytes, size_t size)
{
    return (struct intern_key){bytes, size, hash_of(bytes, size)};
}

static bool equal(const struct intern_entry *entry,
                  const struct intern_key *key)
{
    return entry->key.hash == key->hash && entry->key.size == key->size &&
           !memcmp(entry->key.bytes, key->bytes, key->size);
}

/* The slot of the bytes, or the free one where they belong. */
static struct intern_slot *seek(const struct intern *table,
                                const struct intern_key *key)
{
    size_t at = key->hash & (table->slots - 1);

    for (;; at = (at + 1) & (table->slots - 1)) {
        struct intern_slot *slot = &table->slot[at];
        if (!slot->number || (slot->hash == key->hash >> 32 &&
                              equal(table->entry[slot->number - 1], key)))
            return slot;
    }
}

static void set(struct intern *table, size_t number)
{
    const struct intern_key *key = &table->entry[number - 1]->key;

    *seek(table, key) = (struct intern_slot){
        .hash = (uint32_t)(key->hash >> 32), .number = (uint32_t)number};
}

int intern_find(const struct intern *table, const struct intern_key *key)
{
    const struct intern_slot *slot = table->slots ? seek(table, key) : NULL;

    return slot && slot->number ? table->entry[slot->number - 1]->id : -1;
}

/* Room for one more; at most half of the slots are in use. */
static bool widen(struct intern *table, struct arena *arena)
{
    void *entry = table->entry;
    bool fits = arena_grow(arena, &entry, &table->room, table->entries + 1,
                           sizeof *table->entry);

    table->entry = entry;
    if (!fits || 2 * (table->entries + 1) <= table->slots)
        return fits;
    size_t slots = table->slots ? 2 * table->slots : 64;
    struct intern_slot *slot = arena_array(arena, slots, sizeof *slot);
    if (!slot)
        return false;
    table->slot = slot;
    table->slots = slots;
    for (size_t i = 1; i <= table->entries; i++)
        set(table, i);
    return true;
}

void intern_keep(struct intern *table, struct arena *arena,
                 const struct intern_key *key, int id)
{
    struct intern_entry *entry = widen(table, arena)
                                     ? arena_alloc(arena,
                                                   sizeof *entry + key->size)
                                     : NULL;
    if (!entry)
        return;
    memcpy(entry->bytes, key->bytes, key->size);
    entry->key = (struct intern_key){entry->bytes, key->size, key->hash};
    entry->id = id;
    table->entry[table->entries++] = entry;
    set(table, table->entries);
}
