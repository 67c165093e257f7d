/* stamp.h - whether a file is still the one that was read. */
#ifndef LIB_STAMP_H
#define LIB_STAMP_H
#include <stdbool.h>
#include <sys/stat.h>

/* The same file, of the same size and times of change. */
bool stamp_is_same(const struct stat *a, const struct stat *b);

/* Whether a change from now on would give the file another stamp: clocks of
 * file systems tick a hundred times a second or more. */
bool stamp_is_settled(const struct stat *now);
#endif
