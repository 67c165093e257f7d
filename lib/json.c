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

char *json_text(const struct json *json, struct brume_error *err)
{
    size_t flags = JSON_INDENT(2) | JSON_PRESERVE_ORDER |
                   JSON_REAL_PRECISION(9);
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
