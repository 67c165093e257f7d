/* option.h - a row of the table of options, and what its handler is given.
 * Shared by options.c, option_set.c, option_table.c and option_help.c. */
#ifndef PARSER_OPTION_H
#define PARSER_OPTION_H
#include "parser/options.h"

struct setting;
typedef bool option_set(struct setting *setting);

struct option_word {            /* a value with a name                     */
    const char *word;
    int value;
    bool missing;               /* known, but not supported yet            */
};

enum { OPTION_NOWHERE = -1 };   /* accepted and checked, without effect    */

struct option {
    const char *plus;           /* the switch without its sign; or NULL    */
    const char *ini;            /* the INI option; or NULL                 */
    const char *name;           /* the GNU long option; or NULL            */
    const char *value;          /* what its value is called; NULL: none;
                                   in brackets: it may be left out         */
    option_set *set;
    long at;                    /* offset in struct options, or NOWHERE    */
    double low, high;           /* range of a number                       */
    double initial;             /* of a number or flag                     */
    const struct option_word *words;
    const char *help;           /* NULL: listed without an explanation     */
};

extern const struct option option_table[];
extern const int option_count;

/* What a word or a setting is read from. Files that name INI files make a
 * chain of these. */
struct option_reader {
    struct options *options;
    struct diag *diag;
    const struct option_reader *outer;  /* reads the file that names this  */
    const char *file, *section; /* NULL: the command line; none            */
    /* Where the item at hand stands in the file. */
    const char *line, *line_end, *where;
    int number;
    int *files;                 /* INI files that were read so far         */
};

/* One word of a command line or of an INI file's line, with the next one if
 * there is one; `*both` is set when that was its value. */
bool reader_word(const struct option_reader *reader, const char *word,
                 const char *next, bool *both);
/* A setting by its INI name of `length` bytes. */
bool reader_setting(const struct option_reader *reader, const char *name,
                    size_t length, const char *value);
/* A word that is no option: a scene, or an INI file to be read. */
bool reader_operand(const struct option_reader *reader, const char *word);
/* The scene to render: its name in the item at hand. */
bool reader_scene(const struct option_reader *reader, const char *name);

/* Reports at the item at hand; always false. `hint` may be NULL. */
bool reader_fail(const struct option_reader *reader, enum brume_code code,
                 const char *hint, const char *format, ...)
    BRUME_PRINTF(4, 5);

/* An option about to be set. */
struct setting {
    const struct option_reader *reader;
    struct options *options;    /* the reader's                            */
    const struct option *option;
    const char *written;        /* its name as the user chose it           */
    char sign;                  /* '+' or '-' of a switch; else '='        */
    const char *value;          /* NULL: none                              */
};

/* Report at the setting's place; the first always returns false, the second
 * true. */
bool setting_error(const struct setting *setting, const char *format, ...)
    BRUME_PRINTF(2, 3);
bool setting_warn(const struct setting *setting, const char *format, ...)
    BRUME_PRINTF(2, 3);

/* The handlers. A `flag` takes no value as a switch or a long option and on or
 * off in an INI file; a `flag_number` may have one as a switch. */
option_set set_flag, set_flag_number, set_display, set_dither;
option_set set_integer, set_number, set_unsigned, set_photons,
           set_bytes;
option_set set_text, set_numbered, set_folder, set_word, set_known_word;
option_set set_input, set_output_file, set_file_type, set_declare, set_clock;
option_set set_quality, set_file_gamma, set_stream, set_console,
           set_stream_file;
option_set set_action, set_integrator, set_transport, set_shard,
           set_gpus, set_temporal;
option_set set_missing, set_missing_flag, set_shell;

/* on, true, yes, 1 and their opposites; case does not matter. */
bool option_truth(const char *text, bool *truth);

#endif
