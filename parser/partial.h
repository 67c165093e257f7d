/* partial.h - pictures that are not finished, kept beside where they will be:
 * PICTURE.part, which goes with the finished picture. */
#ifndef PARSER_PARTIAL_H
#define PARSER_PARTIAL_H
#include "core/brume.h"
#include "parser/parse.h"

struct partial_list;

struct partial_list *partial_new(struct brume_error *err);
void partial_free(struct partial_list *list);

/* What core keeps pictures by; of all threads. */
const struct brume_keeper *partial_keeper(const struct partial_list *list);

/* A picture is begun, with these settings from these files; `resume`: it goes
 * on from what is kept of it. Without memory it is not kept. */
void partial_begin(struct partial_list *list, uint32_t frame,
                   const char *picture, uint64_t settings,
                   const struct parse_origins *origins, bool resume);
/* It is finished, or given up (`kept`: what there is of it stays). */
void partial_end(struct partial_list *list, uint32_t frame, bool kept);
#endif
