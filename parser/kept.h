/* kept.h - texts of a film that do not change: their bytes, their tokens, and
 * the meshes that are spelt out in them, kept from frame to frame. */
#ifndef PARSER_KEPT_H
#define PARSER_KEPT_H
#include <sys/stat.h>
#include "lib/arena.h"
#include "parser/symbol.h"

struct chunk;
struct mesh;

/* What is spelt out in a mesh or mesh2, from behind its '{': lists of plain
 * numbers, that mean the same whatever the frame. */
struct kept_mesh {
    struct kept_mesh *next;         /* of its chunk                        */
    size_t first;                   /* its first token                     */
    struct chunk *end_chunk;        /* NULL: nothing that is worth it      */
    size_t end, passed;             /* the token behind; chunks between    */
    uint64_t tokens;                /* that the grammar was given          */
    struct mesh *mesh;              /* NULL: not read yet                  */
    size_t listed[3];               /* indices of faces, normals and uvs   */
    bool lists;                     /* and it has them                     */
    const char *lacks;
};

struct kept_text {
    struct kept_text *next;
    char *path;                     /* resolved                            */
    const char *given;              /* or the text that a stream gave      */
    struct stat was;
    char *text;
    size_t length, room;
    struct arena arena;             /* what its tokens name                */
    struct chunk *chunk;            /* its tokens, by chunk->after         */
    uint32_t source;                /* that they are labelled with         */
    size_t bytes;                   /* of text and tokens                  */
    bool scanned;                   /* to the end                          */
    bool tried;                     /* to be                               */
    bool used;                      /* by the scene that is read           */
};

struct kept {
    struct kept_text *text;
    struct arena arena;
    struct name_table names;        /* of all texts                        */
};

void kept_release(struct kept *kept);
/* A scene begins; at its end the texts that it did not use go. */
void kept_begin(struct kept *kept);
void kept_end(struct kept *kept);

/* A file's text, or a given one, as it is now; NULL: not there. */
struct kept_text *kept_find(struct kept *kept, const char *path,
                            const struct stat *now);
struct kept_text *kept_find_given(struct kept *kept, const char *given);
/* Takes the text over. NULL: it stays the caller's. */
struct kept_text *kept_add(struct kept *kept, const char *path,
                           const struct stat *was, const char *given,
                           char *text, size_t length, size_t room);

/* A chunk of the text's tokens, behind its others; NULL: no memory. */
struct chunk *kept_chunk(struct kept_text *text, struct chunk *last);
/* Labels the text's tokens as those of a source. */
void kept_label(struct kept_text *text, uint32_t source);

/* What begins at a token of a chunk that is kept, if it was looked at. */
struct kept_mesh *kept_mesh_find(struct chunk *chunk, size_t first);
/* NULL: no memory. */
struct kept_mesh *kept_mesh_add(struct chunk *chunk, size_t first);
#endif
