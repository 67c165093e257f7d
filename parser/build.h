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

struct kept_mesh;

/* A scene begins: makes parser->builder. False: no memory, reported. */
bool build_begin(struct parser *parser);
/* The text has ended: camera, globals and atmosphere go to the scene. */
bool build_finish(struct parser *parser);
/* What is open is given up: the text goes on behind an error. */
void build_reset(struct parser *parser);
/* Frees what does not lie in the arena; may be called at any time. */
void build_release(struct parser *parser);

/* `word` begins the statement; "#default" is one. */
void build_open(struct parser *parser, const struct name *word,
                struct location at);
void build_open_default(struct parser *parser, struct location at);
/* The value that the innermost open statement makes; VALUE_NONE if it makes
 * none. */
struct value build_close(struct parser *parser, struct location at);
/* `[` ... `]` in it. */
void build_open_entry(struct parser *parser, struct location at);
void build_close_entry(struct parser *parser, struct location at);

/* The keyword of the innermost open statement and where it stands; NULL if
 * none is open. */
const char *build_innermost(struct parser *parser, struct location *at);
/* Whether the word means something to the innermost open statement. */
bool build_claims(struct parser *parser, const struct name *word);
/* Whether any statement is called so or has such a parameter. */
bool build_knows(const char *word);

/* Around a value that a directive declares: the statement that the directive
 * happens to stand in is not around it. */
void build_suspend(struct parser *parser);
void build_resume(struct parser *parser);

/* A number or a string: the word before it takes it, or the statement. */
void build_argument(struct parser *parser, const struct value *value,
                    struct location at);
/* A word: of a parameter, of what is chosen for one, of a map. */
void build_word(struct parser *parser, const struct name *word,
                struct location at);
/* A word with the `count` values pushed last, in parentheses, and one behind
 * a colon, or NULL. */
void build_called(struct parser *parser, const struct name *word, int count,
                  const struct value *more, struct location at);
/* A value that an inner statement made, or that an identifier stands for. */
void build_apply(struct parser *parser, const struct value *value,
                 struct location at);
/* A texture and the one that is laid over it. */
struct value build_layer(struct parser *parser, const struct value *below,
                         const struct value *above, struct location at);

/* A pigment, pattern, spline or transform as a function of core; -1: an error,
 * reported or in `err`. */
int build_function(struct parser *parser, const struct value *value,
                   struct location at, struct brume_error *err);

/* What the language's functions ask of splines and objects. `type` may be
 * NULL: the spline's own. */
struct value build_spline_value(struct parser *parser,
                                const struct value *spline, int count,
                                const struct name *type, struct location at);
/* `inside`, `min_extent`, `max_extent`; point NULL: there is none. */
struct value build_object_value(struct parser *parser,
                                const struct name *function,
                                const struct value *object,
                                const struct value *point,
                                struct location at);
/* `normal` names the variable that the normal goes to, or is NULL. */
struct value build_trace(struct parser *parser, const struct value *object,
                         const struct value *from,
                         const struct value *direction,
                         const struct name *normal, struct location at);

/* Whether the statement that was just opened is a mesh or mesh2, which the
 * following calls are about. */
bool build_literal_begins(struct parser *parser);
/* Its lists are taken over from the frame before, */
void build_literal_take(struct parser *parser, const struct kept_mesh *kept);
/* or were read, and are to be kept. */
void build_literal_reached(struct parser *parser, struct kept_mesh *kept);

/* A value that stands on its own in the scene: an object, light, camera or
 * atmosphere is added, others have no effect there. */
void build_place(struct parser *parser, const struct value *value,
                 struct location at);

#endif
