/* reel.h - the loop over the frames: each reads the scene with its clock,
 * renders and writes a picture. Prints nothing: what happens is told to the
 * caller's functions. */
#ifndef PARSER_REEL_H
#define PARSER_REEL_H
#include <stdio.h>
#include "core/brume.h"
#include "parser/diag.h"
#include "parser/frames.h"
#include "parser/manifest.h"
#include "parser/measure.h"
#include "parser/measure_temporal.h"
#include "parser/options.h"
#include "parser/parse.h"
#include "parser/partial.h"

/* What became of one frame. */
struct reel_record {
    int number;                 /* 0 for a still                           */
    bool clock_on;
    double clock;
    const char *picture;        /* its file, "-", or NULL: none            */
    struct brume_stats stats;
    double seconds_parse, seconds_write;
    struct parse_counts parsed;
};

/* All but `in` and `out` are given `user`. */
struct reel_events {
    void *user;
    /* Warnings and errors, as they come up; valid during the call. */
    void (*report)(void *user, const struct diag *diag);
    void (*message)(void *user, enum parse_stream stream, const char *text);
    void (*frame)(void *user, const struct frames *frames, int number);
    void (*planned)(void *user, const struct brume_plan *plan);
    void (*progress)(void *user, const struct brume_progress *progress);
    void (*measured)(void *user, const struct measure *measure);
    void (*flickered)(void *user, const struct measure_temporal *measure);
    void (*finished)(void *user, const struct reel_record *record);
    /* A picture that is left out, being finished already. */
    void (*skipped)(void *user, const char *picture);
    bool (*stopped)(void *user);    /* true: end with BRUME_STOPPED        */
    FILE *in, *out;             /* for a scene or a picture called "-"     */
};

/* Takes pictures in place of files. */
struct reel_sink {
    void *user;
    void (*adjust)(void *user, struct brume_options *options);
    bool (*take)(void *user, int number, const struct brume_frame *frame,
                 struct brume_error *err);
};

struct reel {
    struct options *options;
    const struct reel_events *events;
    struct frames frames;
    struct arena arena;             /* for all frames                      */
    struct reel_record *record;     /* of the frames that were finished    */
    size_t records, room;
    const char *path;               /* of the scene                        */
    char *text;                     /* of a scene from a stream            */
    size_t length;
    const char *const *library, *const *allow_write;
    size_t libraries, allow_writes;
    struct parse_written written;
    struct brume_still *still;      /* of an animation, and --tree both    */
    struct parse_cache *cache;      /* or NULL                             */
    struct manifest *manifest;      /* or NULL                             */
    struct partial_list *partials;  /* or NULL                             */
    size_t skipped;                 /* pictures that were left out         */
    const struct reel_sink *sink;   /* or NULL                             */
    int region[4];
};

/* Does what options->action asks for: checks, explains or measures (the first
 * frame) or renders. Ends at the first frame that fails; the pictures of those
 * before stay. The code is the program's exit code, and BRUME_OK on success.
 * `reel` is to be released in any case. */
enum brume_code reel_run(struct reel *reel, struct options *options,
                         const struct reel_events *events);
void reel_release(struct reel *reel);

#endif
