#include "core/plate.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/scene.h"
#include "lib/memory.h"

/* As for the pictures that are rendered. */
enum { MOST_SIDE = 1 << 24 };

void plate_release(struct brume_plate *plate)
{
    free((void *)plate->radiance);
    free((void *)plate->alpha);
    free((void *)plate->depth);
    *plate = (struct brume_plate)BRUME_PLATE_INIT;
}

bool plate_fits(const struct brume_plate *plate, int width, int height,
                struct brume_error *err)
{
    if (plate->width == 0 || (plate->width == width && plate->height == height))
        return true;
    return brume_fail(err, BRUME_ERR_SCENE,
                      "the plate has %d x %d pixels, the picture %d x %d",
                      plate->width, plate->height, width, height);
}

static bool check_size(const struct brume_plate *p, struct brume_error *err)
{
    bool none = p->width == 0 && p->height == 0;
    if (none || (p->width > 0 && p->height > 0 && p->width <= MOST_SIDE &&
                 p->height <= MOST_SIDE && p->radiance))
        return true;
    return brume_fail(err, BRUME_ERR_SCENE,
                      "a plate of %d x %d pixels is not possible", p->width,
                      p->height);
}

static bool check_pixels(const struct brume_plate *p, size_t pixels,
                         struct brume_error *err)
{
    for (size_t i = 0; i < 3 * pixels; i++)
        if (!isfinite(p->radiance[i]))
            return brume_fail(err, BRUME_ERR_SCENE,
                              "the plate's radiance is %g at pixel %zu",
                              (double)p->radiance[i], i / 3);
    for (size_t i = 0; p->alpha && i < pixels; i++)
        if (!(p->alpha[i] >= 0.0f && p->alpha[i] <= 1.0f))
            return brume_fail(err, BRUME_ERR_SCENE,
                              "the plate's alpha is %g at pixel %zu",
                              (double)p->alpha[i], i);
    return true;
}

/* A copy in place of what is there. */
static bool own(const float **numbers, size_t count, struct brume_error *err)
{
    if (!*numbers || count == 0) {
        *numbers = NULL;
        return true;
    }
    float *copy = memory_new(count, sizeof *copy, err);
    if (copy)
        memcpy(copy, *numbers, count * sizeof *copy);
    *numbers = copy;
    return copy;
}

bool brume_set_plate(brume_scene *scene, const struct brume_plate *plate,
                     struct brume_error *err)
{
    struct brume_plate copy = *plate;
    if (!check_size(plate, err))
        return false;
    size_t pixels = (size_t)plate->width * (size_t)plate->height;
    if (!check_pixels(plate, pixels, err))
        return false;
    bool good = own(&copy.radiance, 3 * pixels, err);
    good = own(&copy.alpha, good ? pixels : 0, err) && good;
    good = own(&copy.depth, good ? pixels : 0, err) && good;
    if (!good) {
        plate_release(&copy);
        return false;
    }
    plate_release(&scene->plate);
    scene->plate = copy;
    return true;
}
