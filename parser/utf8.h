/* utf8.h - characters of strings, which are UTF-8. A byte that is not part of
 * a well-formed character counts as a character of its own. */
#ifndef PARSER_UTF8_H
#define PARSER_UTF8_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The character at `text`, of which `length` >= 1 bytes are there; *size tells
 * how many it takes. */
uint32_t utf8_decode(const char *text, size_t length, size_t *size);
/* Writes 1 to 4 bytes and tells how many; what is no character becomes
 * U+FFFD. */
size_t utf8_encode(uint32_t code, char *out);

bool utf8_valid(const char *text, size_t length);
/* Counts characters. */
size_t utf8_count(const char *text, size_t length);
/* Bytes of the first `count` characters, or of all if there are fewer. */
size_t utf8_cut(const char *text, size_t length, size_t count);

#endif
