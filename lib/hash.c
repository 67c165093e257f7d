#include "lib/hash.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>

static uint64_t mix(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word) * UINT64_C(0x100000001b3);
    return hash ^ hash >> 32;
}

uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    uint64_t word;
    size_t left = size;
    for (; left >= sizeof word; left -= sizeof word, at += sizeof word) {
        memcpy(&word, at, sizeof word);
        hash = mix(hash, word);
    }
    word = 0;
    for (size_t i = 0; i < left; i++)
        word |= (uint64_t)at[i] << 8 * i;
    return mix(mix(hash, word), size);
}

uint64_t hash_text(uint64_t hash, const char *text)
{
    return hash_bytes(hash, text, strlen(text));
}

bool hash_file(const char *path, uint64_t *hash, struct brume_error *err)
{
    unsigned char piece[65536];
    size_t got;
    FILE *file = fopen(path, "rb");
    if (!file)
        return brume_fail_file(err, path, "can't be read: %s", strerror(errno));
    *hash = HASH_START;
    while ((got = fread(piece, 1, sizeof piece, file)) > 0)
        *hash = hash_bytes(*hash, piece, got);
    bool good = !ferror(file);
    fclose(file);
    return good ||
           brume_fail_file(err, path, "can't be read: %s", strerror(errno));
}
