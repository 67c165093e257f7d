/* blackbody.h - the colour and luminance of what glows at a temperature.
 *
 * A table of the colour over T, by cubics over s = 1/T: smooth down to s = 0,
 * where it is the limit of Rayleigh and Jeans, so that no temperature is
 * extrapolated. core/blackbody.c fills it. */
#ifndef CORE_PHYSICS_BLACKBODY_H
#define CORE_PHYSICS_BLACKBODY_H
#include "core/physics/fmath.h"
#include "core/physics/vec.h"

#define BLACKBODY_LOWEST_KELVIN 500.0f
#define BLACKBODY_HIGHEST_KELVIN 1e30f  /* hotter glows as this does        */
#define BLACKBODY_UNIT 1e6f             /* cd/m2 of luminance 1             */
#define BLACKBODY_PIECES 511

/* Of s in [i, i + 1] / (511 500 K): what is multiplied by 1, f, f^2 and f^3, f
 * from 0 to 1; values and slopes are exact at both ends. */
typedef struct {
    float rgb[4][3];
} HD_ALIGNED(16) blackbody_piece;

typedef struct {
    blackbody_piece piece[BLACKBODY_PIECES];
} blackbody_table;

HD float blackbody_cubic(const blackbody_piece *a, int channel, float f)
{
    return a->rgb[0][channel] +
           f * (a->rgb[1][channel] +
                f * (a->rgb[2][channel] + f * a->rgb[3][channel]));
}

/* Linear Rec.709 radiance in units of BLACKBODY_UNIT; colours outside of its
 * gamut have negative components (blue below 1900 K). 0 below 500 K, whose
 * luminance is 6e-14 of that at 1500 K, and for NaN. X, Y, Z are within 2e-6
 * of the sum over the CIE's table, within 6e-7 above 3000 K: p as a float. */
HD rgb blackbody_rgb(const blackbody_table *t, float kelvin)
{
    if (!(kelvin >= BLACKBODY_LOWEST_KELVIN))
        return rgb_gray(0.0f);
    kelvin = hd_min(kelvin, BLACKBODY_HIGHEST_KELVIN);
    float p = BLACKBODY_LOWEST_KELVIN * BLACKBODY_PIECES / kelvin;
    int i = (int)p;
    i = i < BLACKBODY_PIECES ? i : BLACKBODY_PIECES - 1;
    const blackbody_piece a = t->piece[i];
    float f = p - (float)i;
    return rgb_make(kelvin * blackbody_cubic(&a, 0, f),
                    kelvin * blackbody_cubic(&a, 1, f),
                    kelvin * blackbody_cubic(&a, 2, f));
}

#endif
