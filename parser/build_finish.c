/* build_finish.c - finish, and the statements inside of it. */
#include <string.h>

#include "parser/builder.h"

/* `albedo` stands between one of these words and its number. */
enum { WORD_DIFFUSE = 1, WORD_PHONG, WORD_SPECULAR, WORD_ALBEDO };

static const char interior_note[] = "it belongs into 'interior'";

#define FINISH(word, kind, start, low, open)                                   \
    PARAM_ROW(#word, kind, start, low, INFINITY, open, 0, struct finish, word)

const struct param build_finish_params[] = {
    FINISH(ambient, PARAM_RGB, 0.1, -INFINITY, 0),
    FINISH(emission, PARAM_RGB, 0, -INFINITY, 0),
    PARAM_OWN("diffuse", 0, 2, WORD_DIFFUSE),
    PARAM_OWN("phong", 0, 1, WORD_PHONG),
    PARAM_OWN("specular", 0, 1, WORD_SPECULAR),
    PARAM_OWN("albedo", 1, 2, WORD_ALBEDO),
    FINISH(brilliance, PARAM_FLOAT, 1, 0, 0),
    FINISH(phong_size, PARAM_FLOAT, 40, 0, 0),
    FINISH(roughness, PARAM_FLOAT, 0.05, 0, PARAM_ABOVE),
    FINISH(crand, PARAM_FLOAT, 0, 0, 0),
    {.word = "metallic",
     .kind = PARAM_FLOAT,
     .high = 1,
     .alone = 1,
     .offset = offsetof(struct finish, metallic)},
    PARAM_WORD("conserve_energy", PARAM_SWITCH, 1, 0, struct finish,
               conserve_energy),
    PARAM_ANY("reflection_exponent", PARAM_FLOAT, 1, 0, struct finish,
              reflection.exponent),
    PARAM_OWN("reflection", 1, 1, 0),
    PARAM_WITHOUT("ior", interior_note),
    PARAM_WITHOUT("refraction", interior_note),
    PARAM_WITHOUT("caustics", interior_note),
    PARAM_WITHOUT("fade_power", interior_note),
    PARAM_WITHOUT("fade_distance", interior_note),
    {0}};

static const struct param albedo_rows[] = {
    [WORD_DIFFUSE] = PARAM_ROW("diffuse", PARAM_PAIR, 0, 0, INFINITY, 0, 0,
                               struct finish, diffuse),
    [WORD_PHONG] = PARAM_ROW("phong", PARAM_FLOAT, 0, 0, INFINITY, 0, 0,
                             struct finish, phong),
    [WORD_SPECULAR] = PARAM_ROW("specular", PARAM_FLOAT, 0, 0, INFINITY, 0, 0,
                                struct finish, specular)};

static const struct param reflection_color = PARAM_ANY(
    "reflection", PARAM_RGB, 0, 0, struct finish, reflection.high);

static void open_finish(struct parser *parser, struct frame *frame)
{
    transform by;

    *(struct finish *)frame->node = build_texture_around(parser, &by)->finish;
}

static void apply_finish(struct parser *parser, struct frame *frame,
                         const struct value *value, struct location at)
{
    if (value->kind == VALUE_FINISH)
        *(struct finish *)frame->node = *(const struct finish *)value->node;
    else
        build_misplaced(parser, frame, value, at);
}

static void set_albedo(struct finish *finish, int id, bool albedo)
{
    if (id == WORD_DIFFUSE)
        finish->diffuse_albedo = albedo;
    else if (id == WORD_PHONG)
        finish->phong_albedo = albedo;
    else
        finish->specular_albedo = albedo;
}

/* The number of `diffuse`, `phong` or `specular`, maybe behind `albedo`. */
static void set_strength(struct parser *parser, struct frame *frame,
                         const struct param *row, const struct value *value,
                         int count, struct location at)
{
    const struct param *of = row->id == WORD_ALBEDO ? frame->open : row;

    if (of && of->id == WORD_ALBEDO)
        of = NULL;
    frame->open = NULL;
    if (!of || count == 0) {
        if (of)
            frame->open = row;
        else
            parser_mistake(parser, at,
                           "'albedo' belongs behind 'diffuse', "
                           "'phong' or 'specular'");
        return;
    }
    set_albedo(frame->node, of->id, row->id == WORD_ALBEDO);
    param_set(parser, &albedo_rows[of->id], frame->node, at, value, count,
              parser->builder->value_at);
}

static void finish_values(struct parser *parser, struct frame *frame,
                          const struct param *row, const struct value *value,
                          int count, struct location at)
{
    struct finish *finish = frame->node;

    if (row->id != 0) {
        set_strength(parser, frame, row, value, count, at);
        return;
    }
    param_set(parser, &reflection_color, finish, at, value, 1,
              parser->builder->value_at);
    memcpy(finish->reflection.low, finish->reflection.high,
           sizeof finish->reflection.low);
    finish->reflection.fresnel = false;
    finish->reflection.falloff = 1;
    finish->reflection.metallic = 0;
}

static void close_finish(struct parser *parser, struct frame *frame,
                         struct location at)
{
    if (frame->open)
        parser_mistake(parser, at, "'%s' needs a number", frame->open->word);
}

const struct statement build_statement_finish = {
    .word = "finish",
    .makes = VALUE_FINISH,
    .takes = BUILD_TAKES(VALUE_FINISH),
    .size = sizeof(struct finish),
    .params = build_finish_params,
    .open = open_finish,
    .apply = apply_finish,
    .values = finish_values,
    .close = close_finish,
};

/* ---- reflection -------------------------------------------------------- */

static const enum build_kind in_finish[] = {BUILD_FINISH, BUILD_KINDS};

const struct param build_reflection_params[] = {
    PARAM_ANY("falloff", PARAM_FLOAT, 1, 0, struct reflection, falloff),
    PARAM_ANY("exponent", PARAM_FLOAT, 1, 0, struct reflection, exponent),
    {.word = "metallic",
     .kind = PARAM_FLOAT,
     .low = -INFINITY,
     .high = INFINITY,
     .alone = 1,
     .offset = offsetof(struct reflection, metallic)},
    PARAM_WORD("fresnel", PARAM_SWITCH, 1, 0, struct reflection, fresnel),
    {0}};

static const struct param reflection_arguments[] = {
    PARAM_ANY("lowest reflection", PARAM_RGB, 0, 0, struct reflection, low),
    PARAM_ANY("highest reflection", PARAM_RGB, 0, 0, struct reflection, high),
    {0}};

static void open_reflection(struct parser *parser, struct frame *frame)
{
    (void)parser;
    param_defaults(build_reflection_params, frame->node);
}

static void close_reflection(struct parser *parser, struct frame *frame,
                             struct location at)
{
    struct finish *finish = build_around(parser)->node;
    struct reflection *reflection = frame->node;

    (void)at;
    if (frame->arguments == 1)
        memcpy(reflection->high, reflection->low, sizeof reflection->high);
    finish->reflection = *reflection;
}

const struct statement build_statement_reflection = {
    .word = "reflection",
    .within = in_finish,
    .size = sizeof(struct reflection),
    .params = build_reflection_params,
    .arguments = reflection_arguments,
    .needed = 1,
    .open = open_reflection,
    .close = close_reflection,
};

/* ---- irid and subsurface: their node is the finish ---------------------- */

static void open_inside(struct parser *parser, struct frame *frame)
{
    frame->node = build_around(parser)->node;
}

static const struct param irid_params[] = {
    PARAM_ANY("thickness", PARAM_FLOAT, 0, 0, struct finish, irid_thickness),
    PARAM_ANY("turbulence", PARAM_FLOAT, 0, 0, struct finish, irid_turbulence),
    {0}};
static const struct param irid_arguments[] = {
    PARAM_ANY("amount", PARAM_FLOAT, 0, 0, struct finish, irid), {0}};

const struct statement build_statement_irid = {
    .word = "irid",
    .within = in_finish,
    .params = irid_params,
    .arguments = irid_arguments,
    .needed = 1,
    .open = open_inside,
};

static const struct param subsurface_params[] = {
    PARAM_ROW("translucency", PARAM_RGB, 0, 0, INFINITY, 0, 0, struct finish,
              translucency),
    {0}};

static void close_subsurface(struct parser *parser, struct frame *frame,
                             struct location at)
{
    struct finish *finish = frame->node;

    (void)parser;
    (void)at;
    finish->subsurface = true;
}

const struct statement build_statement_subsurface = {
    .word = "subsurface",
    .within = in_finish,
    .params = subsurface_params,
    .open = open_inside,
    .close = close_subsurface,
};
