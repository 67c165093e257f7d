#include "parser/symbol.h"
#include "parser/diag.h"
#include <string.h>

/* ---- names ------------------------------------------------------------- */

/* FNV-1a, 32 bits. */
static uint32_t hash_word(const char *text, size_t length)
{
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < length; i++) {
        hash = (hash ^ (unsigned char)text[i]) * 16777619u;
    }
    return hash;
}

/* Twice as many buckets; without memory the old ones serve on. */
static void grow_buckets(struct name_table *table)
{
    size_t count = table->buckets * 2;
    struct name **bucket = arena_array(table->arena, count, sizeof *bucket);
    if (!bucket) {
        return;
    }
    for (size_t i = 0; i < table->buckets; i++) {
        struct name *name = table->bucket[i];
        while (name) {
            struct name *next = name->chain;
            struct name **slot = &bucket[name->hash & (count - 1)];
            name->chain = *slot;
            *slot = name;
            name = next;
        }
    }
    table->bucket = bucket;
    table->buckets = count;
}

static struct name *add_name(struct name_table *table, const char *text,
                             size_t length, uint32_t hash)
{
    struct name *name = arena_alloc(table->arena, sizeof *name + length + 1);
    if (!name) {
        return NULL;
    }
    if (table->names++ > table->buckets) {
        grow_buckets(table);
    }
    struct name **slot = &table->bucket[hash & (table->buckets - 1)];
    name->chain = *slot;
    name->hash = hash;
    name->length = (uint32_t)length;
    memcpy(name->text, text, length);
    *slot = name;
    return name;
}

static struct name *find_name(struct name_table *table, const char *text,
                              size_t length)
{
    uint32_t hash = hash_word(text, length);
    struct name *name = table->bucket[hash & (table->buckets - 1)];
    while (name && (name->hash != hash || name->length != length ||
                    memcmp(name->text, text, length) != 0)) {
        name = name->chain;
    }
    return name ? name : add_name(table, text, length, hash);
}

struct name *symbols_name(struct symbols *symbols, const char *text,
                          size_t length)
{
    return find_name(symbols->table, text, length);
}

static bool add_keywords(struct name_table *table)
{
    for (int i = 0; i < keyword_count; i++) {
        const struct keyword *row = &keyword_table[i];
        struct name *name = find_name(table, row->word, strlen(row->word));
        if (!name) {
            return false;
        }
        name->keyword = row;
    }
    return true;
}

static bool init_table(struct name_table *table)
{
    enum { BUCKETS = 2048 };
    table->buckets = BUCKETS;
    table->bucket = arena_array(table->arena, BUCKETS, sizeof *table->bucket);
    return table->bucket && add_keywords(table);
}

/* What the names of the last scene stood for is gone. */
static void clear_table(struct name_table *table)
{
    for (size_t i = 0; i < table->buckets; i++) {
        for (struct name *n = table->bucket[i]; n; n = n->chain) {
            n->symbol = NULL;
            n->reported = false;
        }
    }
}

bool symbols_init(struct symbols *symbols, struct arena *arena,
                  struct name_table *kept)
{
    *symbols = (struct symbols){.arena = arena, .own = {.arena = arena}};
    symbols->table = kept ? kept : &symbols->own;
    if (symbols->table->bucket) {
        clear_table(symbols->table);
    } else if (!init_table(symbols->table)) {
        symbols->table->bucket = NULL;
        return false;
    }
    return arena_grow(arena, &symbols->scope, &symbols->scope_room, 1,
                      sizeof(struct symbol *));
}

/* ---- scopes ------------------------------------------------------------ */

static struct symbol **newest(struct symbols *symbols)
{
    return (struct symbol **)symbols->scope + symbols->level;
}

bool symbols_enter(struct symbols *symbols)
{
    if (!arena_grow(symbols->arena, &symbols->scope, &symbols->scope_room,
                    symbols->level + 2, sizeof(struct symbol *))) {
        return false;
    }
    symbols->level++;
    *newest(symbols) = NULL;
    return true;
}

/* Declarations of a scope are on top of their names' stacks, save those that
 * #undef took away, which nothing may use again: a parameter may refer to
 * them. */
void symbols_leave(struct symbols *symbols)
{
    struct symbol *symbol = *newest(symbols);
    while (symbol) {
        struct symbol *next = symbol->next;
        if (!symbol->removed) {
            symbol->name->symbol = symbol->outer;
            symbol->next = symbols->spare;
            symbols->spare = symbol;
        }
        symbol = next;
    }
    symbols->level--;
}

/* ---- declarations ------------------------------------------------------ */

struct value *symbol_value(struct symbol *symbol)
{
    return symbol->refers ? symbol->refers : &symbol->value;
}

struct value *symbols_find(const struct name *name)
{
    struct value *value = name->symbol ? symbol_value(name->symbol) : NULL;
    return value && value->kind != VALUE_NONE ? value : NULL;
}

/* Below the declarations of inner scopes, which end before it. */
static struct symbol *add_symbol(struct symbols *symbols, struct name *name,
                                 struct symbol **place, uint32_t level)
{
    struct symbol **head = (struct symbol **)symbols->scope + level;
    struct symbol *symbol = symbols->spare;
    if (symbol) {
        symbols->spare = symbol->next;
    } else {
        symbol = arena_alloc(symbols->arena, sizeof *symbol);
    }
    if (symbol) {
        *symbol = (struct symbol){
            .name = name, .outer = *place, .next = *head, .level = level};
        *head = symbol;
        *place = symbol;
    }
    return symbol;
}

struct symbol *symbols_declare(struct symbols *symbols, struct name *name)
{
    return name->symbol ? name->symbol
                        : add_symbol(symbols, name, &name->symbol, 0);
}

struct symbol *symbols_local_at(struct symbols *symbols, struct name *name,
                                uint32_t level)
{
    struct symbol **place = &name->symbol;
    while (*place && (*place)->level > level) {
        place = &(*place)->outer;
    }
    return *place && (*place)->level == level
               ? *place
               : add_symbol(symbols, name, place, level);
}

struct symbol *symbols_local(struct symbols *symbols, struct name *name)
{
    return symbols_local_at(symbols, name, symbols->level);
}

void symbols_undefine(struct name *name)
{
    struct symbol *symbol = name->symbol;
    if (symbol) {
        symbol->removed = true;
        symbol->value.kind = VALUE_NONE;
        name->symbol = symbol->outer;
    }
}

/* ---- suggestions ------------------------------------------------------- */

const char *symbols_suggest(const struct symbols *symbols,
                            const struct name *name)
{
    size_t bound = name->length < 12 ? (name->length + 1) / 4 : 3;
    const struct name *best = NULL;
    for (size_t i = 0; i < symbols->table->buckets; i++) {
        for (struct name *n = symbols->table->bucket[i]; n; n = n->chain) {
            if (n == name || (!n->keyword && !symbols_find(n))) {
                continue;
            }
            size_t distance = diag_distance(name->text, name->length, n->text,
                                            n->length, bound);
            /* Ties go to the first in the alphabet, whatever the hashes. */
            if (distance <= bound && (!best || distance < bound ||
                                      strcmp(n->text, best->text) < 0)) {
                best = n;
                bound = distance;
            }
        }
    }
    return best ? best->text : NULL;
}
