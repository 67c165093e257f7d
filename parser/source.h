/* source.h - the texts of a scene, each read once. */
#ifndef PARSER_SOURCE_H
#define PARSER_SOURCE_H
#include "parser/parser.h"

struct chunk;

struct source {
    uint32_t id;            /* index in the parser's table of texts        */
    const char *name;       /* as diagnostics print it                     */
    const char *folder;     /* of the text, "" for the working folder      */
    const char *real;       /* resolved path; NULL: not read from a file   */
    char *text;
    size_t length, room;
    bool data;              /* read by #read: its tokens are not kept      */
    bool idle;              /* data that is not read from any more         */
    struct kept_text *kept; /* has text and tokens, or NULL                */
    struct chunk *whole;    /* all its tokens, or NULL: see reader.h       */
};

/* The scene itself. NULL: could not be read, reported. */
struct source *source_open_scene(struct parser *parser);
/* A text that the user names. One that was read already is found again. */
struct source *source_open_path(struct parser *parser, struct location at,
                                const char *path);
/* A text that #include names: it is sought, and must be permitted. */
struct source *source_open(struct parser *parser, struct location at,
                           struct string name);
/* A file that #read reads, as it is now. */
struct source *source_open_data(struct parser *parser, struct location at,
                                struct string name);
void source_close_data(struct source *source);
/* The file was written to: it is read anew when it is named again. */
void source_forget(struct parser *parser, const char *real);

void source_release(struct parser *parser);

/* False: texts and tokens need more memory than they may, reported. */
bool source_fits(struct parser *parser, struct location at);

/* A line and column of a text, both from 1; columns count characters. */
struct source_point {
    int line, column;
    const char *start, *end;    /* the line, without its end               */
    const char *at;
};
struct source_point source_locate(const struct source *source,
                                  uint32_t offset);

#endif
