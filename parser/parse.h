/* parse.h - the scene language: text in, scene out.
 *
 * A call reads one scene for one frame; a film calls it again for each frame
 * with that frame's clock. Nothing is kept between calls, and nothing is
 * printed: diagnostics are collected in `diag`, and what #debug, #warning and
 * #error say goes to `message` at once. */
#ifndef PARSER_PARSE_H
#define PARSER_PARSE_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/stat.h>
#include "core/brume.h"
#include "parser/diag.h"

/* The streams that a scene can write to. */
enum parse_stream { PARSE_DEBUG, PARSE_WARNING, PARSE_ERROR };

/* An identifier given on the command line: Declare=name=value. */
struct parse_declare {
    const char *name;
    double value;
};

/* The identifiers of the same names. */
struct parse_ambient {
    double clock, clock_delta;
    bool clock_on;
    double frame_number;
    double initial_clock, final_clock;
    double initial_frame, final_frame;
    int image_width, image_height;
};
#define PARSE_AMBIENT_INIT {0, 0, false, 0, 0, 0, 0, 0, 160, 120}

/* 0 stands for the default of each. Reaching one is BRUME_ERR_LIMIT. */
struct parse_limits {
    int include_depth;          /* files within files; 64                  */
    int macro_depth;            /* calls within calls; 65536               */
    uint64_t iterations;        /* of all loops together; 10^9             */
    uint64_t tokens;            /* after expansion; 10^10                  */
    size_t memory;              /* bytes held by the front end; 4 GiB, or half
                                   of what the machine has if that is less */
    double seconds;             /* wall time; none                         */
};

/* Files that the scenes of a film wrote, and may read too; to be released by
 * the caller. Zero to begin with. */
struct parse_written {
    struct parse_written_file {
        char *path;             /* resolved                                */
        int kept;               /* what stands for it; -1: it is there     */
    } *file;
    size_t count, room;
};
void parse_written_release(struct parse_written *written);

/* Paths as the scene found them, each once. */
struct parse_paths {
    char **path;
    size_t count, room;
};

/* What a scene depends on besides its input: the files that it read, and the
 * places where it looked for one in vain. What the scenes of the film wrote
 * is left out. Zero to begin with; calls add to it. */
struct parse_origins {
    struct parse_paths read, missing;
    struct stat *was;           /* of each that was read, before it was    */
    size_t was_room, changed;   /* number of a file that was read twice and
                                   had changed, counted from 1; 0: none    */
    bool incomplete;            /* there were too many to be kept          */
};
void parse_origins_release(struct parse_origins *origins);

/* Grids and meshes of the files that the last scene named: where the next one
 * of the film names one that has not changed, it is not read again. */
struct parse_cache;
struct parse_cache *parse_cache_new(struct brume_error *err);
void parse_cache_free(struct parse_cache *cache);

/* What depths of a plate are: along the axis of view, along rays, or none. */
enum parse_depth { PARSE_DEPTH_UNSAID, PARSE_DEPTH_AXIS, PARSE_DEPTH_RAY,
                   PARSE_DEPTH_NONE };

/* A plate in place of the scene's (--plate), and what is said of either in
 * place of the scene's words. */
struct parse_plate {
    const char *path, *layer;   /* or NULL                                 */
    enum parse_depth depth;
};

struct parse_input {
    const char *path;           /* the scene; "-" if text is not a file's  */
    const char *text;           /* read already (standard input); or NULL  */
    size_t length;              /* of text                                 */
    const char *header;         /* a text included before the scene's first
                                   token (+HI); or NULL                    */
    double version;             /* of the language until #version says
                                   otherwise (+MV); 0: 3.7                 */
    bool all_errors;            /* go on behind errors, to report them all */
    bool dry;                   /* what the scene writes is kept aside, for it
                                   to read, and gone at the end            */
    bool full_transport;        /* transport is full unless the scene writes
                                   it out (--transport full)               */
    struct parse_plate plate;
    /* Folders, in the order they are searched after the scene's own. */
    const char *const *library;
    size_t libraries;
    /* Folders that #include may reach into besides those, and folders that
     * a scene may write to. */
    const char *const *allow_read, *const *allow_write;
    size_t allow_reads, allow_writes;   /* the output folder is the last   */
    struct parse_written *written;      /* or NULL                         */
    struct parse_origins *origins;      /* or NULL                         */
    struct parse_cache *cache;          /* or NULL                         */
    const struct parse_declare *declare;
    size_t declares;
    struct parse_ambient ambient;
    struct parse_limits limits;
    /* May be NULL. `text` ends with NUL and may hold line ends. */
    void (*message)(void *user, enum parse_stream stream, const char *text);
    /* May be NULL. Asked now and then; true ends the parse at once with
     * BRUME_STOPPED. */
    bool (*stopped)(void *user);
    void *user;
};

/* How many texts and meshes were read, and how many a film had from the frame
 * before. */
struct parse_counts {
    uint64_t texts_read, texts_kept, meshes_read, meshes_kept;
};

/* What the scene says of its own rendering; the command line overrides it. */
struct parse_result {
    brume_scene *scene;         /* the caller frees it                     */
    double version;             /* of #version, 3.7 if it says none        */
    double assumed_gamma;       /* 0: not given                            */
    bool has_integrator;
    enum brume_integrator integrator;
    struct brume_photon_options photons;
    double accuracy;            /* 0: not given; estimated relative error  */
    double time_limit;          /* seconds, 0: not given                   */
    struct parse_counts counts;
};

/* False: `diag` holds an error whose code is the exit code, and out->scene is
 * NULL. Warnings alone leave it true. */
bool parse_scene(const struct parse_input *in, struct parse_result *out,
                 struct diag *diag);

#endif
