/* permit.h - opening the files that a scene may read and write.
 *
 * Texts are read from the scene's own folder, the library path, folders that
 * the user allows, and what the scene wrote itself; files are written to the
 * output folder and those that the user allows, except hidden ones. Links and
 * `..` are resolved first, and what was opened is looked at once more, so that
 * nothing that is moved or linked meanwhile leads elsewhere. */
#ifndef PARSER_PERMIT_H
#define PARSER_PERMIT_H
#include "parser/parser.h"

/* Whether a text may be read; the file need not be there. */
bool permit_reads(const struct parser *parser, const char *path);

/* Whether a scene of the film wrote the file. */
bool permit_wrote(const struct parser *parser, const char *path);

/* What --check keeps aside of a file that the scene wrote; -1: nothing. */
int permit_kept(const struct parser *parser, const char *path);

/* Open a file and give its descriptor; -1: reported. */
int permit_open_text(struct parser *parser, struct location at,
                     const char *path);
/* One that the user names. */
int permit_open_any(struct parser *parser, struct location at,
                    const char *path);
/* A file that a scene writes, empty unless `append` is asked for; its resolved
 * path goes to *path. A relative name is one in the working folder if that may
 * be written to, else in the output folder. */
int permit_open_output(struct parser *parser, struct location at,
                       struct string name, bool append, const char **path);

#endif
