/* build_send.c - what objects wear and hold to core: equal things once. */
#include <string.h>

#include "parser/builder.h"

enum { SENT_MATERIAL, SENT_FIELD, SENT_MEDIUM, SENT_INTERIOR };

static int remember(struct parser *parser, int what,
                    const struct intern_key *key, int id)
{
    if (id >= 0)
        intern_keep(&parser->builder->intern[what], &parser->arena, key, id);
    return id;
}

static int sent(struct parser *parser, int what, const struct intern_key *key)
{
    return intern_find(&parser->builder->intern[what], key);
}

static bool has_pattern(const struct patterned *on)
{
    return on->pattern && on->pattern->kind != PATTERN_NONE;
}

/* One colour, or a checker of two, is no function. */
static bool is_function(const struct texture *texture)
{
    if (has_pattern(&texture->on))
        return true;
    if (!texture->below && surface_checker(&texture->pigment))
        return false;
    for (; texture; texture = texture->below)
        if (has_pattern(&texture->pigment.on) || has_pattern(&texture->on))
            return true;
    return false;
}

/* The mean stands for patterns that core cannot do. */
static void set_function(struct parser *parser,
                         const struct placed_texture *worn,
                         struct brume_material *material)
{
    material->function = build_texture_function(parser, worn->what);
    if (material->function >= 0)
        memcpy(material->pigment_transform, worn->by.m, sizeof worn->by.m);
    else
        build_lacks(parser, "pigments of some patterns",
                    parser->builder->placed_at);
}

int build_send_material(struct parser *parser,
                        const struct placed_texture *worn,
                        struct brume_error *err)
{
    struct brume_material material;

    if (model_is_invisible(worn->what))
        return -1;
    model_material(worn->what, &worn->by, &material);
    if (is_function(worn->what))
        set_function(parser, worn, &material);
    struct intern_key key = intern_key(&material, sizeof material);
    int id = sent(parser, SENT_MATERIAL, &key);
    if (id >= 0)
        return id;
    id = brume_add_material(parser->out->scene, &material, err);
    return remember(parser, SENT_MATERIAL, &key, id);
}

/* ---- fields ------------------------------------------------------------ */

static int send_field(struct parser *parser, const struct brume_field *field,
                      struct brume_error *err)
{
    struct intern_key key = intern_key(field, sizeof *field);
    int id = sent(parser, SENT_FIELD, &key);

    if (id >= 0)
        return id;
    id = brume_add_field(parser->out->scene, field, err);
    return remember(parser, SENT_FIELD, &key, id);
}

static void place_field(struct brume_field *field, const transform *by)
{
    memcpy(field->transform, by->m, sizeof by->m);
}

/* A density as a field, of a pattern's colour or of one number. Its mean
 * stands for a pattern that core cannot do. */
static struct brume_field field_of(struct parser *parser,
                                   const struct density *density,
                                   const transform *by, bool colored)
{
    struct brume_field field;
    transform placing = transform_identity();

    memset(&field, 0, sizeof field);
    field.kind = BRUME_FIELD_CONSTANT;
    field.scale = density->color[0];
    field.grid = field.function = -1;
    if (model_density_is_grid(density)) {
        const struct pattern *pattern = density->on.pattern;
        field.kind = BRUME_FIELD_GRID;
        field.grid = pattern->grid;
        placing = transform_then(&pattern->grid_by, &density->on.by);
        placing = transform_then(&placing, by);
    } else if (model_density_is_patterned(density)) {
        field.function = build_density_function(parser, density);
        if (field.function >= 0) {
            field.kind = BRUME_FIELD_FUNCTION;
            field.scale = 1;
            field.component = colored ? BRUME_COMPONENT_COLOR : 0;
            placing = *by;
        } else {
            build_lacks(parser, "densities of some patterns",
                        parser->builder->placed_at);
        }
    }
    place_field(&field, &placing);
    return field;
}

/* ---- media ------------------------------------------------------------- */

static bool send_fire(struct parser *parser, const struct fire *fire,
                      const transform *by, struct brume_fire *to,
                      struct brume_error *err)
{
    struct brume_field field;

    to->on = fire->on;
    to->temperature = to->amount = -1;
    if (!fire->on)
        return true;
    to->kelvin_scale = fire->kelvin[0];
    to->kelvin_offset = fire->kelvin[1];
    to->intensity = fire->intensity;
    to->reference = fire->reference;
    to->brightness = (enum brume_brightness)fire->brightness;
    to->additive = fire->additive != 0;
    field = field_of(parser, &fire->temperature, by, false);
    to->temperature = send_field(parser, &field, err);
    if (to->temperature < 0)
        return false;
    if (fire->has_amount) {
        field = field_of(parser, &fire->amount, by, false);
        to->amount = send_field(parser, &field, err);
    }
    return !fire->has_amount || to->amount >= 0;
}

/* A density that is a constant, as those of patterns that core cannot do,
 * goes into the coefficients. */
static bool send_densities(struct parser *parser, const struct media *media,
                           const transform *by, struct brume_medium *to,
                           struct brume_error *err)
{
    for (int i = 0; i < media->densities; i++) {
        const struct density *density = &media->density[i];
        struct brume_field field = field_of(parser, density, by,
                                            density->colored);
        if (field.kind == BRUME_FIELD_CONSTANT) {
            for (int c = 0; c < 3; c++) {
                to->absorption[c] *= density->color[c];
                to->emission[c] *= density->color[c];
                to->scattering[c] *= density->color[c];
            }
            continue;
        }
        to->density[to->densities] = send_field(parser, &field, err);
        if (to->density[to->densities++] < 0)
            return false;
    }
    return true;
}

/* Grids of one file lie alike, so the velocity's where the density does. */
static void send_velocity(const struct media *media, const transform *by,
                          struct brume_velocity *to)
{
    const struct velocity *velocity = &media->velocity;
    transform placing = velocity->by;

    to->on = velocity->known;
    if (!velocity->known)
        return;
    for (int i = 0; velocity->file && i < media->densities; i++)
        if (model_density_is_grid(&media->density[i])) {
            const struct patterned *on = &media->density[i].on;
            placing = transform_then(&on->pattern->grid_by, &on->by);
            break;
        }
    placing = transform_then(&placing, by);
    memcpy(to->transform, placing.m, sizeof to->transform);
    memcpy(to->grid, velocity->grid, sizeof to->grid);
    to->voxels = velocity->units == VELOCITY_VOXELS;
    to->scale = velocity->strength;
    if (velocity->units == VELOCITY_PER_SECOND)
        to->scale /= velocity->fps;
}

/* A density's colour scales what the medium does, not the fire in it. */
static int send_medium(struct parser *parser, const struct media *media,
                       const transform *by, struct brume_error *err)
{
    struct brume_medium to;

    memset(&to, 0, sizeof to);
    for (int i = 0; i < 3; i++) {
        double tint = media->tint[i];
        to.absorption[i] = media->absorption[i] * tint;
        to.emission[i] = media->emission[i] * tint;
        to.scattering[i] = media->scattering[i] * tint;
    }
    to.phase = (enum brume_phase)media->type;
    to.eccentricity = media->eccentricity;
    to.extinction = media->extinction;
    for (int i = 0; i < BRUME_MAX_DENSITIES; i++)
        to.density[i] = -1;
    if (!send_densities(parser, media, by, &to, err) ||
        !send_fire(parser, &media->fire, by, &to.fire, err))
        return -1;
    send_velocity(media, by, &to.velocity);
    struct intern_key key = intern_key(&to, sizeof to);
    int id = sent(parser, SENT_MEDIUM, &key);
    if (id >= 0)
        return id;
    id = brume_add_medium(parser->out->scene, &to, err);
    return remember(parser, SENT_MEDIUM, &key, id);
}

int build_send_interior(struct parser *parser, const struct media *const *media,
                        int count, const transform *by, struct brume_error *err)
{
    int list[BRUME_MAX_INTERIOR_MEDIA] = {0};

    for (int i = 0; i < count; i++) {
        list[i] = send_medium(parser, media[i], by, err);
        if (list[i] < 0)
            return -1;
    }
    struct intern_key key = intern_key(list, (size_t)count * sizeof *list);
    int id = sent(parser, SENT_INTERIOR, &key);
    if (id >= 0)
        return id;
    id = brume_add_interior(parser->out->scene, list, count, err);
    return remember(parser, SENT_INTERIOR, &key, id);
}
