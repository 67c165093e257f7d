/* input.h - finding and reading the texts that a run is given. */
#ifndef PARSER_INPUT_H
#define PARSER_INPUT_H
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include "lib/arena.h"
#include "lib/error.h"
#include "parser/options.h"

/* All that is left of a stream, with a NUL behind it. False with err set:
 * BRUME_ERR_FILE (`name` in its text), BRUME_ERR_LIMIT over `limit` bytes,
 * BRUME_ERR_MEMORY. */
bool input_read(FILE *from, const char *name, size_t limit,
                struct arena *arena, char **text, size_t *length,
                struct brume_error *err);

/* A regular file, or a pipe; false with err set as above. */
bool input_read_file(const char *path, size_t limit, struct arena *arena,
                     char **text, size_t *length, struct brume_error *err);

/* Where the scene is: the name as it was given, with .pov behind it where it
 * has no extension; in the working folder, beside the INI file that names it,
 * on the library path. NULL with err set (BRUME_ERR_FILE): nowhere. */
const char *input_find(struct options *options, struct brume_error *err);

/* The folder of the include files that come with the program, found from
 * where the program lies: as installed, or in the source tree. NULL: none. */
const char *input_own_folder(struct arena *arena);

#endif
