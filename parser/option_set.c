/* The handlers of the table: what an option's value may be, and where it
 * goes. Whether there has to be a value was checked before. */
#include "parser/option.h"
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool option_truth(const char *text, bool *truth)
{
    static const char *const on[] = {"on", "true", "yes", "1"};
    static const char *const off[] = {"off", "false", "no", "0"};
    for (size_t i = 0; i < sizeof on / sizeof *on; i++) {
        bool is_on = strcasecmp(text, on[i]) == 0;
        if (is_on || strcasecmp(text, off[i]) == 0) {
            *truth = is_on;
            return true;
        }
    }
    return false;
}

static bool out_of_memory(const struct setting *s)
{
    return reader_fail(s->reader, BRUME_ERR_MEMORY, NULL, "out of memory");
}

static void *member(struct setting *s)
{
    long at = s->option->at;
    return at == OPTION_NOWHERE ? NULL : (char *)s->options + at;
}

static bool is_switch(const struct setting *s)
{
    return s->sign == '+' || s->sign == '-';
}

/* Decimal and finite; nothing else may be in the text. */
static bool parse_number(const char *text, double *number)
{
    char *end;
    if (!*text || strspn(text, "+-.0123456789eE") != strlen(text))
        return false;
    *number = strtod(text, &end);
    return *end == '\0' && isfinite(*number);
}

static bool read_number(struct setting *s, double *number)
{
    const struct option *o = s->option;
    if (!parse_number(s->value, number))
        return setting_error(s, "'%s' is not a number", s->value);
    if (o->low == 0 && o->high == 0)
        return true;
    if (*number < o->low || *number > o->high)
        return setting_error(s, "%s is not in the range %.10g to %.10g",
                             s->value, o->low, o->high);
    return true;
}

static bool read_truth(struct setting *s, bool *truth)
{
    return option_truth(s->value, truth) ||
           setting_error(s, "'%s' is neither on nor off", s->value);
}

bool set_flag(struct setting *s)
{
    bool flag = s->sign == '+' || !s->value;
    if (!is_switch(s) && s->value && !read_truth(s, &flag))
        return false;
    flag = flag && s->sign != '-';
    bool *to = member(s);
    if (to)
        *to = flag;
    if (to == &s->options->verbose)
        s->options->has_verbose = true;
    return true;
}

bool set_flag_number(struct setting *s)
{
    double number;
    if (is_switch(s) && s->value && !read_number(s, &number))
        return false;
    return set_flag(s);
}

/* Fractions are cut off, as POV-Ray does: scripts write Height=149.4569. */
bool set_integer(struct setting *s)
{
    double number;
    if (!read_number(s, &number))
        return false;
    if (fabs(number) > (double)(1 << 30))
        return setting_error(s, "%s is out of bounds", s->value);
    int *to = member(s);
    if (to)
        *to = (int)number;
    return true;
}

bool set_number(struct setting *s)
{
    double number;
    if (!read_number(s, &number))
        return false;
    double *to = member(s);
    if (to)
        *to = number;
    return true;
}

bool set_unsigned(struct setting *s)
{
    bool digits = strspn(s->value, "0123456789") == strlen(s->value);
    errno = 0;
    unsigned long long number = strtoull(s->value, NULL, 10);
    if (!digits || errno || number > UINT64_MAX)
        return setting_error(s, "'%s' is not a whole number from 0 to 2^64 - 1",
                             s->value);
    *(uint64_t *)member(s) = number;
    return true;
}

/* Several are for measuring. */
bool set_photons(struct setting *s)
{
    struct options *o = s->options;
    const char *text = s->value;
    memset(o->more_photons, 0, sizeof o->more_photons);
    for (int i = 0; i < OPTIONS_MOST_PHOTONS; i++) {
        uint64_t *to = i == 0 ? &o->photons : &o->more_photons[i - 1];
        char *end;
        errno = 0;
        unsigned long long number = strtoull(text, &end, 10);
        if (*text < '0' || *text > '9' || errno || (i > 0 && number == 0))
            break;
        *to = number;
        if (*end == '\0')
            return true;
        text = end + 1;
        if (*end != ',')
            break;
    }
    return setting_error(s,
                         "'%s' is neither a whole number from 0 to 2^64 - 1, "
                         "nor up to %d of them with commas",
                         s->value, OPTIONS_MOST_PHOTONS);
}

bool set_bytes(struct setting *s)
{
    static const char units[] = "KMGT";
    char digits[32];
    size_t length = strlen(s->value);
    const char *unit = length ? strchr(units, s->value[length - 1] & ~0x20)
                              : NULL;
    double number, scale = 1;
    if (unit && *unit) {
        length--;
        scale = ldexp(1, 10 * (int)(unit - units + 1));
    }
    snprintf(digits, sizeof digits, "%.*s", (int)length, s->value);
    if (length >= sizeof digits || !parse_number(digits, &number) ||
        number * scale < 1 || number * scale > 0x1p62)
        return setting_error(s,
                             "'%s' is not a number of bytes, which K, M, "
                             "G or T may follow",
                             s->value);
    *(uint64_t *)member(s) = (uint64_t)(number * scale);
    return true;
}

/* A copy of the value; NULL: no memory, reported. */
static const char *copy_value(struct setting *s, const char *text)
{
    char *copy = arena_copy(&s->options->arena, text, strlen(text));
    if (!copy)
        out_of_memory(s);
    return copy;
}

bool set_text(struct setting *s)
{
    const char **to = member(s);
    return !to || (*to = copy_value(s, s->value));
}

/* A name in which %d or %04d, once, stands for the frame's number, and %% for
 * a per cent sign. */
bool set_numbered(struct setting *s)
{
    int numbers = 0;
    for (const char *at = s->value; (at = strchr(at, '%')); at++) {
        if (at[1] == '%') {
            at++;
            continue;
        }
        at += at[1] == '0' && at[2] >= '1' && at[2] <= '9' ? 3 : 1;
        if (*at != 'd' || ++numbers > 1)
            return setting_error(s,
                                 "'%s': '%%d' or '%%04d' may stand in it once, "
                                 "and '%%%%' for '%%'",
                                 s->value);
    }
    return set_text(s);
}

/* The same folder twice counts once, as in POV-Ray. */
bool set_folder(struct setting *s)
{
    struct options_list *list = member(s);
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->item[i], s->value) == 0)
            return true;
    void *items = list->item;
    if (!arena_grow(&s->options->arena, &items, &list->room, list->count + 1,
                    sizeof *list->item))
        return out_of_memory(s);
    list->item = items;
    const char *copy = copy_value(s, s->value);
    if (copy)
        list->item[list->count++] = copy;
    return copy;
}

static void list_words(const struct option_word *words, char *out, size_t size)
{
    size_t used = 0;
    *out = '\0';
    for (const struct option_word *w = words; w->word; w++)
        if (*w->word && !w->missing && used < size)
            used += (size_t)snprintf(out + used, size - used, "%s%s",
                                     used ? ", " : "", w->word);
}

/* The word of the option's list that the value is; NULL: reported. */
static const struct option_word *find_word(struct setting *s)
{
    char list[128];
    const char *value = s->value ? s->value : "";
    const struct option_word *w = s->option->words;
    while (w->word && strcasecmp(w->word, value) != 0)
        w++;
    if (w->word && !w->missing)
        return w;
    list_words(s->option->words, list, sizeof list);
    if (w->word)
        setting_error(s, "'%s' is not supported yet", value);
    else if (*list)
        setting_error(s, "'%s' is not one of %s", value, list);
    else
        setting_error(s, "no value is expected, '%s' was given", value);
    return NULL;
}

/* Enumerations are ints to every compiler that builds this. */
bool set_word(struct setting *s)
{
    const struct option_word *word = find_word(s);
    if (word)
        *(int *)member(s) = word->value;
    return word;
}

/* +D and the modes of displays long gone: two characters. */
bool set_display(struct setting *s)
{
    if (is_switch(s) && s->value && strlen(s->value) > 2)
        return setting_error(s, "'%s' is not a display mode", s->value);
    return set_flag(s);
}

bool set_dither(struct setting *s)
{
    return is_switch(s) ? !s->value || find_word(s) : set_flag(s);
}

bool set_known_word(struct setting *s)
{
    return find_word(s);
}

bool set_integrator(struct setting *s)
{
    return set_word(s) && (s->options->has_integrator = true);
}

bool set_transport(struct setting *s)
{
    const struct option_word *word = find_word(s);
    if (word)
        s->options->full_transport = word->value;
    return word;
}

bool set_action(struct setting *s)
{
    return set_word(s);
}

bool set_input(struct setting *s)
{
    return reader_scene(s->reader, s->value);
}

bool set_clock(struct setting *s)
{
    return set_number(s) && (s->options->has_clock = true);
}

/* A letter of POV-Ray's and the bits of each colour, as in N16. */
static bool read_file_type(struct setting *s, const char *type)
{
    static const struct option_word types[] = {
        {"N", OPTIONS_FORMAT_PNG, false},
        {"P", OPTIONS_FORMAT_PPM, false},
        {"E", OPTIONS_FORMAT_EXR, false},
        {"T", 0, true},
        {"C", 0, true},
        {"H", 0, true},
        {"J", 0, true},
        {"B", 0, true},
        {"S", 0, true},
        {NULL, 0, false},
    };
    const struct option_word *t = types;
    while (t->word && (*type & ~0x20) != *t->word)
        t++;
    if (!t->word)
        return setting_error(s,
                             "'%s' is no file type; N is PNG, E OpenEXR, "
                             "P PPM",
                             type);
    if (t->missing)
        return setting_error(s,
                             "file type '%c' is not supported yet; N is "
                             "PNG, E OpenEXR, P PPM",
                             *type);
    if (type[1]) {
        double bits;
        if (!parse_number(type + 1, &bits) || bits < 5 || bits > 16)
            return setting_error(s,
                                 "'%s' is not a number of bits from 5 to "
                                 "16",
                                 type + 1);
        s->options->bits = (int)bits;
    }
    s->options->format = (enum options_format)t->value;
    s->options->has_format = true;
    return true;
}

bool set_output_file(struct setting *s)
{
    if (is_switch(s) && s->value && !read_file_type(s, s->value))
        return false;
    return set_flag(s);
}

bool set_file_type(struct setting *s)
{
    return read_file_type(s, s->value);
}

static bool is_identifier(const char *text, size_t length)
{
    static const char letters[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
    size_t rest = strspn(text, "abcdefghijklmnopqrstuvwxyz"
                               "ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789");
    return length > 0 && rest >= length && strspn(text, letters) > 0;
}

static struct parse_declare *find_declare(struct options *options,
                                          const char *name, size_t length)
{
    for (size_t i = 0; i < options->declares; i++)
        if (strncmp(options->declare[i].name, name, length) == 0 &&
            options->declare[i].name[length] == '\0')
            return &options->declare[i];
    return NULL;
}

static struct parse_declare *add_declare(struct setting *s, const char *name,
                                         size_t length)
{
    struct options *options = s->options;
    void *items = options->declare;
    char *copy = arena_copy(&options->arena, name, length);
    if (!copy || !arena_grow(&options->arena, &items, &options->declare_room,
                             options->declares + 1, sizeof *options->declare)) {
        out_of_memory(s);
        return NULL;
    }
    options->declare = items;
    options->declare[options->declares].name = copy;
    return &options->declare[options->declares++];
}

bool set_declare(struct setting *s)
{
    double number;
    const char *equals = strchr(s->value, '=');
    size_t length = equals ? (size_t)(equals - s->value) : 0;
    while (length > 0 && s->value[length - 1] == ' ')
        length--;
    if (!equals || !is_identifier(s->value, length))
        return setting_error(s, "'%s' is not NAME=NUMBER", s->value);
    equals++;
    equals += strspn(equals, " ");
    if (!parse_number(equals, &number))
        return setting_error(s,
                             "'%s' is not a number, and only numbers can "
                             "be declared here",
                             equals);
    struct parse_declare *d = find_declare(s->options, s->value, length);
    if (!d)
        d = add_declare(s, s->value, length);
    if (d)
        d->value = number;
    return d;
}

bool set_quality(struct setting *s)
{
    double number;
    if (!read_number(s, &number))
        return false;
    if (number < 9)
        setting_warn(s, "no effect: pictures are rendered in full");
    return true;
}

/* A PNG says its gamma, so that it looks the same with any. */
bool set_file_gamma(struct setting *s)
{
    double number;
    if (strcasecmp(s->value, "sRGB") == 0)
        return true;
    if (!parse_number(s->value, &number))
        return setting_error(s, "'%s' is neither a number nor sRGB", s->value);
    return setting_warn(s, "no effect: PNG and PPM are written as sRGB");
}

static void show_stream(struct options *options, long stream, bool show)
{
    if (stream != OPTIONS_ALL)
        options->console[stream] = show;
    else
        for (int i = 0; i < OPTIONS_ALL; i++)
            options->console[i] = show;
}

bool set_stream(struct setting *s)
{
    show_stream(s->options, s->option->at, s->sign == '+');
    return !s->value || set_stream_file(s);
}

bool set_console(struct setting *s)
{
    bool show;
    if (!read_truth(s, &show))
        return false;
    show_stream(s->options, s->option->at, show);
    return true;
}

bool set_stream_file(struct setting *s)
{
    static const char *const names[OPTIONS_STREAMS] = {
        "DEBUG.OUT", "FATAL.OUT",   "RENDER.OUT",
        "STATS.OUT", "WARNING.OUT", "ALLTEXT.OUT",
    };
    const char **file = &s->options->stream_file[s->option->at];
    bool on;
    if (option_truth(s->value, &on)) {
        *file = on ? names[s->option->at] : NULL;
        return true;
    }
    return (*file = copy_value(s, s->value));
}

static bool take_taps(struct options *o, int taps)
{
    struct brume_photon_options published = BRUME_PHOTONS_INIT;
    if (!brume_film_taps(&published, taps))
        return false;
    memcpy(o->weight, published.weight, sizeof o->weight);
    o->taps = taps;
    return true;
}

/* An odd number of weights, the middle one above 0. */
static bool read_weights(const char *text, struct options *o)
{
    char *end;
    for (o->taps = 0; o->taps < BRUME_MAX_TAPS; text = end + 1) {
        double weight = strtod(text, &end);
        if (end == text || !(weight >= 0) || !(weight <= 1e6))
            return false;
        o->weight[o->taps++] = weight;
        if (*end == '\0')
            return o->taps % 2 == 1 && o->weight[o->taps / 2] > 0;
        if (*end != ',')
            return false;
    }
    return false;
}

/* Behind the word: nothing, or a comma and the reach. */
static bool read_adaptive(const char *text, struct options *o)
{
    double reach = BRUME_ADAPTIVE_REACH;
    if (*text && (*text != ',' || !parse_number(text + 1, &reach)))
        return false;
    if (!(reach >= 1 && reach <= BRUME_MAX_REACH) || reach != (int)reach)
        return false;
    o->taps = 2 * (int)reach + 1;
    o->adaptive = true;
    return true;
}

bool set_temporal(struct setting *s)
{
    double taps;
    if (strncmp(s->value, "adaptive", 8) == 0)
        return read_adaptive(s->value + 8, s->options) ||
               setting_error(s, "'%s' is not adaptive,REACH of 1 to %d frames",
                             s->value, BRUME_MAX_REACH);
    s->options->adaptive = false;
    if (strchr(s->value, ','))
        return read_weights(s->value, s->options) ||
               setting_error(s,
                             "'%s' is no odd number of weights, up to %d, the "
                             "middle one above 0",
                             s->value, BRUME_MAX_TAPS);
    return (parse_number(s->value, &taps) && taps == (int)taps &&
            take_taps(s->options, (int)taps)) ||
           setting_error(s,
                         "'%s' is neither 1, 3 or 5 frames, nor weights, nor "
                         "adaptive",
                         s->value);
}

bool set_shard(struct setting *s)
{
    return shard_read(s->value, &s->options->shard) ||
           setting_error(s, "'%s' is neither part I of N, as 2/5, nor 'slurm'",
                         s->value);
}

bool set_gpus(struct setting *s)
{
    if (strcmp(s->value, "all") != 0)
        return set_integer(s);
    s->options->gpus = -1;
    return true;
}

bool set_missing(struct setting *s)
{
    return setting_error(s, "not supported yet");
}

bool set_missing_flag(struct setting *s)
{
    bool off = s->sign == '-', on;
    if (s->sign == '=' && s->value && option_truth(s->value, &on))
        off = !on;
    return off || set_missing(s);
}

bool set_shell(struct setting *s)
{
    return setting_warn(s, "left out: Brume never runs shell commands");
}
