#include "lib/srgb.h"
#include <math.h>

/* The cube root of y in [0.2, 1] by Newton's iteration: from a chord within
 * 6 % of the root, five steps square the error to below one in 2^52. */
static double cube_root(double y)
{
    double r = 0.48 + 0.54 * y;
    for (int i = 0; i < 5; i++)
        r -= (r * r * r - y) / (3 * r * r);
    return r;
}

static double clip(double value)
{
    if (!(value > 0))
        return 0;
    return value < 1 ? value : 1;
}

double srgb_encode(double linear)
{
    double v = clip(linear);
    if (v <= 0.0031308)
        return 12.92 * v;
    /* v^(1/2.4) = v^(5/12), the fifth power of the twelfth root. */
    double root = cube_root(sqrt(sqrt(v)));
    double square = root * root;
    return 1.055 * (square * square * root) - 0.055;
}

double srgb_decode(double code)
{
    return code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
}

unsigned srgb_code(float linear, unsigned max)
{
    return (unsigned)(srgb_encode(linear) * max + 0.5);
}

unsigned srgb_linear_code(float value, unsigned max)
{
    return (unsigned)(clip(value) * max + 0.5);
}
