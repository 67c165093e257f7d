/* cache.h - what was read from data files, kept from scene to scene. */
#ifndef PARSER_CACHE_H
#define PARSER_CACHE_H
#include "parser/kept.h"
#include "parser/parse.h"

typedef void cache_release(void *item);

/* A scene begins; at its end what it did not ask for goes. */
void cache_begin(struct parse_cache *cache);
void cache_end(struct parse_cache *cache);

/* What a file as it is now has under a key, the way it was read; NULL: not
 * there. The cache may be NULL, and is then empty. */
void *cache_find(struct parse_cache *cache, const char *path, const char *key);
/* Texts; NULL: no cache. */
struct kept *cache_kept(struct parse_cache *cache);

/* False: it is not kept, and stays the caller's. */
bool cache_put(struct parse_cache *cache, const char *path, const char *key,
               void *item, cache_release *release);
#endif
