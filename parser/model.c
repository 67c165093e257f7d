#include "parser/model.h"

#include <math.h>
#include <string.h>

/* ---- maps -------------------------------------------------------------- */

transform model_transform_result(const struct transform_block *block)
{
    transform by = block->by;

    if (block->inverse)
        transform_inverse(&block->by, &by);
    return by;
}

/* ---- media ------------------------------------------------------------- */

/* How other programs read the same grids.
 *
 * Cycles, Principled Volume (Blender 3 and 4, kernel/svm/closure.h): T is the
 * grid times 1000 K; it adds a colour of luminance 1 times s T^4 with
 * s = 5.670373e-8 * 1e-6 / pi per length, whatever the density is; s T^4 is 1
 * at 2728.25 K.
 * pbrt-v4 (GridMedium, NanoVDBMedium): T is the grid in kelvin; it emits
 * sigma_a times a black body scaled to a peak of 1.
 * Houdini, Pyro shader: 1 is 5000 K (Pyro Blackbody VOP); the colour is that
 * of the black body, the brightness is left to the flame grid. */
void model_fire_preset(struct fire *fire, enum fire_preset preset)
{
    static const struct {
        double kelvin, reference;
        int brightness, additive;
    } row[] = {
        [FIRE_CYCLES] = {1000, 2728.2525, BRUME_BRIGHTNESS_TOTAL, 1},
        [FIRE_PBRT] = {1, 2000, BRUME_BRIGHTNESS_NORMALIZED, 0},
        [FIRE_HOUDINI] = {5000, 2000, BRUME_BRIGHTNESS_CONSTANT, 1},
    };

    fire->kelvin[0] = row[preset].kelvin;
    fire->kelvin[1] = 0;
    fire->intensity = 1;
    fire->reference = row[preset].reference;
    fire->brightness = row[preset].brightness;
    fire->additive = row[preset].additive;
}

bool model_density_is_grid(const struct density *density)
{
    const struct pattern *pattern = density->on.pattern;

    return pattern && pattern->kind == PATTERN_DENSITY_FILE &&
           !density->on.map && surface_is_plain(pattern);
}

bool model_density_is_patterned(const struct density *density)
{
    const struct pattern *pattern = density->on.pattern;

    return pattern && pattern->kind != PATTERN_NONE &&
           !model_density_is_grid(density);
}

void model_mean_density(struct density *density)
{
    double color[5];

    if (!model_density_is_patterned(density))
        return;
    surface_mean(&density->on, color);
    density->colored = surface_is_colored(&density->on);
    memcpy(density->color, color, sizeof density->color);
}

static void density_transform(struct density *density, const transform *by)
{
    density->on.by = transform_then(&density->on.by, by);
}

void model_fire_transform(struct fire *fire, const transform *by)
{
    density_transform(&fire->temperature, by);
    density_transform(&fire->amount, by);
}

void model_media_transform(struct media *media, const transform *by)
{
    for (int i = 0; i < media->densities; i++)
        density_transform(&media->density[i], by);
    model_fire_transform(&media->fire, by);
    media->velocity.by = transform_then(&media->velocity.by, by);
}

/* ---- objects ----------------------------------------------------------- */

void model_object_transform(struct object *object, const transform *by)
{
    object->by = transform_then(&object->by, by);
    object->texture.by = transform_then(&object->texture.by, by);
    object->inner.by = transform_then(&object->inner.by, by);
    object->interior.by = transform_then(&object->interior.by, by);
}

/* ---- camera ------------------------------------------------------------ */

const struct camera model_default_camera = {
    .type = CAMERA_PERSPECTIVE,
    .direction = {0, 0, 1},
    .up = {0, 1, 0},
    .right = {1.33, 0, 0},
    .sky = {0, 1, 0},
    .look_at = {0, 0, 1},
    .by = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}};

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Leaves a vector of length 0 alone. */
static void resize(double v[3], double to)
{
    double from = length(v);

    for (int i = 0; i < 3; i++)
        v[i] = from > 0 ? v[i] / from * to : v[i];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* -1 where right, up and direction are right-handed, as a scene written for a
 * right-handed program has them by `right -x`. */
static double handedness(const struct brume_camera *camera)
{
    double side[3];

    cross(camera->up, camera->direction, side);
    return side[0] * camera->right[0] + side[1] * camera->right[1] +
                       side[2] * camera->right[2] <
                   0
               ? -1
               : 1;
}

static enum camera_fault look_at(const struct camera *camera,
                                 struct brume_camera *out)
{
    enum camera_fault fault = CAMERA_FINE;
    double ahead = length(out->direction), height = length(out->up);
    double width = length(out->right) * handedness(out);
    double side[3], to[3];

    for (int i = 0; i < 3; i++)
        to[i] = camera->look_at[i] - camera->location[i];
    if (length(to) < 1e-10)
        return CAMERA_LOOKS_AT_ITSELF;
    resize(to, 1);
    cross(camera->sky, to, side);
    if (length(side) < 1e-10) {
        fault = CAMERA_SKY_AHEAD;
        memcpy(side, out->right, sizeof side);
    }
    resize(side, 1);
    cross(to, side, out->up);
    memcpy(out->direction, to, sizeof to);
    for (int i = 0; i < 3; i++) {
        out->direction[i] *= ahead;
        out->right[i] = side[i] * width;
        out->up[i] *= height;
    }
    return fault;
}

/* The view that a perspective camera would have at the distance of look_at. */
static void fit_orthographic(const struct camera *camera,
                             struct brume_camera *out)
{
    double to[3];

    for (int i = 0; i < 3; i++)
        to[i] = camera->look_at[i] - camera->location[i];
    double factor = length(to) / length(out->direction);
    if (!(factor > 1e-10) || !isfinite(factor))
        return;
    for (int i = 0; i < 3; i++) {
        out->right[i] *= factor;
        out->up[i] *= factor;
    }
}

enum camera_fault model_camera(const struct camera *camera,
                               struct brume_camera *out)
{
    enum camera_fault fault = CAMERA_FINE;

    memset(out, 0, sizeof *out);
    out->kind = camera->type == CAMERA_ORTHOGRAPHIC ? BRUME_CAMERA_ORTHOGRAPHIC
                                                    : BRUME_CAMERA_PERSPECTIVE;
    memcpy(out->direction, camera->direction, sizeof out->direction);
    memcpy(out->up, camera->up, sizeof out->up);
    memcpy(out->right, camera->right, sizeof out->right);
    if (camera->angle > 0)
        resize(out->direction,
               0.5 * length(out->right) /
                   tan(camera->angle * (3.14159265358979323846 / 360)));
    if (camera->has_look_at)
        fault = look_at(camera, out);
    if (camera->type == CAMERA_ORTHOGRAPHIC &&
        (camera->angle > 0 || !(camera->has_up || camera->has_right)))
        fit_orthographic(camera, out);
    transform_point(&camera->by, camera->location, out->location);
    transform_vector(&camera->by, out->direction, out->direction);
    transform_vector(&camera->by, out->up, out->up);
    transform_vector(&camera->by, out->right, out->right);
    return fault;
}
