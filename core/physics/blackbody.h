/* blackbody.h - the colour and luminance of what glows at a temperature.
 *
 * A table of log(X/T), log(Y/T), log(Z/T) over s = 1/T: smooth down to s = 0,
 * where it is the limit of Rayleigh and Jeans, so that no temperature is
 * extrapolated. core/blackbody.c fills it. */
#ifndef CORE_PHYSICS_BLACKBODY_H
#define CORE_PHYSICS_BLACKBODY_H
#include "core/physics/fmath.h"
#include "core/physics/vec.h"

#define BLACKBODY_LOWEST_KELVIN 500.0f
#define BLACKBODY_HIGHEST_KELVIN 1e30f  /* hotter glows as this does        */
#define BLACKBODY_UNIT 1e6f             /* cd/m2 of luminance 1             */
#define BLACKBODY_ENTRIES 512

/* Entry i is at s = (i - 1) / (511 500 K): one lies beyond each end, for the
 * cubic. */
typedef struct {
    float log_x[BLACKBODY_ENTRIES + 2];
    float log_y[BLACKBODY_ENTRIES + 2];
    float log_z[BLACKBODY_ENTRIES + 2];
} blackbody_table;

/* Catmull-Rom between a[1] and a[2], by differences: they keep the digits
 * that the logarithms' size would cost. */
HD float blackbody_cubic(const float *a, float f)
{
    float d0 = a[1] - a[0], d1 = a[2] - a[1], d2 = a[3] - a[2];
    float m1 = 0.5f * (d0 + d1), m2 = 0.5f * (d1 + d2);
    float bend = (d1 - m1) + (d1 - m1) + (d1 - m2);
    return a[1] + f * (m1 + f * (bend + f * ((m1 - d1) + (m2 - d1))));
}

/* Linear Rec.709 radiance in units of BLACKBODY_UNIT; colours outside of its
 * gamut have negative components (blue below 1900 K). 0 below 500 K, whose
 * luminance is 6e-14 of that at 1500 K, and for NaN. X, Y, Z are within 6e-6
 * of the sum over the CIE's table, within 1e-6 above 3000 K: the cubic errs by
 * 5e-7, the rest is what a float of the logarithm loses. */
HD rgb blackbody_rgb(const blackbody_table *t, float kelvin)
{
    if (!(kelvin >= BLACKBODY_LOWEST_KELVIN))
        return rgb_gray(0.0f);
    kelvin = hd_min(kelvin, BLACKBODY_HIGHEST_KELVIN);
    float p = BLACKBODY_LOWEST_KELVIN * (BLACKBODY_ENTRIES - 1) / kelvin;
    float node = hd_min((float)hd_floor(p), (float)(BLACKBODY_ENTRIES - 2));
    int i = (int)node;
    float x = kelvin * fm_exp(blackbody_cubic(t->log_x + i, p - node));
    float y = kelvin * fm_exp(blackbody_cubic(t->log_y + i, p - node));
    float z = kelvin * fm_exp(blackbody_cubic(t->log_z + i, p - node));
    return rgb_make(3.24096994f * x - 1.53738318f * y - 0.49861076f * z,
                    -0.96924364f * x + 1.8759675f * y + 0.04155506f * z,
                    0.05563008f * x - 0.20397696f * y + 1.05697151f * z);
}

#endif
