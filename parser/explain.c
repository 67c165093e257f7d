#include "parser/explain.h"
#include "lib/json.h"
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 79 };

const char *explain_bytes(uint64_t bytes, char *out, size_t size)
{
    static const char *const units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
    double value = (double)bytes;
    size_t unit = 0;
    while (value >= 999.5 && unit + 1 < sizeof units / sizeof *units) {
        value /= 1024;
        unit++;
    }
    snprintf(out, size, unit ? "%.3g %s" : "%.0f %s", value, units[unit]);
    return out;
}

/* Words from column `indent` on, broken before column WIDTH. */
static void wrap(const char *text, int indent, FILE *to)
{
    int column = indent;
    while (*text) {
        int length = (int)strcspn(text, " ");
        if (column > indent && column + 1 + length > WIDTH) {
            fprintf(to, "\n%*s", indent, "");
            column = indent;
        } else if (column > indent) {
            fputc(' ', to);
            column++;
        }
        fprintf(to, "%.*s", length, text);
        column += length;
        text += length;
        text += strspn(text, " ");
    }
    fputc('\n', to);
}

void explain_text(const struct brume_plan *plan, FILE *to)
{
    fprintf(to, "%-11s %-4s %9s  %s\n", "stage", "runs", "memory", "because");
    for (int i = 0; i < plan->stages; i++) {
        const struct brume_stage *s = &plan->stage[i];
        char bytes[32];
        int indent = fprintf(
            to, "%-11s %-4s %9s  ", s->name, s->runs ? "yes" : "no",
            s->runs ? explain_bytes(s->bytes, bytes, sizeof bytes) : "-");
        wrap(s->reason, indent, to);
    }
    for (int i = 0; i < plan->notes; i++) {
        fputs(i ? "" : "\n", to);
        wrap(plan->note[i], 0, to);
    }
}

static struct json *stage_json(const struct brume_stage *stage)
{
    struct json *json = json_new_object();
    if (json_put_text(json, "name", stage->name) &&
        json_put_flag(json, "runs", stage->runs) &&
        json_put_text(json, "reason", stage->reason) &&
        json_put_count(json, "bytes", stage->bytes))
        return json;
    json_free(json);
    return NULL;
}

static bool put_stages(struct json *json, const struct brume_plan *plan)
{
    bool ok = true;
    for (int i = 0; ok && i < plan->stages; i++)
        ok = json_put(json, NULL, stage_json(&plan->stage[i]));
    return ok;
}

static bool put_notes(struct json *json, const struct brume_plan *plan)
{
    bool ok = true;
    for (int i = 0; ok && i < plan->notes; i++)
        ok = json_put_text(json, NULL, plan->note[i]);
    return ok;
}

char *explain_json(const struct brume_plan *plan, struct brume_error *err)
{
    struct json *json = json_new_object();
    struct json *stages = json_new_array(), *notes = json_new_array();
    bool ok = json_put_text(json, "brume", BRUME_VERSION) &&
              put_stages(stages, plan) && put_notes(notes, plan);
    ok = json_put(json, "stages", stages) && ok;
    ok = json_put(json, "notes", notes) && ok;
    char *text = NULL;
    if (ok)
        text = json_text(json, err);
    else
        brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    json_free(json);
    return text;
}
