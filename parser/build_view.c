/* build_view.c - camera. */
#include <string.h>

#include "parser/builder.h"

enum { CAMERA_UP = 1, CAMERA_RIGHT = 2, CAMERA_LOOK_AT = 4 };
enum { CAMERA_ANGLE, CAMERA_CYLINDER_TYPE, CAMERA_SAMPLES };

#define CAMERA_VECTOR(word_, x, y, z, bit)                                     \
    {                                                                          \
        .word = #word_, .kind = PARAM_VECTOR, .start = {x, y, z},              \
        .low = -INFINITY, .high = INFINITY, .alone = NAN, .given = bit,        \
        .offset = offsetof(struct camera, word_)                               \
    }
#define CAMERA_WORD(word_, type_)                                              \
    PARAM_WORD(word_, PARAM_MARK, CAMERA_##type_, 0, struct camera, type)
#define CAMERA_FLOAT(word_, start_, low_, high_)                               \
    PARAM_ROW(#word_, PARAM_FLOAT, start_, low_, high_, 0, 0, struct camera,   \
              word_)

const struct param build_camera_params[] = {
    CAMERA_WORD("perspective", PERSPECTIVE),
    CAMERA_WORD("orthographic", ORTHOGRAPHIC),
    CAMERA_WORD("fisheye", FISHEYE),
    CAMERA_WORD("ultra_wide_angle", ULTRA_WIDE_ANGLE),
    CAMERA_WORD("omnimax", OMNIMAX),
    CAMERA_WORD("panoramic", PANORAMIC),
    CAMERA_WORD("spherical", SPHERICAL),
    PARAM_OWN("cylinder", 1, 1, CAMERA_CYLINDER_TYPE),
    CAMERA_VECTOR(location, 0, 0, 0, 0),
    CAMERA_VECTOR(direction, 0, 0, 1, 0),
    CAMERA_VECTOR(up, 0, 1, 0, CAMERA_UP),
    CAMERA_VECTOR(right, 1.33, 0, 0, CAMERA_RIGHT),
    CAMERA_VECTOR(sky, 0, 1, 0, 0),
    CAMERA_VECTOR(look_at, 0, 0, 1, CAMERA_LOOK_AT),
    CAMERA_VECTOR(focal_point, 0, 0, 1, 0),
    PARAM_OWN("angle", 1, 2, CAMERA_ANGLE),
    CAMERA_FLOAT(aperture, 0, 0, INFINITY),
    CAMERA_FLOAT(confidence, 0.9, 0, 1),
    CAMERA_FLOAT(variance, 1.0 / 128, 0, 1),
    PARAM_OWN("blur_samples", 1, 2, CAMERA_SAMPLES),
    {0}};

static void open_camera(struct parser *parser, struct frame *frame)
{
    struct camera *camera = frame->node;

    (void)parser;
    param_defaults(build_camera_params, camera);
    camera->type = CAMERA_PERSPECTIVE;
    camera->by = transform_identity();
    camera->at = frame->at;
}

static void set_angle(struct parser *parser, struct camera *camera,
                      const double x[2], int count, struct location at)
{
    bool wide = camera->type != CAMERA_PERSPECTIVE;
    double most = wide ? 360 : 180;

    if (!(x[0] >= 0 && (wide ? x[0] <= most : x[0] < most)) ||
        !(x[1] >= 0 && x[1] <= 180)) {
        parser_mistake(parser, at,
                       "'angle' is %g, must be at least 0 and less than %g",
                       x[0], most);
        return;
    }
    camera->angle = x[0];
    camera->angle_v = count > 1 ? x[1] : 0;
}

static void set_cylinder(struct parser *parser, struct camera *camera, double x,
                         struct location at)
{
    if (!(x >= 1 && x < 5)) {
        parser_mistake(parser, at, "'cylinder' must be from 1 to 4");
        return;
    }
    camera->type = CAMERA_CYLINDER;
    camera->cylinder = (int)x;
}

static void set_samples(struct parser *parser, struct camera *camera,
                        const double x[2], int count, struct location at)
{
    for (int i = 0; i < count; i++) {
        if (!(x[i] >= 0 && x[i] <= 1e9))
            parser_mistake(parser, at, "'blur_samples' must be from 0 to 1e9");
        else
            camera->blur_samples[i] = (int)x[i];
    }
}

static void camera_values(struct parser *parser, struct frame *frame,
                          const struct param *row, const struct value *value,
                          int count, struct location at)
{
    double x[2] = {0};

    (void)at;
    at = parser->builder->value_at;
    for (int i = 0; i < count; i++) {
        if (value[i].kind != VALUE_NUMBER) {
            parser_mistake(parser, at, "'%s' needs a number", row->word);
            return;
        }
        x[i] = value[i].v[0];
    }
    if (row->id == CAMERA_ANGLE)
        set_angle(parser, frame->node, x, count, at);
    else if (row->id == CAMERA_CYLINDER_TYPE)
        set_cylinder(parser, frame->node, x[0], at);
    else
        set_samples(parser, frame->node, x, count, at);
}

static void apply_camera(struct parser *parser, struct frame *frame,
                         const struct value *value, struct location at)
{
    struct camera *camera = frame->node;

    (void)parser;
    (void)at;
    if (value->kind == VALUE_NORMAL) {
        camera->normal = true;
        return;
    }
    *camera = *(const struct camera *)value->node;
    camera->at = frame->at;
}

static void move_camera(struct parser *parser, struct frame *frame,
                        const transform *by)
{
    struct camera *camera = frame->node;

    (void)parser;
    camera->by = transform_then(&camera->by, by);
}

static void close_camera(struct parser *parser, struct frame *frame,
                         struct location at)
{
    struct camera *camera = frame->node;
    struct brume_camera seen;

    (void)at;
    camera->has_up |= (frame->given & CAMERA_UP) != 0;
    camera->has_right |= (frame->given & CAMERA_RIGHT) != 0;
    camera->has_look_at |= (frame->given & CAMERA_LOOK_AT) != 0;
    switch (model_camera(camera, &seen)) {
    case CAMERA_LOOKS_AT_ITSELF:
        parser_mistake(parser, frame->at,
                       "the camera's location and look_at are the same point");
        break;
    case CAMERA_SKY_AHEAD:
        parser_warn(parser, frame->at,
                    "the camera looks along its sky "
                    "vector: right stays as it is");
        break;
    case CAMERA_FINE:
        break;
    }
}

const struct statement build_statement_camera = {
    .word = "camera",
    .makes = VALUE_CAMERA,
    .takes = BUILD_TAKES(VALUE_CAMERA) | BUILD_TAKES(VALUE_NORMAL),
    .size = sizeof(struct camera),
    .params = build_camera_params,
    .open = open_camera,
    .values = camera_values,
    .apply = apply_camera,
    .move = move_camera,
    .close = close_camera,
};

void build_camera_lacks(struct parser *parser, const struct camera *camera)
{
    static const char *const words[] = {
        [CAMERA_FISHEYE] = "the fisheye camera",
        [CAMERA_ULTRA_WIDE_ANGLE] = "the ultra_wide_angle camera",
        [CAMERA_OMNIMAX] = "the omnimax camera",
        [CAMERA_PANORAMIC] = "the panoramic camera",
        [CAMERA_SPHERICAL] = "the spherical camera",
        [CAMERA_CYLINDER] = "the cylinder camera",
        [CAMERA_MESH] = "the mesh_camera"};

    if (words[camera->type])
        build_lacks(parser, words[camera->type], camera->at);
    if (camera->aperture > 0 && camera->blur_samples[0] > 0)
        build_lacks(parser, "focal blur", camera->at);
    if (camera->normal)
        build_lacks(parser, "normals of cameras", camera->at);
}

/* ---- mesh_camera and bokeh in it --------------------------------------- */

static const enum build_kind in_camera[] = {BUILD_CAMERA, BUILD_KINDS};

static void open_inner(struct parser *parser, struct frame *frame)
{
    frame->node = build_around(parser)->node;
}

static void open_mesh_camera(struct parser *parser, struct frame *frame)
{
    open_inner(parser, frame);
    ((struct camera *)frame->node)->type = CAMERA_MESH;
}

static const struct param mesh_camera_arguments[] = {
    PARAM_ROW("rays per pixel", PARAM_INTEGER, 1, 1, 1e9, 0, 0, struct camera,
              rays),
    PARAM_ROW("distribution type", PARAM_INTEGER, 0, 0, 3, 0, 0, struct camera,
              distribution),
    PARAM_ROW("greatest distance", PARAM_FLOAT, 0, 0, INFINITY, 0, 0,
              struct camera, max_distance),
    {0}};
static const struct param mesh_camera_params[] = {
    PARAM_WORD("smooth", PARAM_SWITCH, 1, 0, struct camera, mesh_smooth), {0}};

static void apply_mesh_camera(struct parser *parser, struct frame *frame,
                              const struct value *value, struct location at)
{
    const struct object *object = value->node;
    struct camera *camera = frame->node;

    if (object->kind != OBJECT_MESH)
        parser_mistake(parser, at, "'mesh_camera' takes meshes");
    else
        build_add_child(parser, &camera->meshes, object);
}

const struct statement build_statement_mesh_camera = {
    .word = "mesh_camera",
    .within = in_camera,
    .takes = BUILD_TAKES(VALUE_OBJECT),
    .params = mesh_camera_params,
    .arguments = mesh_camera_arguments,
    .needed = 2,
    .open = open_mesh_camera,
    .apply = apply_mesh_camera,
};

static void apply_bokeh(struct parser *parser, struct frame *frame,
                        const struct value *value, struct location at)
{
    (void)parser;
    (void)value;
    (void)at;
    ((struct camera *)frame->node)->bokeh = true;
}

const struct statement build_statement_bokeh = {
    .word = "bokeh",
    .within = in_camera,
    .takes = BUILD_TAKES(VALUE_PIGMENT),
    .open = open_inner,
    .apply = apply_bokeh,
};
