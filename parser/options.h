/* options.h - what a run is asked to do, read from the command line and from
 * INI files.
 *
 * POV-Ray's switches and INI options mean what they mean there (brume.1 says
 * where Brume differs); GNU long options name what POV-Ray lacks. The table of
 * option_table.c is the one list of them all. */
#ifndef PARSER_OPTIONS_H
#define PARSER_OPTIONS_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include "core/brume.h"
#include "lib/arena.h"
#include "parser/diag.h"
#include "parser/parse.h"
#include "parser/shard.h"

enum options_action {
    OPTIONS_RENDER, OPTIONS_CHECK, OPTIONS_CHECK_JSON,
    OPTIONS_EXPLAIN, OPTIONS_EXPLAIN_JSON,
    OPTIONS_MEASURE,                /* by the word `measure` alone         */
    OPTIONS_MEASURE_TEMPORAL,       /* ... with --temporal behind it       */
    OPTIONS_HELP, OPTIONS_VERSION
};

enum options_format {
    OPTIONS_FORMAT_PNG, OPTIONS_FORMAT_EXR, OPTIONS_FORMAT_PPM
};

enum options_progress {
    OPTIONS_PROGRESS_AUTO,      /* a line, on a terminal                   */
    OPTIONS_PROGRESS_OFF, OPTIONS_PROGRESS_JSON
};

/* POV-Ray's text streams; the last is a file for all of them. */
enum options_stream {
    OPTIONS_DEBUG, OPTIONS_FATAL, OPTIONS_RENDERING, OPTIONS_STATISTICS,
    OPTIONS_WARNING, OPTIONS_ALL, OPTIONS_STREAMS
};

struct options_list {       /* of texts, in the order they were given      */
    const char **item;
    size_t count, room;
};

/* Texts lie in the arena. */
/* Numbers of photons that 'brume measure --temporal' takes. */
enum { OPTIONS_MOST_PHOTONS = 8 };

struct options {
    struct arena arena;
    enum options_action action;

    const char *input;              /* the scene, "-": stdin, NULL: none   */
    const char *input_folder;       /* of the INI file that names `input`,
                                       ended by '/'; NULL: none            */
    const char *header;             /* +HI                                 */
    double version;                 /* +MV, 0: not given                   */
    struct options_list library, allow_read, allow_write;
    struct parse_declare *declare;
    size_t declares, declare_room;

    const char *output;             /* +O, NULL: named after the scene     */
    bool to_file;
    bool has_format;                /* else the name of `output` picks it  */
    enum options_format format;
    int bits;                       /* per colour, as asked for: 5 to 16   */
    bool alpha;
    int width, height;
    /* As given: pixels counted from 1, or fractions; below 0: not given. */
    double start_column, end_column, start_row, end_row;

    bool has_clock;
    double clock;                   /* of a still                          */
    int initial_frame, final_frame, frame_step;
    double initial_clock, final_clock;
    /* A fraction of final_frame if below 1; below 0: not given. */
    double subset_start, subset_end;
    bool cyclic;
    struct shard shard;
    bool resume;                    /* leave out what is finished          */

    enum brume_backend backend;
    bool has_integrator;
    enum brume_integrator integrator;
    enum brume_tree tree;
    int tree_stack;
    int tree_on_cpu;
    int preset;                     /* 1: paper                            */
    int taps;                       /* of --temporal; 0: not given         */
    bool adaptive;
    double weight[BRUME_MAX_TAPS];
    bool full_transport;
    const char *plate;              /* %d: the frame's number; or NULL     */
    const char *plate_layer;
    int plate_depth;                /* enum parse_depth                    */
    int spp;
    double error, seconds;
    int threads;
    int gpus;                   /* -1: all; 0: all, if there are any       */
    uint64_t seed, memory, photons;
    uint64_t more_photons[OPTIONS_MOST_PHOTONS - 1];    /* up to a 0       */
    double field_spacing, field_depth;
    /* Of reading a scene; 0: the default of struct parse_limits. */
    int include_depth, macro_depth;
    uint64_t iterations, tokens;
    double parse_seconds;
    const char *stats;              /* file of --stats, or NULL            */
    const char *reference;          /* of measure, or NULL                 */
    double budget;                  /* ... its seconds, 0: not given       */
    int repeat;                     /* of measure --temporal, 0: not given */

    bool has_verbose, verbose;      /* +V                                  */
    enum options_progress progress;
    bool console[OPTIONS_STREAMS];
    const char *stream_file[OPTIONS_STREAMS];
    bool append;                    /* to the files of the streams         */
    int warning_level;
};

/* Sets every default of the table. */
void options_init(struct options *options);
void options_release(struct options *options);

/* Reads the words of a command line in their order; a later one overrides an
 * earlier one. Goes on after an error so that all of them are reported.
 * False: `diag` has errors, their code mostly BRUME_ERR_USAGE. */
bool options_read_words(struct options *options, int count,
                        const char *const *word, struct diag *diag);

/* Reads one INI file; of its sections only the one named (NULL: none), with
 * what stands before the first. */
bool options_read_ini(struct options *options, const char *path,
                      const char *section, struct diag *diag);

/* The INI file that is read before the command line: the first there is of
 * brume.ini and povray.ini in the working folder, then in the user's folders.
 * The path lies in the arena; NULL: none. */
const char *options_find_ini(struct options *options);

/* What --help prints, made from the table. */
void options_help(FILE *to);

#endif
