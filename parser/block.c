#include "parser/block.h"
#include "lib/memory.h"
#include "parser/grammar.h"
#include <stdlib.h>

/* A block that is open at some place of the text. */
struct open_block {
    uint32_t opener; /* its first directive                         */
    uint32_t last;   /* its latest one                              */
    uint32_t breaks; /* opener of the innermost block here that #break
                               leaves; 0: none (token 0 opens as 0 + 1)    */
};

static bool opens(int kind)
{
    return kind == TOK_HASH_IF || kind == TOK_HASH_IFDEF ||
           kind == TOK_HASH_IFNDEF || kind == TOK_HASH_SWITCH ||
           kind == TOK_HASH_WHILE || kind == TOK_HASH_FOR ||
           kind == TOK_HASH_MACRO;
}

static bool is_if(int kind)
{
    return kind == TOK_HASH_IF || kind == TOK_HASH_IFDEF ||
           kind == TOK_HASH_IFNDEF;
}

static void set_bad(struct token *token, const char *error)
{
    token->kind = TOK_BAD;
    token->error = error;
}

static struct open_block *innermost(struct linker *linker)
{
    return linker->count ? &linker->open[linker->count - 1] : NULL;
}

static bool link_opener(struct linker *linker, struct parser *parser,
                        const struct token *token, uint32_t index)
{
    struct brume_error err = {0};
    struct open_block *around = innermost(linker);
    uint32_t breaks = around ? around->breaks : 0;
    struct open_block *grown = memory_grow(
        linker->open, &linker->room, linker->count + 1, sizeof *grown, &err);
    if (!grown) {
        return parser_relay(parser, token_location(&token[index]), &err);
    }
    linker->open = grown;
    if (!is_if(token[index].kind)) {
        breaks = index + 1;
    }
    grown[linker->count++] = (struct open_block){index, index, breaks};
    return true;
}

/* A directive inside of a block; `fits`: it may follow the latest one. */
static void link_inner(struct linker *linker, struct token *token,
                       uint32_t index, bool fits, const char *error)
{
    struct open_block *block = innermost(linker);
    if (!fits) {
        set_bad(&token[index], error);
        return;
    }
    token[block->last].block.next = index;
    token[index].block.pair = block->opener;
    block->last = index;
}

static void link_end(struct linker *linker, struct token *token, uint32_t index)
{
    struct open_block *block = innermost(linker);
    link_inner(linker, token, index, block, "#end closes nothing");
    if (block) {
        token[block->opener].block.pair = index;
        linker->count--;
    }
}

static void link_break(struct linker *linker, struct token *token,
                       uint32_t index)
{
    struct open_block *block = innermost(linker);
    if (!block || !block->breaks) {
        set_bad(&token[index], "#break outside of a loop, #switch or #macro");
        return;
    }
    token[index].block.pair = block->breaks - 1;
}

bool block_link(struct linker *linker, struct parser *parser,
                struct token *token, uint32_t index)
{
    int kind = token[index].kind;
    if (opens(kind)) {
        return link_opener(linker, parser, token, index);
    }
    struct open_block *block = innermost(linker);
    int opener = block ? token[block->opener].kind : 0;
    bool after_else = block && token[block->last].kind == TOK_HASH_ELSE;
    bool in_if = is_if(opener) && !after_else;
    bool in_switch = opener == TOK_HASH_SWITCH && !after_else;
    switch (kind) {
    case TOK_HASH_ELSE:
        link_inner(linker, token, index, in_if || in_switch,
                   "#else without an #if or #switch");
        break;
    case TOK_HASH_ELSEIF:
        link_inner(linker, token, index, in_if, "#elseif without an #if");
        break;
    case TOK_HASH_CASE:
        link_inner(linker, token, index, in_switch, "#case without a #switch");
        break;
    case TOK_HASH_RANGE:
        link_inner(linker, token, index, in_switch, "#range without a #switch");
        break;
    case TOK_HASH_BREAK:
        link_break(linker, token, index);
        break;
    case TOK_HASH_END:
        link_end(linker, token, index);
        break;
    default:
        break;
    }
    return true;
}
