/* image.h - pictures laid over space, as POV-Ray lays image_map: found by
 * probing the program (tests/oracle/images.py).
 *
 * A point has a place (u, v) in the picture, v upward, by the type of map:
 * planar (its x and y), spherical and cylindrical about y, toroidal about a
 * ring of radius 1. A picture repeats, or is there `once`. Texels are centred
 * in their cells; between centres it is bilinear, bicubic (Catmull-Rom) or
 * weighted by the inverse squared distance of four. */
#ifndef CORE_PHYSICS_IMAGE_H
#define CORE_PHYSICS_IMAGE_H
#include "core/physics/machine_code.h"
#include "core/physics/real.h"

enum { IMAGE_PLANAR = 0, IMAGE_SPHERICAL = 1, IMAGE_CYLINDRICAL = 2,
       IMAGE_TOROIDAL = 5 };
enum { IMAGE_BILINEAR = 2, IMAGE_BICUBIC = 3, IMAGE_DISTANCE = 4 };
/* Numbers of a use: type of map, once, interpolation, and what is added to
 * filter and transmit. */
enum { IMAGE_NUMBERS = 5, IMAGE_TERMS = 5 };

#define IMAGE_TURN REAL(6.283185307179586)

HD real image_wrap(real x)
{
    real y = x - real_floor(x);
    return y < REAL(1.0) ? y : REAL(0.0);
}

/* False: the point has none there. */
HD bool image_place(int type, bool once, real3 p, real *u, real *v)
{
    real ring = real_sqrt(p.x * p.x + p.z * p.z), height = p.y;
    *u = p.x;
    if (type != IMAGE_PLANAR)
        *u = real_atan2(p.z, p.x) / IMAGE_TURN;
    if (type == IMAGE_SPHERICAL)
        height = REAL(0.5) + real_atan2(p.y, ring) * (REAL(2.0) / IMAGE_TURN);
    if (type == IMAGE_TOROIDAL)
        height = REAL(0.5) + real_atan2(p.y, ring - REAL(1.0)) / IMAGE_TURN;
    if (type == IMAGE_SPHERICAL ? !(ring > 0 || p.y != 0)
                                : type != IMAGE_PLANAR && !(ring > 0))
        return false;
    bool beyond = (type == IMAGE_PLANAR && !(*u >= 0 && *u <= 1)) ||
                  (type <= IMAGE_CYLINDRICAL && !(height >= 0 && height <= 1));
    *u = image_wrap(*u);
    *v = image_wrap(height);
    return !(once && beyond);
}

/* A cell of one side, which repeats or ends. */
HD int image_cell(int i, int count, bool once)
{
    if (once)
        return i < 0 ? 0 : i < count ? i : count - 1;
    return (i % count + count) % count;
}

/* Adds to the five terms: red, green, blue, filter, transmit. */
HD void image_add(const flat_image *image, const float *texels, int x, int y,
                  real weight, real *out)
{
    const float *t = texels + image->texel
                   + ((uint64_t)y * (uint64_t)image->width + (uint64_t)x)
                   * (uint64_t)image->channels;
    for (int k = 0; k < 3; k++)
        out[k] += weight * (real)t[image->channels < 3 ? 0 : k];
    if (image->channels == 5)
        out[3] += weight * (real)t[3];
    if (image->channels > 3 || image->channels == 2)
        out[4] += weight * (real)t[image->channels - 1];
}

/* Weights of four cells in a row, of which the second is at or before the
 * point and `t` of the way to the third is gone. */
HD void image_weights(int kind, real t, real w[4])
{
    real s = t * t, c = s * t;
    w[0] = w[3] = REAL(0.0);
    w[1] = REAL(1.0) - t;
    w[2] = t;
    if (kind != IMAGE_BICUBIC)
        return;
    w[0] = REAL(0.5) * (-t + REAL(2.0) * s - c);
    w[1] = REAL(0.5) * (REAL(2.0) - REAL(5.0) * s + REAL(3.0) * c);
    w[2] = REAL(0.5) * (t + REAL(4.0) * s - REAL(3.0) * c);
    w[3] = REAL(0.5) * (c - s);
}

HD real image_nearness(real dx, real dy)
{
    return REAL(1.0) / real_max(dx * dx + dy * dy, REAL(1e-12));
}

/* Of four by four cells about a place in cells, from the lower left. */
HD void image_blend(const flat_image *image, const float *texels, int kind,
                    bool once, real x, real y, real *out)
{
    int left = (int)real_floor(x), low = (int)real_floor(y);
    real tx = x - (real)left, ty = y - (real)low, wx[4], wy[4];
    real sum = REAL(1.0);
    image_weights(kind, tx, wx);
    image_weights(kind, ty, wy);
    if (kind == IMAGE_DISTANCE)
        sum = image_nearness(tx, ty) + image_nearness(1 - tx, ty)
            + image_nearness(tx, 1 - ty) + image_nearness(1 - tx, 1 - ty);
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 4; i++) {
            real weight = wx[i] * wy[j];
            if (kind == IMAGE_DISTANCE)
                weight = i % 3 == 0 || j % 3 == 0
                       ? REAL(0.0)
                       : image_nearness((real)(i - 1) - tx, (real)(j - 1) - ty)
                       / sum;
            if (weight != REAL(0.0))
                image_add(image, texels,
                          image_cell(left + i - 1, image->width, once),
                          image->height - 1
                              - image_cell(low + j - 1, image->height, once),
                          weight, out);
        }
}

/* The five numbers of a picture at a point; clear where it is not. */
HD void image_lookup(const flat_image *image, const float *texels,
                     const real *numbers, real3 p, real *out)
{
    int type = (int)numbers[0], kind = (int)numbers[2];
    bool once = numbers[1] != 0;
    real u, v;
    for (int k = 0; k < IMAGE_TERMS; k++)
        out[k] = REAL(0.0);
    if (!image_place(type, once, p, &u, &v)) {
        out[0] = out[1] = out[2] = out[4] = REAL(1.0);
        return;
    }
    u *= (real)image->width;
    v *= (real)image->height;
    if (kind < IMAGE_BILINEAR)
        image_add(image, texels, image_cell((int)u, image->width, true),
                  image->height - 1
                      - image_cell((int)v, image->height, true),
                  REAL(1.0), out);
    else
        image_blend(image, texels, kind, once, u - REAL(0.5), v - REAL(0.5),
                    out);
    out[3] += numbers[3];
    out[4] += numbers[4];
}

#endif
