/* srgb.h - linear light and the code values of sRGB (IEC 61966-2-1:1999). */
#ifndef LIB_SRGB_H
#define LIB_SRGB_H

/* The transfer curve on [0, 1]; linear values outside are clipped, NaN is 0.
 * The result is the same on every processor: it uses no library function but
 * sqrt, which IEEE 754 defines to the last bit. */
double srgb_encode(double linear);

/* The curve's inverse; where 0..1 is left it goes on. */
double srgb_decode(double code);

/* srgb_encode as the nearest of the codes 0..max (255 or 65535). */
unsigned srgb_code(float linear, unsigned max);

/* A value that is not light (alpha) as the nearest code, clipped alike. */
unsigned srgb_linear_code(float value, unsigned max);
#endif
