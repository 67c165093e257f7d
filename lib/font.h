/* font.h - outlines of text, by FreeType. */
#ifndef LIB_FONT_H
#define LIB_FONT_H
#include <stdbool.h>
#include <stddef.h>
#include "lib/error.h"

/* A line of text as the outlines of its glyphs, in units of the font's em,
 * the left edge of the first at 0: for each glyph the number of
 * its segments, then the four x and y of each, a cubic Bezier curve; of a blank
 * its place, as of a text without glyphs.
 * Each glyph comes after the one before by its advance, kerned, and by
 * `offset` (x, y) more. `text` is UTF-8; what is not is taken as Latin-1. The
 * numbers are freed with free(). False with err set on failure. */
bool font_outline(const char *path, const char *text, const double offset[2],
                  double **numbers, size_t *count, struct brume_error *err);

/* The file of a font of this machine that stands for one that is not there:
 * with or without serifs, or of one width, as its name says. False if none
 * of those that are known is installed. */
bool font_substitute(const char *name, char *path, size_t size);
#endif
