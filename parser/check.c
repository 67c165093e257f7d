#include "parser/check.h"

#include <string.h>

#include "core/brume.h"
#include "lib/json.h"

static bool put_place(struct json *json, const struct diag_item *item)
{
    return !item->file ||
           (json_put_text(json, "file", item->file) &&
            json_put_count(json, "line", (uint64_t)item->line) &&
            json_put_count(json, "column", (uint64_t)item->column));
}

static bool put_text(struct json *json, const char *key, const char *text)
{
    return !text || json_put_text(json, key, text);
}

/* One text a line of the trace. */
static bool put_trace(struct json *json, const char *trace)
{
    struct json *list = trace ? json_new_array() : NULL;
    char line[512];

    if (!trace)
        return true;
    for (size_t length; *trace; trace += length) {
        length = strcspn(trace, "\n");
        size_t kept = length < sizeof line ? length : sizeof line - 1;
        memcpy(line, trace, kept);
        line[kept] = 0;
        if (!json_put_text(list, NULL, line)) {
            json_free(list);
            return false;
        }
        length += trace[length] == '\n';
    }
    return json_put(json, "trace", list);
}

static struct json *item_json(const struct diag_item *item)
{
    static const char *const severity[] = {[DIAG_NOTE] = "note",
                                           [DIAG_WARNING] = "warning",
                                           [DIAG_ERROR] = "error"};
    struct json *json = json_new_object();

    if (json_put_text(json, "severity", severity[item->severity]) &&
        (item->severity != DIAG_ERROR ||
         json_put_count(json, "code", (uint64_t)item->code)) &&
        put_place(json, item) && json_put_text(json, "message", item->text) &&
        put_text(json, "excerpt", item->excerpt) &&
        put_trace(json, item->trace) && put_text(json, "hint", item->hint))
        return json;
    json_free(json);
    return NULL;
}

void check_add(struct check *check, const struct diag *diag)
{
    const struct diag_item *item = diag->first;

    if (!check->list)
        check->list = json_new_array();
    for (; item; item = item->next)
        check->lost |= !json_put(check->list, NULL, item_json(item));
    check->errors += (uint64_t)diag->errors;
    check->warnings += (uint64_t)diag->warnings;
}

char *check_text(struct check *check, struct brume_error *err)
{
    struct json *json = json_new_object();
    struct json *list = check->list ? check->list : json_new_array();
    bool ok = !check->lost && json_put_text(json, "brume", BRUME_VERSION) &&
              json_put_count(json, "errors", check->errors) &&
              json_put_count(json, "warnings", check->warnings);

    ok = json_put(json, "diagnostics", list) && ok;
    char *text = ok ? json_text(json, err) : NULL;
    if (!ok)
        brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    json_free(json);
    *check = (struct check){.list = NULL};
    return text;
}
