/* item.c - items of arrays, and whether something is declared.
 *
 * The kind of an item is known only once its indices are, and the grammar
 * wants a token of that kind: so items are found before the grammar. */
#include "parser/expand.h"
#include "parser/report.h"
#include <ctype.h>
#include <math.h>

static bool begin_index(struct expander *expander, const struct seek *seek,
                        struct location at)
{
    struct pending *pending = expand_begin(expander, TOK_MODE_INDEX, USE_INDEX,
                                           at);
    if (pending) {
        pending->seek = *seek;
    }
    return pending;
}

/* ---- what an item is wanted for ---------------------------------------- */

static bool use_defined(struct expander *expander, const struct seek *seek,
                        bool defined, struct location at)
{
    struct value answer = value_float(defined);
    if (!expand_need(expander, ')')) {
        return false;
    }
    if (seek->use == ITEM_IFDEF) {
        return branch_ifdef(expander, seek->opener, defined);
    }
    expand_hold(expander, &answer, at);
    return true;
}

static bool found(struct expander *expander, const struct seek *seek,
                  struct location at)
{
    bool set = seek->item->kind != VALUE_NONE;
    switch (seek->use) {
    case ITEM_DECLARE:
        return directive_declare_item(expander, seek->item, at);
    case ITEM_DEFINED:
    case ITEM_IFDEF:
        return use_defined(expander, seek, set, at);
    case ITEM_UNDEF:
        seek->item->kind = VALUE_NONE;
        expand_take(expander, ';');
        return true;
    case ITEM_READ:
        return fileio_item(expander, seek, at);
    case ITEM_ARGUMENT:
        return set ? macro_item(expander, seek->item, at)
                   : parser_error(expander->parser, at,
                                  "this item of the array is not set");
    default:
        break;
    }
    if (!set) {
        return parser_error(expander->parser, at,
                            "this item of the array is not set");
    }
    expand_hold(expander, seek->item, at);
    return true;
}

/* ---- indices ----------------------------------------------------------- */

/* Takes one index into account; false: out of range. */
static bool add_index(struct expander *expander, struct seek *seek,
                      double number, struct location at)
{
    const struct array *array = seek->item->array;
    double index = trunc(number);
    uint32_t size = array->size[seek->dimension];
    if (!(index >= 0 && index < size)) {
        return parser_error(expander->parser, at,
                            "index %g is out of range: "
                            "dimension %d of the array has %u items, from 0",
                            index, seek->dimension + 1, size);
    }
    seek->offset = seek->offset * size + (uint32_t)index;
    seek->dimension++;
    if (seek->dimension == array->rank) {
        seek->item = &array->item[seek->offset];
        seek->dimension = 0;
        seek->offset = 0;
    }
    return true;
}

/* Whether one more index must follow, or may: an item may be an array. */
static bool has_more(struct expander *expander, const struct seek *seek)
{
    return seek->dimension > 0 || (seek->item->kind == VALUE_ARRAY &&
                                   expand_peek(expander)->kind == '[');
}

/* Where the end of the item may lead to the next item of a list, indices are
 * left to the grammar, so that nothing recurses over the list. */
static bool is_alone(const struct seek *seek)
{
    return seek->use != ITEM_ARGUMENT && seek->use != ITEM_READ;
}

bool item_seek(struct expander *expander, const struct seek *begun,
               struct location at)
{
    struct seek seek = *begun;
    do {
        double index;
        const struct token *end = is_alone(&seek) ? expand_scalar(expander, '[',
                                                                  false, &index)
                                                  : NULL;
        if (!end || end->kind != ']') {
            return begin_index(expander, &seek, at);
        }
        if (!expand_skip_to(expander, end + 1) ||
            !add_index(expander, &seek, index, at)) {
            return false;
        }
    } while (has_more(expander, &seek));
    return found(expander, &seek, at);
}

bool item_finish(struct expander *expander, const struct pending *pending)
{
    struct seek seek = pending->seek;
    if (!expand_return(expander, pending->frames, pending->at) ||
        !add_index(expander, &seek, expander->result.v[0], pending->at)) {
        return false;
    }
    return has_more(expander, &seek) ? item_seek(expander, &seek, pending->at)
                                     : found(expander, &seek, pending->at);
}

/* Takes a word of the language, which is never defined. */
static bool take_reserved(struct expander *expander)
{
    const struct token *token = expand_peek(expander);
    const char *word = report_spelling(expander->parser, token_location(token));
    return token->kind != TOK_IDENTIFIER && token->kind != TOK_END &&
           isalpha((unsigned char)*word) && expand_take(expander, token->kind);
}

bool item_defined(struct expander *expander, enum item_use use, uint32_t opener,
                  struct location at)
{
    struct seek seek = {.use = use, .opener = opener};
    if (!expand_need(expander, '(')) {
        return false;
    }
    if (take_reserved(expander)) {
        return use_defined(expander, &seek, false, at);
    }
    struct name *name = expand_need_name(expander);
    if (!name) {
        return false;
    }
    seek.item = symbols_find(name);
    if (expand_peek(expander)->kind != '[') {
        bool defined = seek.item && !name->symbol->reserved;
        return use_defined(expander, &seek, defined, at);
    }
    if (!seek.item || seek.item->kind != VALUE_ARRAY) {
        return parser_error(expander->parser, at, "'%.40s' is not an array",
                            name->text);
    }
    return item_seek(expander, &seek, at);
}
