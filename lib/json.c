#include "lib/json.h"
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A struct json * is a json_t * under a name that needs no jansson.h. */
static json_t *inside(struct json *json)
{
    return (json_t *)json;
}

struct json *json_new_object(void)
{
    return (struct json *)json_object();
}

struct json *json_new_array(void)
{
    return (struct json *)json_array();
}

void json_free(struct json *json)
{
    json_decref(inside(json));
}

bool json_put(struct json *into, const char *key, struct json *value)
{
    json_t *target = inside(into), *item = inside(value);
    if (key)
        return json_object_set_new(target, key, item) == 0;
    return json_array_append_new(target, item) == 0;
}

static json_t *text_in_ascii(const char *text)
{
    char *copy = strdup(text);
    for (char *c = copy; copy && *c; c++)
        if ((unsigned char)*c >= 0x80)
            *c = '?';
    json_t *made = copy ? json_string(copy) : NULL;
    free(copy);
    return made;
}

bool json_put_text(struct json *into, const char *key, const char *text)
{
    json_t *made = json_string(text);
    if (!made)
        made = text_in_ascii(text);
    return json_put(into, key, (struct json *)made);
}

bool json_put_number(struct json *into, const char *key, double number)
{
    json_t *made = isfinite(number) ? json_real(number) : json_null();
    return json_put(into, key, (struct json *)made);
}

/* JSON's integers end here at 2^63 - 1. */
bool json_put_count(struct json *into, const char *key, uint64_t count)
{
    json_t *made = count <= INT64_MAX ? json_integer((json_int_t)count)
                                      : json_real((double)count);
    return json_put(into, key, (struct json *)made);
}

bool json_put_flag(struct json *into, const char *key, bool flag)
{
    return json_put(into, key, (struct json *)json_boolean(flag));
}

static char *dump(const struct json *json, size_t layout,
                  struct brume_error *err)
{
    size_t flags = layout | JSON_PRESERVE_ORDER | JSON_REAL_PRECISION(9);
    char *text = json_dumps((const json_t *)json, flags);
    size_t length = text ? strlen(text) : 0;
    char *line = text ? realloc(text, length + 2) : NULL;
    if (!line) {
        free(text);
        brume_fail(err, BRUME_ERR_MEMORY, "no memory left to write JSON");
        return NULL;
    }
    memcpy(line + length, "\n", 2);
    return line;
}

char *json_text(const struct json *json, struct brume_error *err)
{
    return dump(json, JSON_INDENT(2), err);
}

char *json_line(const struct json *json, struct brume_error *err)
{
    return dump(json, JSON_COMPACT, err);
}

/* ---- reading ----------------------------------------------------------- */

struct json *json_read(const char *text, size_t length)
{
    return (struct json *)json_loadb(text, length, 0, NULL);
}

static json_t *get(const struct json *from, const char *key)
{
    return json_object_get((const json_t *)from, key);
}

struct json *json_get(const struct json *from, const char *key)
{
    json_t *found = get(from, key);
    bool holds = json_is_object(found) || json_is_array(found);
    return holds ? (struct json *)found : NULL;
}

const char *json_get_text(const struct json *from, const char *key)
{
    return json_string_value(get(from, key));
}

uint64_t json_get_count(const struct json *from, const char *key,
                        uint64_t otherwise)
{
    const json_t *found = get(from, key);
    bool fits = json_is_integer(found) && json_integer_value(found) >= 0;
    return fits ? (uint64_t)json_integer_value(found) : otherwise;
}

bool json_get_flag(const struct json *from, const char *key, bool otherwise)
{
    const json_t *found = get(from, key);
    return json_is_boolean(found) ? json_is_true(found) : otherwise;
}

bool json_next(struct json *from, void **at, const char **key,
               const char **text)
{
    *at = *at ? json_object_iter_next(inside(from), *at)
              : json_object_iter(inside(from));
    if (!*at)
        return false;
    *key = json_object_iter_key(*at);
    *text = json_string_value(json_object_iter_value(*at));
    return true;
}

const char *json_item_text(const struct json *from, size_t i)
{
    return json_string_value(json_array_get((const json_t *)from, i));
}
