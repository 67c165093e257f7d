/* build.h - from parsed statements to a scene: what the grammar calls.
 *
 * A statement is opened, is given arguments, parameters, words, maps and the
 * values of inner statements and identifiers, and is closed, which gives its
 * value. The builder keeps the open ones on a stack of its own, so nothing
 * recurses over what a user nests. Each call reports what is wrong to the
 * parser, at the place that is wrong, and does nothing once it has failed. */
#ifndef PARSER_BUILD_H
#define PARSER_BUILD_H
#include <stdbool.h>
#include "parser/parser.h"

/* A scene begins: makes parser->builder. False: no memory, reported. */
bool build_begin(struct parser *parser);
/* The text has ended: camera, globals and atmosphere go to the scene. */
bool build_finish(struct parser *parser);
/* Frees what does not lie in the arena; may be called at any time. */
void build_release(struct parser *parser);

/* `word` begins the statement; "#default" is one. */
void build_open(struct parser *parser, const char *word, struct location at);
/* The value that the innermost open statement makes; VALUE_NONE if it makes
 * none. */
struct value build_close(struct parser *parser, struct location at);

/* The keyword of the innermost open statement and where it stands; NULL if
 * none is open. */
const char *build_innermost(struct parser *parser, struct location *at);

/* Around a value that a directive declares: the statement that the directive
 * happens to stand in is not around it. */
void build_suspend(struct parser *parser);
void build_resume(struct parser *parser);

/* The next of the numbers that stand before a statement's modifiers. */
void build_argument(struct parser *parser, const struct value *number,
                    struct location at);
/* A parameter: its word and the numbers after it, */
void build_set(struct parser *parser, const struct name *word,
               struct location at, const struct value *number, int count,
               struct location number_at);
/* or alone, */
void build_word(struct parser *parser, const struct name *word,
                struct location at);
/* or with another word: `brightness physical`. */
void build_choose(struct parser *parser, const struct name *word,
                  const struct name *choice, struct location at);
/* A word of Brume's own that has no meaning yet: an error that says so. */
void build_later(struct parser *parser, const struct name *word,
                 struct location at);
/* A value that an inner statement made, or that an identifier stands for. */
void build_apply(struct parser *parser, const struct value *value,
                 struct location at);

/* `translate`, `rotate` or `scale` by a vector. */
void build_move(struct parser *parser, const char *word,
                const struct value *vector, struct location at);
/* `matrix` with its twelve numbers. */
void build_matrix(struct parser *parser, const struct value *number,
                  int count, struct location at);

/* `uv_vectors` of a triangle: three vectors. */
void build_uv_vectors(struct parser *parser, const struct value *uv,
                      int count, struct location at);

/* `mesh { ply "file" }`, or obj. */
void build_mesh_file(struct parser *parser, const char *format,
                     struct string name, struct location at);

/* `density_file FORMAT "file" "grid" interpolate N fit up z`. */
struct build_file {
    const char *format;         /* the word: df3, vdb; ply, obj            */
    struct string name, grid;   /* grid.text NULL: none named              */
    struct location at;         /* of the file's name                      */
    int interpolate;            /* -1: the format's default                */
    bool fit, up_z;
};
struct build_file build_file_named(const char *format, struct string name,
                                   struct location at);
void build_file_interpolate(struct parser *parser, struct build_file *file,
                            const struct value *number, struct location at);
void build_file_up(struct parser *parser, struct build_file *file,
                   const struct value *axis, struct location at);
void build_density_file(struct parser *parser, const struct build_file *file);

/* A value that stands on its own in the scene: an object, light, camera or
 * atmosphere is added, others have no effect there. */
void build_place(struct parser *parser, const struct value *value,
                 struct location at);

#endif
