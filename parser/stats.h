/* stats.h - what rendering took, for people and as JSON. */
#ifndef PARSER_STATS_H
#define PARSER_STATS_H
#include <stdio.h>
#include "parser/reel.h"

/* One line about a frame. */
void stats_line(const struct reel_record *record, FILE *to);

/* All frames that were finished, and how the run ended, into a file that
 * appears whole. */
bool stats_write(const struct reel *reel, enum brume_code code,
                 const char *path, struct brume_error *err);

#endif
