/* manifest.h - what was rendered with what: a line of JSON for each finished
 * picture, in a file beside them. A later run can leave out what is finished
 * and would be the same again. Several runs may add to one file. */
#ifndef PARSER_MANIFEST_H
#define PARSER_MANIFEST_H
#include <stdint.h>
#include "core/brume.h"
#include "parser/parse.h"

struct manifest;

/* What a picture came from. */
struct manifest_entry {
    int number;                 /* of the frame                            */
    bool clock_on;
    double clock;
    const char *picture;        /* its file                                */
    uint64_t settings;          /* settings_hash                           */
    const struct parse_origins *origins;
    bool known;                 /* the origins are all, and as they were   */
    bool writes;                /* the scenes up to it wrote files         */
    const struct brume_stats *stats;
    double seconds;             /* all that it took                        */
};

/* A file that need not be there; its lines are read if `known` is asked for.
 * NULL with err set: no memory, or it can't be read. */
struct manifest *manifest_open(const char *path, bool known,
                               struct brume_error *err);
void manifest_close(struct manifest *manifest);

/* Whether the picture of a frame is there as it was written, from files that
 * are as they were and the same settings. *writes: its scene has to be read
 * all the same, for what it writes. */
bool manifest_has(struct manifest *manifest, int number, uint64_t settings,
                  const char *picture, bool *writes);

/* Adds the line of a picture that was written. */
bool manifest_add(struct manifest *manifest, const struct manifest_entry *entry,
                  struct brume_error *err);
#endif
