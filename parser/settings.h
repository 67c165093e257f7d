/* settings.h - all of the options that decide the bytes of a picture, as a
 * number. */
#ifndef PARSER_SETTINGS_H
#define PARSER_SETTINGS_H
#include <stdint.h>
#include "parser/frames.h"

/* Of the frame of that number; how many threads there are, where the picture
 * goes and what is told meanwhile do not count. */
uint64_t settings_hash(const struct options *options,
                       const struct frames *frames, int number);
#endif
