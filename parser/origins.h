/* origins.h - what files a scene was read from, so that a later run can tell
 * whether it would be the same scene. */
#ifndef PARSER_ORIGINS_H
#define PARSER_ORIGINS_H
#include "parser/parse.h"

/* A file that is read from now on; a name under which there was none. Each is
 * kept once, in the order of coming. Where there is no memory, or there are too
 * many, `incomplete` is set. */
void origins_add(struct parse_origins *origins, const char *path);
void origins_miss(struct parse_origins *origins, const char *path);
/* All that `from` has. */
void origins_merge(struct parse_origins *origins,
                   const struct parse_origins *from);
/* A file that is no longer what it was when it was read, or NULL: what was made
 * of it does not tell what would be made of it now. */
const char *origins_changed(const struct parse_origins *origins);
#endif
