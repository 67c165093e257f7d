#include "core/check.h"
#include <math.h>
#include "core/matrix.h"

bool check_finite(const double *v, size_t n, const char *what,
                  struct brume_error *err)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(v[i]))
            return brume_fail(err, BRUME_ERR_SCENE, "%s is not finite", what);
    return true;
}

bool check_not_negative(const double *v, size_t n, const char *what,
                        struct brume_error *err)
{
    if (!check_finite(v, n, what, err))
        return false;
    for (size_t i = 0; i < n; i++)
        if (v[i] < 0.0)
            return brume_fail(err, BRUME_ERR_SCENE,
                              "%s is %g but may not be negative", what, v[i]);
    return true;
}

bool check_id(int id, size_t count, bool optional, const char *what,
              struct brume_error *err)
{
    if ((id >= 0 && (size_t)id < count) || (optional && id == -1))
        return true;
    return brume_fail(err, BRUME_ERR_SCENE, "there is no %s %d", what, id);
}

bool check_transform(const double m[3][4], const char *what,
                     struct brume_error *err)
{
    matrix a = matrix_from(m), inverse;
    if (matrix_finite(&a) && matrix_invert(&a, &inverse))
        return true;
    return brume_fail(err, BRUME_ERR_SCENE,
                      "the transform of %s has no inverse", what);
}
