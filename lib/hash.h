/* hash.h - 64 bits that tell contents apart: FNV-1a (Fowler, Noll, Vo) over
 * words of eight bytes, with the upper bits folded in. Not for secrets. */
#ifndef LIB_HASH_H
#define LIB_HASH_H
#include <stddef.h>
#include <stdint.h>
#include "lib/error.h"

#define HASH_START UINT64_C(0xcbf29ce484222325)

/* Goes on from `hash`; the length counts too. */
uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size);
uint64_t hash_text(uint64_t hash, const char *text);

/* Of a regular file's bytes, read in pieces. */
bool hash_file(const char *path, uint64_t *hash, struct brume_error *err);
#endif
