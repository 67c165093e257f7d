/* frames.h - which frames a run renders, what the clock says in each, and
 * which part of the picture it renders: arithmetic alone, as POV-Ray 3.7 does
 * it. */
#ifndef PARSER_FRAMES_H
#define PARSER_FRAMES_H
#include <stdbool.h>
#include "lib/error.h"
#include "parser/options.h"
#include "parser/parse.h"

struct frames {
    bool animation;             /* false: one picture without a number     */
    int first, last, step;      /* numbers of the frames to render         */
    int initial, final;         /* of the whole film                       */
    int digits;                 /* a number in a file's name has, or more  */
    bool none;                  /* this part of the film has no frame      */
};

void frames_init(struct frames *frames, const struct options *options);

/* Leaves the frames of one part of the film; a still is all of its last. */
void frames_shard(struct frames *frames, const struct shard *shard);

/* What a scene sees in the frame of that number. */
void frames_ambient(const struct frames *frames, const struct options *options,
                    int number, struct parse_ambient *ambient);

/* x0, y0, x1, y1, half open, from +SC +SR +EC +ER. False with err set
 * (BRUME_ERR_USAGE) unless it is a part of the picture that is not empty. */
bool frames_region(const struct options *options, int region[4],
                   struct brume_error *err);

#endif
