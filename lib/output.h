/* output.h - files that appear only when they are complete.
 *
 * The bytes go to a temporary file in the target's folder, which is synced
 * and renamed over the target by output_commit. A target that is not a
 * regular file (/dev/stdout, a pipe) is written in place. Errors are
 * BRUME_ERR_FILE and name the path and the system's reason. */
#ifndef LIB_OUTPUT_H
#define LIB_OUTPUT_H
#include <stddef.h>
#include <stdio.h>
#include "lib/error.h"

#ifdef __cplusplus
extern "C" {
#endif

struct output;

/* NULL with err set when the file can't be made there. A link is followed;
 * the permissions of an existing target are kept. */
struct output *output_open(const char *path, struct brume_error *err);

/* The stream to write to; the caller does not close it. */
FILE *output_stream(struct output *o);

/* The name of the file that is being written, for a library that insists on
 * opening it itself. */
const char *output_name(const struct output *o);

/* It need not be on the disk when it is committed: for what a hash guards, and
 * is wanted soon. */
void output_hurry(struct output *o);

/* Removes what programs that were killed left unfinished in the folder of a
 * path; what is still being written is locked, and stays. */
void output_sweep(const char *path);

/* Ends the file and frees `o`. False with err set when any write failed: the
 * target is then as it was before. */
bool output_commit(struct output *o, struct brume_error *err);

/* Removes what was written and frees `o`, which may be NULL. */
void output_discard(struct output *o);

/* Commits if `ok`, discards if not; true when the file is there. */
bool output_close(struct output *o, bool ok, struct brume_error *err);

/* A whole file from memory: statistics, JSON, tables. */
bool output_write(const char *path, const void *bytes, size_t size,
                  struct brume_error *err);

#ifdef __cplusplus
}
#endif
#endif
