/* stream.h - the files that a scene opens with #fopen. */
#ifndef PARSER_STREAM_H
#define PARSER_STREAM_H
#include "parser/parser.h"

enum stream_mode { STREAM_READ, STREAM_WRITE, STREAM_APPEND };

/* How #write writes a number: as text, or as a word of a file. */
enum stream_word {
    STREAM_TEXT,
    STREAM_SINT8, STREAM_UINT8,
    STREAM_SINT16BE, STREAM_SINT16LE, STREAM_UINT16BE, STREAM_UINT16LE,
    STREAM_SINT32BE, STREAM_SINT32LE,
    STREAM_WORDS
};
/* The word of the language; NULL: STREAM_TEXT has none. */
const char *stream_word_name(enum stream_word word);

/* NULL: reported. */
struct stream *stream_open(struct parser *parser, struct location at,
                           struct string name, enum stream_mode mode);
/* False: what was written could not be, reported. */
bool stream_close(struct parser *parser, struct location at,
                  struct stream *stream);
/* Closes all that are open when a scene ends. */
bool stream_close_all(struct parser *parser);
/* Frees what is open after an error. */
void stream_release(struct parser *parser);

/* Writes a string, or a number of any count of terms: a vector as text has
 * brackets and a blank behind it, as POV-Ray's. False: reported. */
bool stream_write(struct parser *parser, struct location at,
                  struct stream *stream, const struct value *value,
                  enum stream_word word);

/* Reads a literal, a string, float or vector, and the comma that may follow.
 * *value is VALUE_NONE if the file is at its end. False: reported. */
bool stream_read(struct parser *parser, struct location at,
                 struct stream *stream, struct value *value);
/* Whether a file that is read has no more. */
bool stream_at_end(struct stream *stream);

#endif
