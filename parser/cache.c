#include "parser/cache.h"
#include "lib/memory.h"
#include "lib/stamp.h"
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

struct entry {
    struct entry *next;
    char *path, *key;
    struct stat was;
    void *item;
    cache_release *release;
    bool used; /* by the scene that is read              */
};

struct parse_cache {
    struct entry *entry;
    struct kept kept;
};

struct parse_cache *parse_cache_new(struct brume_error *err)
{
    struct parse_cache *cache = memory_new(1, sizeof *cache, err);
    if (!cache)
        return NULL;
    arena_init(&cache->kept.arena, 0);
    cache->kept.names.arena = &cache->kept.arena;
    return cache;
}

struct kept *cache_kept(struct parse_cache *cache)
{
    return cache ? &cache->kept : NULL;
}

static void free_entry(struct entry *e)
{
    if (e->item)
        e->release(e->item);
    free(e->path);
    free(e->key);
    free(e);
}

/* Drops those that `used` does not keep. */
static void drop(struct parse_cache *cache, bool all)
{
    struct entry **at = &cache->entry;
    while (*at) {
        struct entry *e = *at;
        if (e->used && !all) {
            at = &e->next;
            continue;
        }
        *at = e->next;
        free_entry(e);
    }
}

void parse_cache_free(struct parse_cache *cache)
{
    if (!cache)
        return;
    drop(cache, true);
    kept_release(&cache->kept);
    free(cache);
}

void cache_begin(struct parse_cache *cache)
{
    if (!cache)
        return;
    for (struct entry *e = cache->entry; e; e = e->next)
        e->used = false;
    kept_begin(&cache->kept);
}

void cache_end(struct parse_cache *cache)
{
    if (!cache)
        return;
    drop(cache, false);
    kept_end(&cache->kept);
}

void *cache_find(struct parse_cache *cache, const char *path, const char *key)
{
    struct stat now;
    if (!cache || stat(path, &now) != 0)
        return NULL;
    for (struct entry *e = cache->entry; e; e = e->next)
        if (strcmp(e->path, path) == 0 && strcmp(e->key, key) == 0 &&
            stamp_is_same(&e->was, &now)) {
            e->used = true;
            return e->item;
        }
    return NULL;
}

bool cache_put(struct parse_cache *cache, const char *path, const char *key,
               void *item, cache_release *release)
{
    struct stat now;
    struct entry *e = NULL;
    if (cache && stat(path, &now) == 0 && S_ISREG(now.st_mode) &&
        stamp_is_settled(&now))
        e = memory_new(1, sizeof *e, NULL);
    if (!e)
        return false;
    *e = (struct entry){.next = cache->entry,
                        .path = strdup(path),
                        .key = strdup(key),
                        .was = now,
                        .release = release,
                        .used = true};
    if (!e->path || !e->key) {
        free_entry(e);
        return false;
    }
    e->item = item;
    cache->entry = e;
    return true;
}
