/* transform.h - affine maps of the scene language, in double precision.
 *
 * A map is the rows of A|b with p' = A p + b. Lengths are scene units, angles
 * degrees; rotation is left-handed and goes about x, then y, then z. */
#ifndef PARSER_TRANSFORM_H
#define PARSER_TRANSFORM_H
#include <stdbool.h>

typedef struct {
    double m[3][4];
} transform;

transform transform_identity(void);
transform transform_translate(const double offset[3]);
/* A factor of 0 counts as 1, as in POV-Ray; the caller warns. */
transform transform_scale(const double factor[3]);
transform transform_rotate(const double degrees[3]);
/* The twelve numbers of `matrix`: images of x, y and z, then the offset. */
transform transform_matrix(const double v[12]);

/* The map that does `first`, then `second`. */
transform transform_then(const transform *first, const transform *second);
/* False, with `out` untouched, when the map is singular. */
bool transform_inverse(const transform *t, transform *out);
bool transform_is_identity(const transform *t);

void transform_point(const transform *t, const double p[3], double out[3]);
/* Without the offset: for directions and extents. */
void transform_vector(const transform *t, const double v[3], double out[3]);

#endif
