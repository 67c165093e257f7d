#include "parser/option.h"
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* ---- defaults ---------------------------------------------------------- */

static void set_default(struct options *options, const struct option *o)
{
    void *member = (char *)options + o->at;
    if (o->at == OPTION_NOWHERE)
        return;
    if (o->set == set_flag || o->set == set_output_file)
        *(bool *)member = o->initial != 0;
    else if (o->set == set_integer)
        *(int *)member = (int)o->initial;
    else if (o->set == set_number)
        *(double *)member = o->initial;
}

void options_init(struct options *options)
{
    *options = (struct options){0};
    arena_init(&options->arena, (size_t)64 << 20);
    for (int i = 0; i < option_count; i++)
        set_default(options, &option_table[i]);
}

void options_release(struct options *options)
{
    arena_release(&options->arena);
}

/* ---- diagnostics ------------------------------------------------------- */

static int column_of(const struct option_reader *reader)
{
    int column = 1;
    for (const char *at = reader->line; at < reader->where; at++)
        column += (*at & 0xc0) != 0x80;
    return column;
}

static void report(const struct option_reader *reader,
                   enum diag_severity severity, enum brume_code code,
                   const char *hint, const char *text)
{
    struct diag_item item = {
        .severity = severity,
        .code = code,
        .text = text,
        .hint = hint,
    };
    if (reader->file && reader->number) {
        item.file = reader->file;
        item.line = reader->number;
        item.column = column_of(reader);
        item.excerpt = diag_excerpt(&reader->diag->arena, reader->line,
                                    reader->line_end, reader->where,
                                    reader->number);
    }
    diag_add(reader->diag, &item);
}

bool reader_fail(const struct option_reader *reader, enum brume_code code,
                 const char *hint, const char *format, ...)
{
    char text[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    report(reader, DIAG_ERROR, code, hint, text);
    return false;
}

static void report_setting(const struct setting *setting,
                           enum diag_severity severity, enum brume_code code,
                           const char *format, va_list args)
{
    char text[1024];
    int used = snprintf(text, sizeof text, "%s: ", setting->written);
    if (used >= 0 && (size_t)used < sizeof text)
        vsnprintf(text + used, sizeof text - (size_t)used, format, args);
    report(setting->reader, severity, code, NULL, text);
}

bool setting_error(const struct setting *setting, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    report_setting(setting, DIAG_ERROR, BRUME_ERR_USAGE, format, args);
    va_end(args);
    return false;
}

bool setting_warn(const struct setting *setting, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    report_setting(setting, DIAG_WARNING, BRUME_OK, format, args);
    va_end(args);
    return true;
}

/* ---- unknown options --------------------------------------------------- */

static size_t lower(const char *text, char *out, size_t size)
{
    size_t length = 0;
    for (; text[length] && length + 1 < size; length++) {
        char c = text[length];
        out[length] = c >= 'A' && c <= 'Z' ? (char)(c | 0x20) : c;
    }
    out[length] = '\0';
    return length;
}

struct suggestion {
    const char *dashes, *name;
    size_t distance;
};

static void consider(struct suggestion *best, const char *word,
                     const char *dashes, const char *name)
{
    char candidate[64];
    if (!name)
        return;
    size_t length = lower(name, candidate, sizeof candidate);
    size_t word_length = strlen(word);
    size_t bound = 2 * word_length / 5;
    size_t distance = diag_distance(word, word_length, candidate, length,
                                    bound);
    if (distance <= bound && distance < best->distance)
        *best = (struct suggestion){dashes, name, distance};
}

/* Written as "--threads", "+KFF" or "Width", like what `word` tried to be. */
static bool fail_unknown(const struct option_reader *reader, const char *word)
{
    char lowered[64], hint[128];
    const char *bare = word + strspn(word, "+-");
    lower(bare, lowered, sizeof lowered);
    lowered[strcspn(lowered, "=")] = '\0';
    struct suggestion best = {NULL, NULL, SIZE_MAX};
    for (int i = 0; i < option_count; i++)
        consider(&best, lowered, "--", option_table[i].name);
    for (int i = 0; i < option_count; i++)
        consider(&best, lowered, "", option_table[i].ini);
    for (int i = 0; bare != word && i < option_count; i++)
        consider(&best, lowered, "+", option_table[i].plus);
    snprintf(hint, sizeof hint, "did you mean '%s%s'?",
             best.name ? best.dashes : "", best.name ? best.name : "");
    return reader_fail(reader, BRUME_ERR_USAGE, best.name ? hint : NULL,
                       "unknown option '%s'", word);
}

/* ---- applying one option ----------------------------------------------- */

static bool apply(const struct option_reader *reader,
                  const struct option *option, const char *written, char sign,
                  const char *value)
{
    struct setting setting = {
        reader, reader->options, option, written, sign, value,
    };
    return option->set(&setting);
}

static bool needs_value(const struct option *option)
{
    return option->value && *option->value != '[';
}

/* The row whose switch begins the text; of several the longest. */
static const struct option *find_switch(const char *text)
{
    const struct option *best = NULL;
    size_t longest = 0;
    for (int i = 0; i < option_count; i++) {
        const char *plus = option_table[i].plus;
        size_t length = plus ? strlen(plus) : 0;
        if (length > longest && strncasecmp(text, plus, length) == 0) {
            best = &option_table[i];
            longest = length;
        }
    }
    return best;
}

/* By INI name, or by long name where that is not NULL. */
static const struct option *find_named(const char *ini, const char *name,
                                       size_t length)
{
    for (int i = 0; i < option_count; i++) {
        const char *has = ini ? option_table[i].ini : option_table[i].name;
        const char *is = ini ? ini : name;
        if (has && strlen(has) == length && strncasecmp(has, is, length) == 0)
            return &option_table[i];
    }
    return NULL;
}

static bool apply_switch(const struct option_reader *reader, const char *word)
{
    const struct option *o = find_switch(word + 1);
    size_t length = o ? strlen(o->plus) : 0;
    const char *value = word + 1 + length;
    /* -threads is meant as --threads, not as -TH with the value "reads". */
    bool one_dash = word[0] == '-' &&
                    find_named(NULL, word + 1, strcspn(word + 1, "="));
    if (!o || (*value && !o->value) || one_dash)
        return fail_unknown(reader, word);
    char written[8];
    snprintf(written, sizeof written, "%c%s", word[0], o->plus);
    if (!*value && needs_value(o))
        return reader_fail(reader, BRUME_ERR_USAGE, NULL,
                           "%s: a value is missing; it follows without a "
                           "blank: %s%s",
                           written, written, o->value);
    return apply(reader, o, written, word[0], *value ? value : NULL);
}

static bool apply_long(const struct option_reader *reader, const char *word,
                       const char *next, bool *both)
{
    size_t length = strcspn(word + 2, "=");
    const char *value = word[2 + length] ? word + 3 + length : NULL;
    const struct option *o = find_named(NULL, word + 2, length);
    if (!o)
        return fail_unknown(reader, word);
    if (!o->value && value)
        return reader_fail(reader, BRUME_ERR_USAGE, NULL,
                           "--%s: no value is expected, '%s' was given",
                           o->name, value);
    if (needs_value(o) && !value) {
        value = next;
        *both = next;
    }
    if (needs_value(o) && (!value || !*value))
        return reader_fail(reader, BRUME_ERR_USAGE, NULL,
                           "--%s: a value is missing", o->name);
    char written[32];
    snprintf(written, sizeof written, "--%s", o->name);
    return apply(reader, o, written, '=', value);
}

bool reader_setting(const struct option_reader *reader, const char *name,
                    size_t length, const char *value)
{
    const struct option *o = find_named(name, NULL, length);
    char text[128];
    snprintf(text, sizeof text, "%.*s", (int)length, name);
    if (!o)
        return fail_unknown(reader, text);
    if (!*value)
        return reader_fail(reader, BRUME_ERR_USAGE, NULL,
                           "%s: a value is missing", o->ini);
    return apply(reader, o, o->ini, '=', value);
}

/* Name=value as a word may have its value in quotes, as in an INI file. */
static bool apply_assignment(const struct option_reader *reader,
                             const char *word, size_t length)
{
    const char *value = word + length + 1;
    size_t left = strlen(value);
    bool quoted = left >= 2 && (*value == '"' || *value == '\'') &&
                  value[left - 1] == *value;
    if (!quoted)
        return reader_setting(reader, word, length, value);
    char *bare = arena_copy(&reader->options->arena, value + 1, left - 2);
    if (!bare)
        return reader_fail(reader, BRUME_ERR_MEMORY, NULL, "out of memory");
    return reader_setting(reader, word, length, bare);
}

bool reader_word(const struct option_reader *reader, const char *word,
                 const char *next, bool *both)
{
    static const char name[] = "abcdefghijklmnopqrstuvwxyz0123456789_"
                               "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
    size_t length = strspn(word, name);
    *both = false;
    if (strncmp(word, "--", 2) == 0 && word[2])
        return apply_long(reader, word, next, both);
    if ((word[0] == '+' || word[0] == '-') && word[1])
        return apply_switch(reader, word);
    if (length > 0 && word[length] == '=')
        return apply_assignment(reader, word, length);
    return reader_operand(reader, word);
}
