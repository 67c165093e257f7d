/* build_plate.c - the plate: of a background, or of the command line. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "lib/plate.h"
#include "parser/builder.h"
#include "parser/origins.h"

/* What the scene and the command line come to. */
struct chosen {
    bool switched; /* the command line names it               */
    struct location at;
    const char *path, *layer;
    enum parse_depth depth;
};

/* What is wrong with a file that the command line names is at no place. */
static void tell(struct parser *parser, const struct chosen *c,
                 enum diag_severity severity, enum brume_code code,
                 const char *text)
{
    struct diag_item item = {.severity = severity, .code = code, .text = text};
    struct brume_error err = {.code = code};

    if (c->switched) {
        diag_add(parser->diag, &item);
        parser->failed |= severity == DIAG_ERROR;
    } else if (severity == DIAG_WARNING) {
        parser_warn(parser, c->at, "%s", text);
    } else {
        snprintf(err.text, sizeof err.text, "%s", text);
        parser_relay(parser, c->at, &err);
    }
}

BRUME_PRINTF(3, 4)
static void warn(struct parser *parser, const struct chosen *c,
                 const char *format, ...)
{
    char text[300];
    va_list args;

    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    tell(parser, c, DIAG_WARNING, BRUME_OK, text);
}

/* A file of the command line; what the scene says of another is no matter. */
static bool choose_given(struct parser *parser, struct chosen *c)
{
    const struct parse_plate *given = &parser->in->plate;

    c->switched = true;
    c->path = given->path;
    c->layer = given->layer;
    c->depth = given->depth ? given->depth : PARSE_DEPTH_AXIS;
    origins_add(parser->in->origins, given->path);
    return true;
}

/* False: there is none, or its file is not found, which is reported. */
static bool choose(struct parser *parser, struct chosen *c)
{
    const struct background_plate *said = &parser->builder->globals.plate;
    const struct parse_plate *given = &parser->in->plate;

    *c = (struct chosen){.at = said->at};
    if (given->path)
        return choose_given(parser, c);
    if (!said->name.text || !build_has_file(parser, said->name, said->at))
        return false;
    c->layer = given->layer ? given->layer : said->layer.text;
    c->depth = given->depth
                   ? given->depth
                   : (enum parse_depth)(PARSE_DEPTH_AXIS + said->depth);
    c->path = parser_find_file(parser, said->at, said->name, PARSER_DATA);
    return c->path != NULL;
}

static void warn_of_pixels(struct parser *parser, const struct chosen *c,
                           const struct plate *plate)
{
    if (plate->faulty > 0)
        warn(parser, c,
             "%zu pixels of the plate are no numbers or not finite: they count "
             "as black",
             plate->faulty);
    if (plate->depthless > 0 && c->depth != PARSE_DEPTH_NONE)
        warn(parser, c,
             "the plate's depth is no number or not above 0 at %zu pixels: "
             "they count as behind everything",
             plate->depthless);
    if (!plate->depth && c->depth == PARSE_DEPTH_RAY)
        warn(parser, c, "the plate has no depths: it is behind everything");
}

static bool fits(const struct parser *parser, const struct plate *plate,
                 struct brume_error *err)
{
    const struct parse_ambient *a = &parser->in->ambient;

    return (plate->width == a->image_width &&
            plate->height == a->image_height) ||
           brume_fail(err, BRUME_ERR_SCENE,
                      "the plate has %d x %d pixels, the picture %d x %d",
                      plate->width, plate->height, a->image_width,
                      a->image_height);
}

static bool send(struct parser *parser, const struct chosen *c,
                 const struct plate *plate, struct brume_error *err)
{
    struct brume_plate to = BRUME_PLATE_INIT;

    to.width = plate->width;
    to.height = plate->height;
    to.radiance = plate->radiance;
    to.alpha = plate->alpha;
    to.depth = c->depth == PARSE_DEPTH_NONE ? NULL : plate->depth;
    to.along_ray = c->depth == PARSE_DEPTH_RAY;
    return brume_set_plate(parser->out->scene, &to, err);
}

bool build_finish_plate(struct parser *parser)
{
    struct brume_error err = {0};
    struct chosen c;
    struct plate *plate;
    bool good;

    if (!choose(parser, &c))
        return !parser->failed;
    plate = plate_load(c.path, c.layer, &err);
    good = plate && fits(parser, plate, &err);
    if (good) {
        warn_of_pixels(parser, &c, plate);
        good = send(parser, &c, plate, &err);
    }
    plate_free(plate);
    if (!good)
        tell(parser, &c, DIAG_ERROR, err.code, err.text);
    return good;
}
