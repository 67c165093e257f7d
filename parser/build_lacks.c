/* build_lacks.c - what the language has and the picture does not yet show,
 * gathered from what is really placed and told once, at the end. */
#include <stdio.h>
#include <string.h>

#include "parser/builder.h"

void build_lacks(struct parser *parser, const char *what, struct location at)
{
    struct builder *builder = parser->builder;

    for (int i = 0; i < builder->lacked; i++)
        if (!strcmp(builder->lack[i], what))
            return;
    if (builder->lacked == BUILD_LACKS)
        return;
    if (builder->lacked == 0)
        builder->lacks_at = at;
    builder->lack[builder->lacked++] = what;
}

static bool is_colored(const double color[3])
{
    return color[0] != 0 || color[1] != 0 || color[2] != 0;
}

static void lacks_of_finish(struct parser *parser, const struct finish *finish,
                            struct location at)
{
    const struct {
        bool given;
        const char *what;
    } row[] = {
        {is_colored(finish->reflection.low) ||
             is_colored(finish->reflection.high),
         "reflection"},
        {finish->irid != 0, "iridescence"},
        {finish->subsurface && is_colored(finish->translucency),
         "light below surfaces"},
        {finish->crand != 0, "crand"},
        {finish->diffuse[1] != 0, "diffuse light from behind"},
        {finish->diffuse_albedo || finish->phong_albedo ||
             finish->specular_albedo,
         "albedo"},
    };

    for (size_t i = 0; i < sizeof row / sizeof *row; i++)
        if (row[i].given)
            build_lacks(parser, row[i].what, at);
}

static bool has_pattern(const struct patterned *on)
{
    return on->pattern && on->pattern->kind != PATTERN_NONE;
}

static void lacks_of_texture(struct parser *parser,
                             const struct texture *texture, struct location at)
{
    if (texture->below && surface_is_varied(texture))
        build_lacks(parser, "the finishes of lower layers", at);
    for (; texture; texture = texture->below) {
        if (has_pattern(&texture->on) && texture->varied)
            build_lacks(parser, "finishes and normals by patterns", at);
        if (has_pattern(&texture->normal.on))
            build_lacks(parser, "normals", at);
        lacks_of_finish(parser, &texture->finish, at);
    }
}

/* What bends light shows only where light comes in. */
static void lacks_of_interior(struct parser *parser,
                              const struct interior *interior, bool opaque,
                              struct location at)
{
    if (opaque)
        return;
    if (interior->ior != 1)
        build_lacks(parser, "refraction", at);
    if (interior->dispersion != 1)
        build_lacks(parser, "dispersion", at);
    if (interior->caustics != 0)
        build_lacks(parser, "caustics", at);
    if (interior->fade_power != 0 && interior->fade_distance != 0)
        build_lacks(parser, "fading in interiors", at);
}

void build_lacks_of(struct parser *parser, const struct object *object,
                    const struct texture *texture,
                    const struct interior *interior)
{
    parser->builder->placed_at = object->at;
    lacks_of_texture(parser, texture, object->at);
    if (object->inner.what)
        build_lacks(parser, "interior textures", object->at);
    if (interior)
        lacks_of_interior(parser, interior, model_is_opaque(texture),
                          object->at);
}

void build_report_lacks(struct parser *parser)
{
    const struct builder *builder = parser->builder;
    char text[400];
    size_t used = 0;

    for (int i = 0; i < builder->lacked && used < sizeof text; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s",
                                 i > 0 ? ", " : "", builder->lack[i]);
    if (used > 0)
        parser_warn(parser, builder->lacks_at,
                    "this picture lacks what is not drawn yet: %s", text);
}
