/* check.h - `--check=json`: diagnostics for programs.
 *
 * {"brume": version, "errors": N, "warnings": N, "diagnostics": [
 *     {"severity": "error" | "warning" | "note", "code": exit code of an error,
 *      "file", "line", "column" (from 1, in characters), "message",
 *      "excerpt": source line and caret line,
 *      "trace": [lines, innermost first], "hint"}, ...]}
 * A member of an entry without a value is left out. */
#ifndef PARSER_CHECK_H
#define PARSER_CHECK_H
#include <stdint.h>
#include "parser/diag.h"

struct json;

/* {0} at first. */
struct check {
    struct json *list;
    uint64_t errors, warnings;
    bool lost;                  /* memory was wanting                      */
};

void check_add(struct check *check, const struct diag *diag);
/* The text, which the caller frees, and an end to the check; NULL: no
 * memory. */
char *check_text(struct check *check, struct brume_error *err);

#endif
