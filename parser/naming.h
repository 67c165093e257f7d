/* naming.h - what the picture of a frame is called, and its format. */
#ifndef PARSER_NAMING_H
#define PARSER_NAMING_H
#include "lib/arena.h"
#include "parser/frames.h"
#include "parser/options.h"

/* +F decides; without it a known extension of +O; without that PNG. */
enum options_format naming_format(const struct options *options);

/* The file that the frame of that number is written to; "-": standard output.
 * As POV-Ray: the name of +O, or of the scene where that names none or a
 * folder; without the format's own extension, with the frame's number and
 * that extension. In the arena; NULL: no memory. */
const char *naming_picture(const struct options *options,
                           const struct frames *frames, int number,
                           struct arena *arena);

/* A file beside a still's picture: its name without an extension, with `end`
 * behind it. In the arena; NULL: no memory. */
const char *naming_beside(const struct options *options, const char *end,
                          struct arena *arena);

/* A file's name with the frame's number for %d or %04d, which it has at most
 * once, and % for %%. In the arena; NULL: no memory. */
const char *naming_numbered(const char *name, int number, struct arena *arena);

/* Whether pictures go to standard output, a device or a pipe. */
bool naming_is_stream(const struct options *options);

/* The folder of the pictures, "." for the working one; NULL: no memory. */
const char *naming_folder(const struct options *options, struct arena *arena);

/* The extension of +O if it is a picture format's that is not the one
 * written, so that .png goes behind it; else NULL. */
const char *naming_foreign(const struct options *options);

#endif
