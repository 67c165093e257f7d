#include "core/matrix.h"
#include <math.h>

matrix matrix_identity(void)
{
    const double zero[3] = {0, 0, 0};
    return matrix_scale_move(1.0, zero);
}

matrix matrix_from(const double m[3][4])
{
    matrix out;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            out.m[i][j] = m[i][j];
    return out;
}

matrix matrix_scale_move(double scale, const double move[3])
{
    matrix out;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            out.m[i][j] = j == 3 ? move[i] : i == j ? scale : 0.0;
    return out;
}

matrix matrix_compose(const matrix *a, const matrix *b)
{
    matrix out;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            double sum = j == 3 ? a->m[i][3] : 0.0;
            for (int k = 0; k < 3; k++)
                sum += a->m[i][k] * b->m[k][j];
            out.m[i][j] = sum;
        }
    return out;
}

static double cofactor(const matrix *a, int i, int j)
{
    static const int next[3] = {1, 2, 0};
    int r0 = next[i], r1 = next[r0];
    int c0 = next[j], c1 = next[c0];
    return a->m[r0][c0] * a->m[r1][c1] - a->m[r0][c1] * a->m[r1][c0];
}

double matrix_determinant(const matrix *a)
{
    return a->m[0][0] * cofactor(a, 0, 0) + a->m[0][1] * cofactor(a, 0, 1) +
           a->m[0][2] * cofactor(a, 0, 2);
}

bool matrix_invert(const matrix *a, matrix *inverse)
{
    double determinant = matrix_determinant(a);
    if (determinant == 0.0 || !isfinite(1.0 / determinant))
        return false;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inverse->m[i][j] = cofactor(a, j, i) / determinant;
    for (int i = 0; i < 3; i++) {
        inverse->m[i][3] = 0.0;
        for (int k = 0; k < 3; k++)
            inverse->m[i][3] -= inverse->m[i][k] * a->m[k][3];
    }
    return matrix_finite(inverse);
}

void matrix_vector(const matrix *a, const double v[3], double out[3])
{
    double r[3];
    for (int i = 0; i < 3; i++)
        r[i] = a->m[i][0] * v[0] + a->m[i][1] * v[1] + a->m[i][2] * v[2];
    for (int i = 0; i < 3; i++)
        out[i] = r[i];
}

void matrix_point(const matrix *a, const double p[3], double out[3])
{
    matrix_vector(a, p, out);
    for (int i = 0; i < 3; i++)
        out[i] += a->m[i][3];
}

affine matrix_affine(const matrix *a)
{
    affine out;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            out.m[4 * i + j] = (float)a->m[i][j];
    return out;
}

bool matrix_finite(const matrix *a)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            if (!isfinite(a->m[i][j]))
                return false;
    return true;
}
