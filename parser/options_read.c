/* Where options come from: the words of a command line, INI files and the INI
 * files that those name. */
#include "parser/ini.h"
#include "parser/input.h"
#include "parser/option.h"
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { MAX_INI_BYTES = 1 << 20, MAX_INI_FILES = 256 };

static bool is_file(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && !S_ISDIR(status.st_mode);
}

static const char *join(struct arena *arena, const char *a, const char *b)
{
    size_t size = strlen(a) + strlen(b) + 1;
    char *out = arena_alloc(arena, size);
    if (out)
        snprintf(out, size, "%s%s", a, b);
    return out;
}

static const char *folder_of(struct arena *arena, const char *path)
{
    const char *slash = path ? strrchr(path, '/') : NULL;
    return slash ? arena_copy(arena, path, (size_t)(slash + 1 - path)) : NULL;
}

/* ---- INI files --------------------------------------------------------- */

/* Reads what stands before the first section and what the wanted ones hold;
 * `*found` tells whether there are any. False: nothing more can be read. */
static bool read_items(struct option_reader *reader, struct ini *ini,
                       bool *found)
{
    bool wanted = true;
    bool both;
    struct ini_item item;
    do {
        if (!ini_next(ini, &reader->options->arena, &item))
            return reader_fail(reader, BRUME_ERR_MEMORY, NULL, "out of memory");
        reader->line = ini->line;
        reader->line_end = ini->line_end;
        reader->where = item.where;
        reader->number = ini->number;
        if (item.kind == INI_SECTION) {
            wanted = reader->section &&
                     strcasecmp(item.name, reader->section) == 0;
            *found = *found || wanted;
        } else if (item.kind == INI_BAD) {
            reader_fail(reader, BRUME_ERR_USAGE, NULL, "%s", item.name);
        } else if (item.kind == INI_SETTING && wanted) {
            reader_setting(reader, item.name, strlen(item.name), item.value);
        } else if (item.kind == INI_WORD && wanted) {
            reader_word(reader, item.name, NULL, &both);
        }
    } while (item.kind != INI_END);
    return true;
}

static bool same_section(const char *a, const char *b)
{
    return a && b ? strcasecmp(a, b) == 0 : a == b;
}

static bool is_being_read(const struct option_reader *reader, const char *path,
                          const char *section)
{
    struct stat a, b;
    if (stat(path, &a) != 0)
        return false;
    for (; reader && reader->file; reader = reader->outer)
        if (stat(reader->file, &b) == 0 && a.st_dev == b.st_dev &&
            a.st_ino == b.st_ino && same_section(section, reader->section))
            return true;
    return false;
}

static bool read_file(const struct option_reader *outer, const char *path,
                      const char *section)
{
    struct option_reader reader = {
        .options = outer->options,
        .diag = outer->diag,
        .outer = outer,
        .file = path,
        .section = section,
        .files = outer->files,
    };
    struct brume_error err = {0};
    char *text;
    size_t length;
    if (is_being_read(outer, path, section))
        return reader_fail(outer, BRUME_ERR_USAGE, NULL,
                           "'%s' would be read within itself", path);
    if (++*outer->files > MAX_INI_FILES)
        return reader_fail(outer, BRUME_ERR_LIMIT, NULL,
                           "more than %d INI files are read", MAX_INI_FILES);
    if (!input_read_file(path, MAX_INI_BYTES, &outer->options->arena, &text,
                         &length, &err))
        return reader_fail(outer, err.code, NULL, "%s", err.text);

    int errors = outer->diag->errors;
    bool found = !section;
    struct ini ini;
    ini_init(&ini, text, length);
    if (!read_items(&reader, &ini, &found))
        return false;
    if (!found)
        return reader_fail(outer, BRUME_ERR_USAGE, NULL,
                           "'%s' has no section [%s]", path, section);
    return outer->diag->errors == errors;
}

/* ---- words that are no options ----------------------------------------- */

/* The name as it is, or beside the INI file that has it. */
static const char *find_ini(const struct option_reader *reader,
                            const char *name)
{
    struct arena *arena = &reader->options->arena;
    const char *folder = folder_of(arena, reader->file);
    const char *beside = folder && *name != '/' && !is_file(name)
                             ? join(arena, folder, name)
                             : NULL;
    return beside && is_file(beside) ? beside : name;
}

static bool ends_with(const char *text, size_t length, const char *end)
{
    size_t size = strlen(end);
    return length >= size && strncasecmp(text + length - size, end, size) == 0;
}

/* file.ini[section] */
static bool read_section_of(const struct option_reader *reader,
                            const char *word, const char *bracket)
{
    struct arena *arena = &reader->options->arena;
    const char *name = arena_copy(arena, word, (size_t)(bracket - word));
    const char *section = arena_copy(arena, bracket + 1, strlen(bracket) - 2);
    if (!name || !section)
        return reader_fail(reader, BRUME_ERR_MEMORY, NULL, "out of memory");
    return read_file(reader, find_ini(reader, name), section);
}

bool reader_scene(const struct option_reader *reader, const char *name)
{
    struct options *options = reader->options;
    options->input = arena_copy(&options->arena, name, strlen(name));
    options->input_folder = folder_of(&options->arena, reader->file);
    if (!options->input)
        return reader_fail(reader, BRUME_ERR_MEMORY, NULL, "out of memory");
    return true;
}

bool reader_operand(const struct option_reader *reader, const char *word)
{
    size_t length = strlen(word);
    const char *bracket = strrchr(word, '[');
    if (length == 0)
        return reader_fail(reader, BRUME_ERR_USAGE, NULL, "an empty word");
    if (strcmp(word, "-") == 0)
        return reader_scene(reader, word);
    if (bracket && bracket > word && word[length - 1] == ']')
        return read_section_of(reader, word, bracket);
    if (ends_with(word, length, ".ini"))
        return read_file(reader, find_ini(reader, word), NULL);
    /* As in POV-Ray, a bare name means its INI file if there is one. */
    const char *slash = strrchr(word, '/');
    if (!strchr(slash ? slash : word, '.') && !is_file(word)) {
        const char *ini = join(&reader->options->arena, word, ".ini");
        if (ini && is_file(ini))
            return read_file(reader, ini, NULL);
    }
    if (reader->file && !ends_with(word, length, ".pov"))
        return reader_fail(reader, BRUME_ERR_USAGE, NULL,
                           "'%s' is neither name=value, nor a switch, nor an "
                           "INI file",
                           word);
    return reader_scene(reader, word);
}

/* ---- where it begins --------------------------------------------------- */

bool options_read_words(struct options *options, int count,
                        const char *const *word, struct diag *diag)
{
    int files = 0;
    struct option_reader reader = {
        .options = options,
        .diag = diag,
        .files = &files,
    };
    bool ok = true;
    for (int i = 0; i < count; i++) {
        bool both;
        const char *next = i + 1 < count ? word[i + 1] : NULL;
        ok = reader_word(&reader, word[i], next, &both) && ok;
        i += both;
    }
    return ok;
}

bool options_read_ini(struct options *options, const char *path,
                      const char *section, struct diag *diag)
{
    int files = 0;
    struct option_reader reader = {
        .options = options,
        .diag = diag,
        .files = &files,
    };
    return read_file(&reader, path, section);
}

const char *options_find_ini(struct options *options)
{
    struct arena *arena = &options->arena;
    const char *home = getenv("HOME"), *config = getenv("XDG_CONFIG_HOME");
    bool has_config = config && *config;
    if (!home)
        home = "";
    const char *const candidate[] = {
        "brume.ini",
        "povray.ini",
        join(arena, has_config ? config : home,
             has_config ? "/brume/brume.ini" : "/.config/brume/brume.ini"),
        join(arena, home, "/.povray/3.7/povray.ini"),
    };
    for (size_t i = 0; i < sizeof candidate / sizeof *candidate; i++)
        if (candidate[i] && is_file(candidate[i]))
            return candidate[i];
    return NULL;
}
