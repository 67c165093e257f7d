/* json.h - making JSON texts, and reading them, through jansson.
 *
 * Everything made is put into an object or an array, which then owns it; a
 * value that is NULL (no memory) makes the call return false. Bytes that are
 * not UTF-8 become '?', and numbers that are not finite become null. */
#ifndef LIB_JSON_H
#define LIB_JSON_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "lib/error.h"

struct json;                /* an object or an array                       */

struct json *json_new_object(void);
struct json *json_new_array(void);
void json_free(struct json *json);

/* Into an object under a key, or into an array, then with key NULL. */
bool json_put(struct json *into, const char *key, struct json *value);
bool json_put_text(struct json *into, const char *key, const char *text);
bool json_put_number(struct json *into, const char *key, double number);
bool json_put_count(struct json *into, const char *key, uint64_t count);
bool json_put_flag(struct json *into, const char *key, bool flag);

/* The text, indented, in the order of putting, with a line end; the caller
 * frees it. NULL with err set (BRUME_ERR_MEMORY). */
char *json_text(const struct json *json, struct brume_error *err);
/* The same on one line. */
char *json_line(const struct json *json, struct brume_error *err);

/* An object or array from a text; NULL: it is none. */
struct json *json_read(const char *text, size_t length);
/* What an object has under a key, which it goes on to own; NULL or `otherwise`
 * where it has none of that kind. */
struct json *json_get(const struct json *from, const char *key);
const char *json_get_text(const struct json *from, const char *key);
uint64_t json_get_count(const struct json *from, const char *key,
                        uint64_t otherwise);
bool json_get_flag(const struct json *from, const char *key, bool otherwise);
/* The members of an object in their order, from *at = NULL on until it gives
 * false; `text` is NULL for one that is no text. */
bool json_next(struct json *from, void **at, const char **key,
               const char **text);
/* The text in a place of an array; NULL: none. */
const char *json_item_text(const struct json *from, size_t i);

#endif
