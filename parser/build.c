#include "parser/build.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "lib/memory.h"
#include "lib/mesh.h"
#include "parser/builder.h"

/* By enum build_kind. */
static const struct statement *const statements[BUILD_KINDS] = {
    [BUILD_CAMERA] = &build_statement_camera,
    [BUILD_LIGHT] = &build_statement_light,
    [BUILD_SPHERE] = &build_statement_sphere,
    [BUILD_BOX] = &build_statement_box,
    [BUILD_CYLINDER] = &build_statement_cylinder,
    [BUILD_CONE] = &build_statement_cone,
    [BUILD_PLANE] = &build_statement_plane,
    [BUILD_DISC] = &build_statement_disc,
    [BUILD_TRIANGLE] = &build_statement_triangle,
    [BUILD_SMOOTH_TRIANGLE] = &build_statement_smooth_triangle,
    [BUILD_MESH] = &build_statement_mesh,
    [BUILD_MESH2] = &build_statement_mesh2,
    [BUILD_UNION] = &build_statement_union,
    [BUILD_OBJECT] = &build_statement_object,
    [BUILD_VERTEX_VECTORS] = &build_statement_vertex_vectors,
    [BUILD_NORMAL_VECTORS] = &build_statement_normal_vectors,
    [BUILD_UV_VECTORS] = &build_statement_uv_vectors,
    [BUILD_FACE_INDICES] = &build_statement_face_indices,
    [BUILD_NORMAL_INDICES] = &build_statement_normal_indices,
    [BUILD_UV_INDICES] = &build_statement_uv_indices,
    [BUILD_PIGMENT] = &build_statement_pigment,
    [BUILD_FINISH] = &build_statement_finish,
    [BUILD_TEXTURE] = &build_statement_texture,
    [BUILD_MATERIAL] = &build_statement_material,
    [BUILD_INTERIOR] = &build_statement_interior,
    [BUILD_MEDIA] = &build_statement_media,
    [BUILD_SCATTERING] = &build_statement_scattering,
    [BUILD_DENSITY] = &build_statement_density,
    [BUILD_FIRE] = &build_statement_fire,
    [BUILD_TEMPERATURE] = &build_statement_temperature,
    [BUILD_AMOUNT] = &build_statement_amount,
    [BUILD_TRANSFORM] = &build_statement_transform,
    [BUILD_BACKGROUND] = &build_statement_background,
    [BUILD_GLOBAL_SETTINGS] = &build_statement_global_settings,
    [BUILD_TRANSPORT] = &build_statement_transport,
    [BUILD_DEFAULT] = &build_statement_default,
};

/* ---- the stack of open statements -------------------------------------- */

static const struct statement *statement_of(const struct frame *frame)
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

static struct frame *push(struct parser *parser, enum build_kind kind,
                          struct location at)
{
    struct builder *builder = parser->builder;
    struct brume_error err = {0};

    if (parser->failed)
        return NULL;
    struct frame *frames = memory_grow(builder->frame, &builder->frame_room,
                                       builder->frames + 1, sizeof *frames,
                                       &err);
    if (!frames) {
        parser_relay(parser, at, &err);
        return NULL;
    }
    builder->frame = frames;
    frames[builder->frames] = (struct frame){.kind = kind, .at = at};
    return &frames[builder->frames++];
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

/* BUILD_KINDS for a word that begins nothing. */
static enum build_kind kind_of(const char *word)
{
    int kind = 0;

    while (kind < BUILD_KINDS && strcmp(statements[kind]->word, word))
        kind++;
    return (enum build_kind)kind;
}

void build_open(struct parser *parser, const char *word, struct location at)
{
    enum build_kind kind = kind_of(word);

    assert(kind < BUILD_KINDS);
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

struct value build_close(struct parser *parser, struct location at)
{
    struct frame *frame = build_top(parser);

    if (!frame)
        return (struct value){.kind = VALUE_NONE};
    const struct statement *statement = statement_of(frame);
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

const char *build_innermost(struct parser *parser, struct location *at)
{
    const struct frame *frame = build_top(parser);

    if (!frame || frame->kind == BUILD_KINDS)
        return NULL;
    *at = frame->at;
    return statement_of(frame)->word;
}

/* ---- what is said inside a statement ----------------------------------- */

void build_misplaced(struct parser *parser, const struct frame *frame,
                     const struct value *value, struct location at)
{
    parser_error(parser, at, "'%s' cannot have a %s", statement_of(frame)->word,
                 value_name(value));
}

static void set_argument(struct parser *parser, struct frame *frame,
                         const struct value *number, struct location at)
{
    const struct statement *statement = statement_of(frame);
    const struct param *row = statement->arguments + frame->arguments;

    if (!row->word) {
        parser_error(parser, at, "'%s' takes no more numbers here",
                     statement->word);
        return;
    }
    param_set(parser, row, frame->node, at, number, 1, at);
}

void build_argument(struct parser *parser, const struct value *number,
                    struct location at)
{
    struct frame *frame = build_top(parser);

    if (!frame)
        return;
    const struct statement *statement = statement_of(frame);
    if (statement->argument)
        statement->argument(parser, frame, number, at);
    else if (statement->arguments)
        set_argument(parser, frame, number, at);
    else
        build_misplaced(parser, frame, number, at);
    frame->arguments++;
}

/* A word that changes nothing in the picture is told of once. */
static void note_once(struct parser *parser, const struct param *row,
                      struct location at)
{
    struct builder *builder = parser->builder;

    for (int i = 0; i < builder->notes; i++)
        if (builder->note[i] == row->note)
            return;
    if (builder->notes < BUILD_NOTES)
        builder->note[builder->notes++] = row->note;
    parser_warn(parser, at, "'%s' has no effect: %s", row->word, row->note);
}

/* The row of a word, NULL where it can't stand; a triangle within a mesh is
 * nothing of its own. */
static const struct param *find_param(struct parser *parser,
                                      const struct frame *frame,
                                      const struct name *word,
                                      struct location at)
{
    const struct statement *statement = statement_of(frame);
    const struct param *row = param_find(statement->params, word->text);

    if (row && frame->node)
        return row;
    parser_error(parser, at, "'%s' cannot have '%s'%s", statement->word,
                 word->text, row ? " in a mesh" : "");
    return NULL;
}

static void note_set(struct parser *parser, struct frame *frame,
                     const struct param *row, struct location at)
{
    frame->given |= row->given;
    if (row->note)
        note_once(parser, row, at);
    if (statement_of(frame)->set)
        statement_of(frame)->set(parser, frame, row, at);
}

void build_set(struct parser *parser, const struct name *word,
               struct location at, const struct value *number, int count,
               struct location number_at)
{
    struct frame *frame = build_top(parser);
    const struct param *row = frame ? find_param(parser, frame, word, at)
                                    : NULL;

    if (row &&
        param_set(parser, row, frame->node, at, number, count, number_at))
        note_set(parser, frame, row, at);
}

void build_word(struct parser *parser, const struct name *word,
                struct location at)
{
    build_set(parser, word, at, NULL, 0, at);
}

void build_choose(struct parser *parser, const struct name *word,
                  const struct name *choice, struct location at)
{
    struct frame *frame = build_top(parser);
    const struct param *row = frame ? find_param(parser, frame, word, at)
                                    : NULL;

    if (row && param_choose(parser, row, frame->node, choice->text, at))
        note_set(parser, frame, row, at);
}

void build_later(struct parser *parser, const struct name *word,
                 struct location at)
{
    parser_error(parser, at, "'%s' is not supported yet", word->text);
}

/* ---- maps -------------------------------------------------------------- */

static void move(struct parser *parser, struct frame *frame,
                 const transform *by, const char *word, struct location at)
{
    const struct statement *statement = statement_of(frame);

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

void build_move(struct parser *parser, const char *word,
                const struct value *vector, struct location at)
{
    struct frame *frame = build_top(parser);
    transform by;

    if (!frame)
        return;
    if (vector->kind != VALUE_NUMBER) {
        parser_error(parser, at, "'%s' needs a vector, not %s", word,
                     value_name(vector));
        return;
    }
    struct value v = value_promote(*vector, 3);
    if (!strcmp(word, "translate")) {
        by = transform_translate(v.v);
    } else if (!strcmp(word, "rotate")) {
        by = transform_rotate(v.v);
    } else {
        warn_zero_scale(parser, &v, at);
        by = transform_scale(v.v);
    }
    move(parser, frame, &by, word, at);
}

void build_matrix(struct parser *parser, const struct value *number, int count,
                  struct location at)
{
    struct frame *frame = build_top(parser);
    double v[12];

    if (!frame)
        return;
    if (count != 12) {
        parser_error(parser, at, "a matrix has 12 numbers, not %d", count);
        return;
    }
    for (int i = 0; i < 12; i++)
        v[i] = number[i].v[0];
    transform by = transform_matrix(v), inverse;
    if (!transform_inverse(&by, &inverse)) {
        parser_error(parser, at, "this matrix has no inverse");
        return;
    }
    move(parser, frame, &by, "matrix", at);
}

/* Values that a statement around copies; it refers to others. */
static bool is_copied(enum value_kind kind)
{
    return kind == VALUE_PIGMENT || kind == VALUE_FINISH ||
           kind == VALUE_DENSITY || kind == VALUE_TRANSFORM;
}

void build_apply(struct parser *parser, const struct value *value,
                 struct location at)
{
    struct frame *frame = build_top(parser);

    if (!frame || value->kind == VALUE_NONE)
        return;
    if (value->kind == VALUE_TRANSFORM) {
        transform by = model_transform_result(value->node);
        move(parser, frame, &by, "transform", at);
    } else if (statement_of(frame)->apply) {
        statement_of(frame)->apply(parser, frame, value, at);
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

void build_release(struct parser *parser)
{
    struct builder *builder = parser->builder;

    if (!builder)
        return;
    for (struct model_mesh *m = builder->meshes; m; m = m->next)
        mesh_free(m->mesh);
    for (int i = 0; i < 3; i++)
        free(builder->indices[i].item);
    free(builder->frame);
    free(builder->placing);
    parser->builder = NULL;
}
