#include "parser/literal.h"
#include "parser/build.h"
#include "parser/kept.h"
#include <string.h>

/* ---- how far it goes ---------------------------------------------------- */

/* Between two tokens of a text that is kept. */
struct place {
    struct chunk *chunk;
    size_t token, passed;
};

/* The token at a place, which goes to the next chunk if need be. */
static const struct token *look(struct place *place)
{
    const struct token *token = &place->chunk->token[place->token];
    if (token->kind != TOK_MORE)
        return token;
    place->chunk = place->chunk->after;
    place->token = 0;
    place->passed++;
    return place->chunk->token;
}

/* A word of lists, or of one triangle. */
static bool is_list(const struct token *token)
{
    static const char *const words[] = {
        "vertex_vectors", "normal_vectors", "uv_vectors", "face_indices",
        "normal_indices", "uv_indices",     "triangle",   "smooth_triangle"};
    if (token->kind != TOK_WORD)
        return false;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(token->name->text, words[i]) == 0)
            return true;
    return false;
}

static bool is_plain(const struct token *token)
{
    switch (token->kind) {
    case TOK_DATA:
    case TOK_NUMBER:
    case '<':
    case '>':
    case ',':
    case '+':
    case '-':
        return true;
    default:
        return is_list(token); /* the uv_vectors of a triangle */
    }
}

/* Passes over `word { numbers }`; *bytes: about how long it is. */
static bool pass_list(struct place *place, size_t *bytes)
{
    if (!is_list(look(place)))
        return false;
    place->token++;
    if (look(place)->kind != '{')
        return false;
    for (place->token++; look(place)->kind != '}'; place->token++) {
        const struct token *token = look(place);
        if (!is_plain(token))
            return false;
        *bytes += token->kind == TOK_DATA ? token->data.length : 1;
    }
    place->token++;
    return true;
}

/* Where the lists that begin at the cursor end. */
static struct kept_mesh *measure(const struct cursor *cursor)
{
    enum { WORTH = 256 }; /* bytes */
    struct place place = {cursor->chunk, cursor->next, 0}, end = place;
    size_t bytes = 0;
    while (pass_list(&place, &bytes))
        end = place;
    struct kept_mesh *found = kept_mesh_add(cursor->chunk, cursor->next);
    if (!found || bytes < WORTH)
        return found;
    found->end_chunk = end.chunk;
    found->end = end.token;
    found->passed = end.passed;
    return found;
}

/* ---- taking and reading ------------------------------------------------- */

static bool is_there(const struct expander *expander,
                     const struct kept_mesh *mesh)
{
    const struct cursor *cursor = &expand_frame(expander)->cursor;
    return cursor->chunk == mesh->end_chunk && cursor->next == mesh->end &&
           !cursor->data;
}

/* The lists are passed over as if they had been read. */
static bool take(struct expander *expander, const struct kept_mesh *mesh)
{
    struct cursor *cursor = &expand_frame(expander)->cursor;
    cursor->chunk = mesh->end_chunk;
    cursor->passed += mesh->passed;
    cursor_jump(cursor, mesh->end);
    struct location at = token_location(&cursor->chunk->token[mesh->end - 1]);
    expander->pending[expander->pendings - 1].last = '}';
    expander->place = at;
    build_literal_take(expander->parser, mesh);
    expander->tokens += mesh->tokens;
    expander_spend(expander->parser, 1, at);
    return !expander->parser->failed;
}

static bool read(struct expander *expander, struct kept_mesh *mesh)
{
    uint64_t before = expander->tokens;
    while (!is_there(expander, mesh))
        if (!expand_step(expander))
            return false;
    mesh->tokens = expander->tokens - before;
    build_literal_reached(expander->parser, mesh);
    return true;
}

bool literal_run(struct expander *expander)
{
    const struct cursor *cursor = &expand_frame(expander)->cursor;
    struct chunk *chunk = cursor->chunk;
    if (!chunk->of || !chunk->of->scanned || expander->held || cursor->data)
        return true;
    struct kept_mesh *mesh = kept_mesh_find(chunk, cursor->next);
    if (!mesh)
        mesh = measure(cursor);
    if (!mesh || !mesh->end_chunk)
        return true;
    return mesh->mesh ? take(expander, mesh) : read(expander, mesh);
}
