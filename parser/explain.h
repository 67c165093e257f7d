/* explain.h - the plan of a frame, for people and as JSON. */
#ifndef PARSER_EXPLAIN_H
#define PARSER_EXPLAIN_H
#include <stdio.h>
#include "core/brume.h"

/* A line for each stage: name, runs or not, memory, reason; then the notes. */
void explain_text(const struct brume_plan *plan, FILE *to);

/* The caller frees it; NULL with err set. */
char *explain_json(const struct brume_plan *plan, struct brume_error *err);

/* "512 B", "12.3 MiB"; returns `out`. */
const char *explain_bytes(uint64_t bytes, char *out, size_t size);

#endif
