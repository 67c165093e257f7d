/* Pictures: what a scene keeps of them, and their use by functions. */
#define PHYSICS_DOUBLE
#include <math.h>
#include <string.h>
#include "core/check.h"
#include "core/function.h"
#include "lib/memory.h"

#define SAME(a, b) _Static_assert((int)(a) == (int)(b), "brume.h's numbers")
SAME(BRUME_IMAGE_PLANAR, IMAGE_PLANAR);
SAME(BRUME_IMAGE_SPHERICAL, IMAGE_SPHERICAL);
SAME(BRUME_IMAGE_CYLINDRICAL, IMAGE_CYLINDRICAL);
SAME(BRUME_IMAGE_TOROIDAL, IMAGE_TOROIDAL);
SAME(BRUME_IMAGE_BILINEAR, IMAGE_BILINEAR);
SAME(BRUME_IMAGE_BICUBIC, IMAGE_BICUBIC);
SAME(BRUME_IMAGE_DISTANCE, IMAGE_DISTANCE);

static bool check_image(const brume_scene *scene,
                        const struct brume_image *image,
                        struct brume_error *err)
{
    if (image->width < 1 || image->height < 1 || image->channels < 1 ||
        image->channels > IMAGE_TERMS)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "a picture of %d x %d texels of %d numbers is not "
                          "possible",
                          image->width, image->height, image->channels);
    size_t width = (size_t)image->width, height = (size_t)image->height;
    size_t used = scene->texels_count / IMAGE_TERMS;
    if (width > (BRUME_MAX_TEXELS - used) / height)
        return brume_fail(err, BRUME_ERR_LIMIT,
                          "the pictures of a scene have more than %zu texels",
                          BRUME_MAX_TEXELS);
    size_t n = width * height * (size_t)image->channels;
    for (size_t i = 0; i < n; i++)
        if (!isfinite(image->texel[i]))
            return brume_fail(err, BRUME_ERR_SCENE,
                              "a picture's number %zu is %g", i,
                              (double)image->texel[i]);
    return true;
}

int brume_add_image(brume_scene *scene, const struct brume_image *image,
                    struct brume_error *err)
{
    if (!check_image(scene, image, err))
        return -1;
    size_t n = (size_t)image->width * (size_t)image->height *
               (size_t)image->channels;
    flat_image *images = memory_grow(scene->images, &scene->images_capacity,
                                     scene->images_count + 1, sizeof *images,
                                     err);
    if (!images)
        return -1;
    scene->images = images;
    float *texels = memory_grow(scene->texels, &scene->texels_capacity,
                                scene->texels_count + n, sizeof *texels, err);
    if (!texels)
        return -1;
    scene->texels = texels;
    memcpy(texels + scene->texels_count, image->texel, n * sizeof *texels);
    memset(&images[scene->images_count], 0, sizeof *images);
    images[scene->images_count].width = image->width;
    images[scene->images_count].height = image->height;
    images[scene->images_count].channels = image->channels;
    images[scene->images_count].texel = scene->texels_count;
    scene->texels_count += n;
    return (int)scene->images_count++;
}

bool image_numbers_hold(const double *n)
{
    bool map = n[0] == IMAGE_PLANAR || n[0] == IMAGE_SPHERICAL ||
               n[0] == IMAGE_CYLINDRICAL || n[0] == IMAGE_TOROIDAL;
    bool kind = n[2] == 0 || n[2] == IMAGE_BILINEAR || n[2] == IMAGE_BICUBIC ||
                n[2] == IMAGE_DISTANCE;

    return map && kind && (n[1] == 0 || n[1] == 1) && isfinite(n[3]) &&
           isfinite(n[4]);
}

bool brume_function_image(struct brume_function *function,
                          const struct brume_image_use *use,
                          struct brume_error *err)
{
    const struct brume_scene *s = function_scene(function);
    const double numbers[IMAGE_NUMBERS] = {
        use->map, use->once, use->interpolate, use->filter, use->transmit};
    int32_t first = 0;

    if (use->image < 0 || (size_t)use->image >= s->images_count)
        return function_fail(function, err, BRUME_ERR_SCENE,
                             "there is no such picture for a function");
    if (!image_numbers_hold(numbers))
        return function_fail(function, err, BRUME_ERR_SCENE,
                             "a picture cannot be laid like that");
    return function_numbers(function, numbers, IMAGE_NUMBERS, &first, err) &&
           function_wide(function, MACHINE_IMAGE, 3, IMAGE_TERMS, first, 0,
                         use->image, err);
}
