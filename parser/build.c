#include "parser/build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/memory.h"
#include "lib/mesh.h"
#include "parser/builder.h"
#include "parser/eval.h"
#include "parser/report.h"

static const struct statement *const statements[BUILD_KINDS] = {
#define X(kind, name) [BUILD_##kind] = &build_statement_##name,
    BUILD_STATEMENTS(X)
#undef X
};

/* ---- the stack of open statements -------------------------------------- */

const struct statement *build_statement_of(const struct frame *frame)
{
    return statements[frame->kind];
}

/* NULL once the parse has failed, so that every call is safe after that. */
struct frame *build_top(struct parser *parser)
{
    struct builder *builder = parser->builder;

    if (parser->failed || !builder || builder->frames == 0)
        return NULL;
    return &builder->frame[builder->frames - 1];
}

struct frame *build_around(struct parser *parser)
{
    struct builder *builder = parser->builder;
    struct frame *around = builder->frame + builder->frames - 2;

    return builder->frames < 2 || around->kind == BUILD_KINDS ? NULL : around;
}

static bool make_room(struct parser *parser, struct location at)
{
    struct builder *builder = parser->builder;
    struct brume_error err = {0};
    struct frame *frames = memory_grow(builder->frame, &builder->frame_room,
                                       builder->frames + 1, sizeof *frames,
                                       &err);
    if (!frames)
        return parser_relay(parser, at, &err);
    builder->frame = frames;
    return true;
}

static struct frame *push(struct parser *parser, enum build_kind kind,
                          struct location at)
{
    struct builder *builder = parser->builder;

    if (parser->failed ||
        (builder->frames == builder->frame_room && !make_room(parser, at)))
        return NULL;
    struct frame *frame = &builder->frame[builder->frames++];
    *frame = (struct frame){.kind = kind, .at = at};
    return frame;
}

/* A frame of no kind parts the value from the statements around. */
void build_suspend(struct parser *parser)
{
    push(parser, BUILD_KINDS, (struct location){0});
}

void build_resume(struct parser *parser)
{
    if (!build_top(parser))
        return;
    parser->builder->frames--;
    parser->builder->fresh = NULL;
}

void *build_node(struct parser *parser, enum value_kind kind, size_t size)
{
    struct spare *node = parser->builder->spare[kind];

    if (!node)
        return parser_alloc(parser, size);
    parser->builder->spare[kind] = node->next;
    return memset(node, 0, size);
}

void build_give_up(struct parser *parser, enum value_kind kind, void *node)
{
    struct spare *spare = node;

    spare->next = parser->builder->spare[kind];
    parser->builder->spare[kind] = spare;
}

/* ---- maps -------------------------------------------------------------- */

static void move(struct parser *parser, struct frame *frame,
                 const transform *by, const char *word, struct location at)
{
    const struct statement *statement = build_statement_of(frame);

    if (statement->move)
        statement->move(parser, frame, by);
    else
        parser_error(parser, at, "'%s' cannot have '%s'", statement->word,
                     word);
}

static void warn_zero_scale(struct parser *parser, const struct value *factor,
                            struct location at)
{
    for (int i = 0; i < 3; i++)
        if (factor->v[i] == 0)
            parser_warn(parser, at, "scale of %c by 0 is taken as 1", "xyz"[i]);
}

static bool matrix_of(struct parser *parser, const struct value *number,
                      struct location at, transform *by)
{
    transform inverse;

    if (number->kind != VALUE_LIST || number->list->count != 12)
        return parser_error(parser, at, "a matrix has 12 numbers, not %d",
                            number->kind == VALUE_LIST ? number->list->count
                                                       : number->terms);
    *by = transform_matrix(number->list->term);
    return transform_inverse(by, &inverse) ||
           parser_error(parser, at, "this matrix has no inverse");
}

static bool map_of(struct parser *parser, const char *word,
                   const struct value *vector, struct location at,
                   transform *by)
{
    if (!strcmp(word, "matrix"))
        return matrix_of(parser, vector, at, by);
    if (vector->kind != VALUE_NUMBER)
        return parser_error(parser, at, "'%s' needs a vector, not %s", word,
                            value_name(vector));
    struct value v = value_promote(*vector, 3);
    if (!strcmp(word, "translate")) {
        *by = transform_translate(v.v);
    } else if (!strcmp(word, "rotate")) {
        *by = transform_rotate(v.v);
    } else {
        warn_zero_scale(parser, &v, at);
        *by = transform_scale(v.v);
    }
    return true;
}

/* `transform` has no number: what follows it is applied. */
static void apply_map(struct parser *parser, struct frame *frame,
                      const char *word, const struct value *value, int count,
                      struct location at)
{
    transform by;

    if (count > 0 && map_of(parser, word, value, at, &by))
        move(parser, frame, &by, word, at);
}

/* ---- what a word means ------------------------------------------------- */

static bool is_within(const struct statement *statement, enum build_kind kind)
{
    const enum build_kind *within = statement->within;

    if (statement->in_objects)
        return statements[kind]->makes == VALUE_OBJECT ||
               statements[kind]->makes == VALUE_LIGHT;

    for (; within && *within != BUILD_KINDS; within++)
        if (*within == kind)
            return true;
    return false;
}

/* Whether it stands inside of others only. */
static bool is_inner(const struct statement *statement)
{
    return statement->within || statement->in_objects;
}

static bool has_room(const struct frame *frame, enum value_kind kind)
{
    const struct statement *statement = build_statement_of(frame);

    return (kind == VALUE_TRANSFORM && statement->move) ||
           (kind != VALUE_NONE && statement->takes & BUILD_TAKES(kind));
}

/* The statement that a word begins in another one; BUILD_KINDS: where nothing
 * is open, or a declared value. A word of several statements means the one
 * that belongs there. BUILD_KINDS: it begins nothing. */
static enum build_kind kind_of(const char *word, enum build_kind around)
{
    enum build_kind found = BUILD_KINDS;

    for (int i = 0; i < BUILD_KINDS; i++) {
        enum build_kind kind = (enum build_kind)i;
        const char *begins = statements[i]->word;
        if (*begins != *word || strcmp(begins, word))
            continue;
        if (around != BUILD_KINDS && is_within(statements[i], around))
            return kind;
        if (!is_inner(statements[i]) || found == BUILD_KINDS)
            found = kind;
    }
    return found;
}

/* The maps that whatever can be moved takes. */
static const struct param move_rows[] = {
    PARAM_OWN("translate", 1, 1, 0), PARAM_OWN("rotate", 1, 1, 0),
    PARAM_OWN("scale", 1, 1, 0),     PARAM_OWN("matrix", 1, 1, 0),
    PARAM_OWN("transform", 0, 0, 0), {0}};

/* The row of a word, and the group that it is of; NULL: the statement's own. */
static const struct param *find_row(const struct statement *statement,
                                    const char *word,
                                    const struct param_group **of)
{
    const struct param *row = param_find(statement->params, word);
    const struct param_group *group = statement->groups;

    *of = NULL;
    for (; !row && group && group->rows; group++) {
        row = param_find(group->rows, word);
        *of = row ? group : NULL;
    }
    return row || !statement->move ? row : param_find(move_rows, word);
}

/* In a statement of the kind; BUILD_KINDS: where nothing is open. */
static const struct meaning *
meaning_of(struct parser *parser, const struct name *word, enum build_kind in)
{
    struct meaning *known =
        &parser->builder
             ->meaning[(word->hash + 37 * (unsigned)in) % BUILD_MEANINGS];

    if (known->word == word && known->in == in)
        return known;
    *known = (struct meaning){
        .word = word, .in = in, .begins = kind_of(word->text, in)};
    if (in != BUILD_KINDS)
        known->row = find_row(statements[in], word->text, &known->group);
    return known;
}

/* ---- statements begin and end ------------------------------------------- */

/* A statement that could stand alone, inside of one that has no room for it:
 * the end of that one may be missing. */
static void misplaced_statement(struct parser *parser,
                                const struct frame *around,
                                const struct statement *statement,
                                struct location at)
{
    char hint[128];
    const char *word = build_statement_of(around)->word;

    snprintf(hint, sizeof hint, "is a '}' missing? '%s' began in line %d", word,
             report_line(parser, around->at));
    /* A statement that begins a line goes on from there. */
    parser->brace_missing = report_begins_line(parser, at);
    parser_fail(parser, BRUME_ERR_SCENE, at, is_inner(statement) ? NULL : hint,
                "'%s' has no place in '%s'", statement->word, word);
}

/* Whether a statement may begin here; reported if not. */
static bool may_open(struct parser *parser, enum build_kind kind,
                     const char *word, struct location at)
{
    struct frame *around = build_top(parser);
    bool value = around && around->kind == BUILD_KINDS;

    if (kind == BUILD_KINDS)
        return report_unknown(
            parser, at, word,
            around && !value ? build_statement_of(around)->word : NULL);
    const struct statement *statement = statements[kind];
    if (around && !value) {
        if (is_within(statement, around->kind) ||
            (!is_inner(statement) && has_room(around, statement->makes)))
            return true;
        misplaced_statement(parser, around, statement, at);
        return false;
    }
    if (is_inner(statement))
        return parser_error(parser, at, "'%s' belongs into '%s'", word,
                            statement->in_objects
                                ? "object"
                                : statements[*statement->within]->word);
    return !value || statement->makes != VALUE_NONE ||
           parser_error(parser, at, "'%s' cannot be declared", word);
}

static void open(struct parser *parser, enum build_kind kind,
                 struct location at)
{
    const struct statement *statement = statements[kind];
    struct frame *frame = push(parser, kind, at);

    if (!frame)
        return;
    if (statement->size) {
        frame->node = build_node(parser, statement->makes, statement->size);
        if (!frame->node)
            return;
    }
    if (statement->open)
        statement->open(parser, frame);
}

static void finish_row(struct parser *parser, struct frame *frame);

/* What comes next is not for the word before it. */
static struct frame *settled(struct parser *parser)
{
    struct frame *frame = build_top(parser);

    if (frame && frame->row)
        finish_row(parser, frame);
    return parser->failed ? NULL : frame;
}

void build_open(struct parser *parser, const struct name *word,
                struct location at)
{
    const struct frame *around = settled(parser);

    if (parser->failed)
        return;
    enum build_kind in = around ? around->kind : BUILD_KINDS;
    enum build_kind kind = meaning_of(parser, word, in)->begins;
    if (may_open(parser, kind, word->text, at))
        open(parser, kind, at);
    else /* There is no frame for what its braces hold. */
        parser->failed = true;
}

void build_open_default(struct parser *parser, struct location at)
{
    open(parser, BUILD_DEFAULT, at);
}

void build_open_entry(struct parser *parser, struct location at)
{
    struct frame *frame = settled(parser);

    if (!frame)
        return;
    if (frame->kind == BUILD_KINDS || !build_statement_of(frame)->entry)
        parser_error(parser, at, "'[' has no place here");
    else
        open(parser, build_statement_of(frame)->entry, at);
}

struct value build_close(struct parser *parser, struct location at)
{
    struct frame *frame = settled(parser);

    if (!frame)
        return (struct value){.kind = VALUE_NONE};
    const struct statement *statement = build_statement_of(frame);
    if (frame->arguments < statement->needed) {
        parser_error(parser, at, "'%s' needs its %s before this",
                     statement->word,
                     statement->arguments[frame->arguments].word);
        return (struct value){.kind = VALUE_NONE};
    }
    if (statement->close)
        statement->close(parser, frame, at);
    void *node = frame->node;
    parser->builder->frames--;
    parser->builder->fresh = node;
    if (parser->failed || !node)
        return (struct value){.kind = VALUE_NONE};
    return value_node(statement->makes, node);
}

void build_close_entry(struct parser *parser, struct location at)
{
    build_close(parser, at);
}

const char *build_innermost(struct parser *parser, struct location *at)
{
    const struct frame *frame = build_top(parser);

    if (!frame || frame->kind == BUILD_KINDS)
        return NULL;
    *at = frame->at;
    return build_statement_of(frame)->word;
}

/* ---- what is said inside a statement ----------------------------------- */

void build_misplaced(struct parser *parser, const struct frame *frame,
                     const struct value *value, struct location at)
{
    parser_mistake(parser, at, "'%s' cannot have a %s",
                   build_statement_of(frame)->word, value_name(value));
}

/* Words that change nothing in the picture are told of once for each reason.
 */
void build_note(struct parser *parser, const char *word, const char *note,
                struct location at)
{
    struct builder *builder = parser->builder;

    for (int i = 0; i < builder->notes; i++)
        if (builder->note[i] == note)
            return;
    if (builder->notes < BUILD_NOTES)
        builder->note[builder->notes++] = note;
    parser_warn(parser, at, "'%s' has no effect: %s", word, note);
}

/* What an unknown word takes with it. */
static const struct param lost_row = {
    .word = "", .kind = PARAM_IGNORED, .most = PARAM_MOST};

static bool is_move(const struct param *row)
{
    return row >= move_rows && row < move_rows + 5;
}

/* Where what the open row sets lies. NULL: reported. */
static void *node_of(struct parser *parser, struct frame *frame,
                     const struct param_group *group)
{
    if (group && group->node)
        return group->node(parser, frame);
    return (char *)frame->node + (group ? group->offset : 0);
}

bool build_claims(struct parser *parser, const struct name *word)
{
    const struct frame *frame = build_top(parser);

    return frame && meaning_of(parser, word, frame->kind)->row;
}

/* A parameter was set: what follows from that. */
static void note_set(struct parser *parser, struct frame *frame,
                     const struct param_group *group, const struct param *row,
                     struct location at)
{
    const struct statement *statement = build_statement_of(frame);

    frame->given |= row->given;
    if (row->note)
        build_note(parser, row->word, row->note, at);
    if (group && group->set)
        group->set(parser, frame, row, at);
    else if (statement->set)
        statement->set(parser, frame, row, at);
}

bool build_knows(const char *word)
{
    const struct param_group *group;

    for (int i = 0; i < BUILD_KINDS; i++)
        if (!strcmp(statements[i]->word, word) ||
            find_row(statements[i], word, &group))
            return true;
    return false;
}

/* A row of PARAM_VALUES has all that it takes. */
static void hand_over(struct parser *parser, struct frame *frame,
                      const struct param *row, int count, struct location at)
{
    struct builder *builder = parser->builder;
    const struct statement *statement = build_statement_of(frame);
    const struct param_group *group = frame->group;

    frame->given |= row->given;
    if (count == 0)
        builder->value_at = at;
    if (group && group->values)
        group->values(parser, frame, row, builder->value, count, at);
    else
        statement->values(parser, frame, row, builder->value, count, at);
}

static void store(struct parser *parser, struct frame *frame,
                  const struct param *row, int count, struct location at)
{
    struct builder *builder = parser->builder;
    const struct param_group *group = frame->group;
    void *node = node_of(parser, frame, group);

    if (node && param_set(parser, row, node, at, builder->value, count,
                          builder->value_at))
        note_set(parser, frame, group, row, at);
}

/* A row's numbers are complete: stores them, or lets the statement do so. */
static void finish_row(struct parser *parser, struct frame *frame)
{
    struct builder *builder = parser->builder;
    const struct param *row = frame->row;
    struct location at = frame->row_at;
    int count = frame->values;

    frame->row = NULL;
    frame->values = 0;
    if (row->kind == PARAM_CHOICE) {
        param_choose(parser, row, NULL, NULL, at);
    } else if (count < param_least(row)) {
        parser_error(parser, at, "'%s' needs %s", row->word,
                     param_least(row) > 1 ? "more numbers" : "a number");
    } else if (is_move(row)) {
        apply_map(parser, frame, row->word, builder->value, count,
                  builder->value_at);
    } else if (row->kind == PARAM_VALUES) {
        hand_over(parser, frame, row, count, at);
    } else if (row != &lost_row) {
        store(parser, frame, row, count, at);
    }
}

static void choose(struct parser *parser, struct frame *frame,
                   const struct name *word, struct location at)
{
    const struct param *row = frame->row;
    const struct param_group *group = frame->group;

    frame->row = NULL;
    void *node = node_of(parser, frame, group);
    if (node && param_choose(parser, row, node, word->text, at))
        note_set(parser, frame, group, row, at);
}

void build_word(struct parser *parser, const struct name *word,
                struct location at)
{
    struct frame *frame = build_top(parser);

    if (frame && frame->row && frame->row->kind == PARAM_CHOICE) {
        choose(parser, frame, word, at);
        return;
    }
    frame = settled(parser);
    if (!frame)
        return;
    const struct statement *statement = build_statement_of(frame);
    const struct meaning *meaning = meaning_of(parser, word, frame->kind);
    const struct param *row = meaning->row;
    if (!row) {
        report_unknown(parser, at, word->text, statement->word);
        row = &lost_row;
    }
    if (!frame->node && !is_move(row) && row->kind != PARAM_VALUES) {
        parser_error(parser, at, "'%s' cannot have '%s' in a mesh",
                     statement->word, word->text);
        return;
    }
    frame->row = row;
    frame->group = meaning->group;
    frame->row_at = at;
    frame->values = 0;
    if (param_most(row) == 0 && row->kind != PARAM_CHOICE)
        finish_row(parser, frame);
}

/* Whether the open row has room for one more value of this kind. */
static bool row_takes(const struct frame *frame, const struct value *value)
{
    const struct param *row = frame->row;

    return row && frame->values < param_most(row) &&
           (value->kind != VALUE_STRING || row->kind == PARAM_VALUES ||
            row == &lost_row);
}

/* Whether there was room for one more. */
static bool set_argument(struct parser *parser, struct frame *frame,
                         const struct value *number, struct location at)
{
    const struct statement *statement = build_statement_of(frame);
    const struct param *row = statement->arguments + frame->arguments;

    if (!row->word)
        return parser_mistake(parser, at, "'%s' takes no more numbers here",
                              statement->word);
    param_set(parser, row, frame->node, at, number, 1, at);
    return true;
}

void build_argument(struct parser *parser, const struct value *value,
                    struct location at)
{
    struct frame *frame = build_top(parser);

    if (!frame)
        return;
    if (row_takes(frame, value)) {
        if (frame->values == 0)
            parser->builder->value_at = at;
        parser->builder->value[frame->values++] = *value;
        if (frame->values == param_most(frame->row))
            finish_row(parser, frame);
        return;
    }
    frame = settled(parser);
    if (!frame)
        return;
    const struct statement *statement = build_statement_of(frame);
    if (statement->argument)
        statement->argument(parser, frame, value, at);
    else if (statement->arguments && !set_argument(parser, frame, value, at))
        return;
    else if (!statement->arguments)
        build_misplaced(parser, frame, value, at);
    frame->arguments++;
}

/* ---- values ------------------------------------------------------------- */

void build_called(struct parser *parser, const struct name *word, int count,
                  const struct value *more, struct location at)
{
    const struct value *value = eval_pop(parser, count);

    build_word(parser, word, at);
    for (int i = 0; i < count && !parser->failed; i++)
        build_argument(parser, &value[i], at);
    if (more && !parser->failed)
        build_argument(parser, more, at);
}

/* Values that a statement around copies; it refers to others. */
static bool is_copied(enum value_kind kind)
{
    return kind == VALUE_PIGMENT || kind == VALUE_NORMAL ||
           kind == VALUE_FINISH || kind == VALUE_DENSITY ||
           kind == VALUE_TRANSFORM;
}

void build_apply(struct parser *parser, const struct value *value,
                 struct location at)
{
    struct frame *frame = settled(parser);

    if (!frame || value->kind == VALUE_NONE)
        return;
    if (value->kind == VALUE_TRANSFORM) {
        transform by = model_transform_result(value->node);
        move(parser, frame, &by, "transform", at);
    } else if (has_room(frame, value->kind)) {
        build_statement_of(frame)->apply(parser, frame, value, at);
    } else {
        build_misplaced(parser, frame, value, at);
    }
    if (value->node == parser->builder->fresh && is_copied(value->kind))
        build_give_up(parser, value->kind, value->node);
    parser->builder->fresh = NULL;
}

/* `inverse` counts once, however often it stands, and for the whole block. */
static void open_transform(struct parser *parser, struct frame *frame)
{
    struct transform_block *block = frame->node;

    (void)parser;
    block->by = transform_identity();
}

static void move_transform(struct parser *parser, struct frame *frame,
                           const transform *by)
{
    struct transform_block *block = frame->node;

    (void)parser;
    block->by = transform_then(&block->by, by);
}

static void close_transform(struct parser *parser, struct frame *frame,
                            struct location at)
{
    const struct transform_block *block = frame->node;
    transform inverse;

    if (block->inverse && !transform_inverse(&block->by, &inverse))
        parser_error(parser, at, "this transform has no inverse");
}

static const struct param transform_params[] = {
    PARAM_WORD("inverse", PARAM_MARK, 1, 0, struct transform_block, inverse),
    {0}};

const struct statement build_statement_transform = {
    .word = "transform",
    .makes = VALUE_TRANSFORM,
    .size = sizeof(struct transform_block),
    .params = transform_params,
    .open = open_transform,
    .move = move_transform,
    .close = close_transform,
};

/* ---- lifetime ---------------------------------------------------------- */

bool build_begin(struct parser *parser)
{
    struct builder *builder = parser_alloc(parser, sizeof *builder);

    if (!builder)
        return false;
    parser->builder = builder;
    builder->default_texture = model_default_texture;
    build_globals_start(&builder->globals);
    return true;
}

void build_reset(struct parser *parser)
{
    parser->builder->frames = 0;
    parser->builder->numbers = 0;
    parser->builder->fresh = NULL;
}

void build_release(struct parser *parser)
{
    struct builder *builder = parser->builder;

    if (!builder)
        return;
    for (struct model_mesh *m = builder->meshes; m; m = m->next)
        mesh_free(m->mesh);
    for (int i = 0; i < 3; i++)
        free(builder->indices[i].item);
    free(builder->number);
    free(builder->part);
    free(builder->frame);
    free(builder->placing);
    parser->builder = NULL;
}
