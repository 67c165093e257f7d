/* matrix.h - affine maps in double, for what is built on the host: rows of
 * A|b, p' = A p + b. */
#ifndef CORE_MATRIX_H
#define CORE_MATRIX_H
#include <stdbool.h>
#include "core/physics/vec.h"

typedef struct { double m[3][4]; } matrix;

matrix matrix_identity(void);
matrix matrix_from(const double m[3][4]);
matrix matrix_scale_move(double scale, const double move[3]);
/* First b, then a. */
matrix matrix_compose(const matrix *a, const matrix *b);
/* False where a has no inverse (or none that a double holds). */
bool matrix_invert(const matrix *a, matrix *inverse);
double matrix_determinant(const matrix *a);
void matrix_point(const matrix *a, const double p[3], double out[3]);
void matrix_vector(const matrix *a, const double v[3], double out[3]);
affine matrix_affine(const matrix *a);
bool matrix_finite(const matrix *a);
#endif
