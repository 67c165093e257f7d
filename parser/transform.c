#include "parser/transform.h"

#include <math.h>
#include <string.h>

transform transform_identity(void)
{
    return (transform){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
}

transform transform_translate(const double offset[3])
{
    transform t = transform_identity();

    for (int i = 0; i < 3; i++)
        t.m[i][3] = offset[i];
    return t;
}

transform transform_scale(const double factor[3])
{
    transform t = transform_identity();

    for (int i = 0; i < 3; i++)
        if (factor[i] != 0)
            t.m[i][i] = factor[i];
    return t;
}

/* Exact at multiples of 90 degrees, so that turned boxes stay boxes. */
static void sine_cosine(double degrees, double *sine, double *cosine)
{
    static const double quarter[4] = {0, 1, 0, -1};
    double turns = degrees / 90;

    if (turns == rint(turns) && fabs(turns) < 1e9) {
        int q = (int)rint(turns) & 3;
        *sine = quarter[q];
        *cosine = quarter[(q + 1) & 3];
        return;
    }
    double radians = degrees * (3.14159265358979323846 / 180);
    *sine = sin(radians);
    *cosine = cos(radians);
}

static transform rotate_axis(int axis, double degrees)
{
    transform t = transform_identity();
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    double sine, cosine;

    sine_cosine(degrees, &sine, &cosine);
    t.m[u][u] = t.m[v][v] = cosine;
    t.m[u][v] = -sine;
    t.m[v][u] = sine;
    return t;
}

transform transform_rotate(const double degrees[3])
{
    transform t = transform_identity();

    for (int axis = 0; axis < 3; axis++) {
        transform r = rotate_axis(axis, degrees[axis]);
        t = transform_then(&t, &r);
    }
    return t;
}

transform transform_matrix(const double v[12])
{
    transform t;

    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            t.m[row][column] = v[3 * column + row];
    return t;
}

transform transform_then(const transform *first, const transform *second)
{
    transform t;

    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            t.m[i][j] = j == 3 ? second->m[i][3] : 0;
            for (int k = 0; k < 3; k++)
                t.m[i][j] += second->m[i][k] * first->m[k][j];
        }
    }
    return t;
}

static double cofactor(const transform *t, int i, int j)
{
    int r = (i + 1) % 3, s = (i + 2) % 3;
    int u = (j + 1) % 3, v = (j + 2) % 3;

    return t->m[r][u] * t->m[s][v] - t->m[r][v] * t->m[s][u];
}

bool transform_inverse(const transform *t, transform *out)
{
    transform inverse;
    double det = 0;

    for (int j = 0; j < 3; j++)
        det += t->m[0][j] * cofactor(t, 0, j);
    if (!isfinite(1 / det))
        return false;
    for (int i = 0; i < 3; i++) {
        inverse.m[i][3] = 0;
        for (int j = 0; j < 3; j++) {
            inverse.m[i][j] = cofactor(t, j, i) / det;
            inverse.m[i][3] -= inverse.m[i][j] * t->m[j][3];
        }
        for (int j = 0; j < 4; j++)
            if (!isfinite(inverse.m[i][j]))
                return false;
    }
    *out = inverse;
    return true;
}

bool transform_is_identity(const transform *t)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            if (t->m[i][j] != (i == j))
                return false;
    return true;
}

void transform_vector(const transform *t, const double v[3], double out[3])
{
    double image[3];

    for (int i = 0; i < 3; i++)
        image[i] = t->m[i][0] * v[0] + t->m[i][1] * v[1] + t->m[i][2] * v[2];
    memcpy(out, image, sizeof image);
}

void transform_point(const transform *t, const double p[3], double out[3])
{
    transform_vector(t, p, out);
    for (int i = 0; i < 3; i++)
        out[i] += t->m[i][3];
}
