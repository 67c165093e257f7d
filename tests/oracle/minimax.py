#!/usr/bin/env python3
"""Coefficients of the polynomials in core/physics/fmath.h.

For each function a minimax fit of a weighted error, as a linear programme
over Chebyshev nodes; then the coefficients are rounded to float one by one,
lowest order first, and the others fitted again to what the rounding left.
Prints the coefficients and the largest weighted error as a power of two.
Needs mpmath, numpy and scipy.
"""
from struct import pack, unpack

import numpy as np
from mpmath import (asin, atan, atanh, cos, cospi, exp, expm1, fabs, log,
                    log1p, mp, mpf, pi, sin, sqrt)
from scipy.optimize import linprog

mp.dps = 40
NODES = 500
SCALE = 2.0 ** 26     # of the error, so that the solver's tolerance is small


def to_float(x):
    return unpack("f", pack("f", float(x)))[0]


def minimax(xs, rest, weight, powers):
    """Coefficients of x^powers nearest to `rest` in the weighted norm."""
    scale = max(abs(xs))
    basis = np.array([(xs / scale) ** p for p in powers]).T
    a = basis * weight[:, None]
    b = rest * weight * SCALE
    ones = np.ones((len(xs), 1))
    result = linprog(np.r_[np.zeros(len(powers)), 1],
                     np.block([[a, -ones], [-a, -ones]]), np.r_[b, -b],
                     bounds=[(None, None)] * (len(powers) + 1))
    return [c / SCALE / scale ** p for c, p in zip(result.x, powers)]


def fit(name, f, weight, lo, hi, degree):
    lo, hi = mpf(lo), mpf(hi)
    xs = [(lo + hi) / 2 - (hi - lo) / 2 * cospi(mpf(2 * i + 1) / (2 * NODES))
          for i in range(NODES)]
    f_xs = [f(x) for x in xs]
    w_xs = np.array([float(weight(x)) for x in xs])
    x_np = np.array([float(x) for x in xs])

    def rest(fixed):
        return np.array([float(y - sum(mpf(c) * x ** k
                                       for k, c in enumerate(fixed)))
                         for x, y in zip(xs, f_xs)])
    fixed = []
    for k in range(degree + 1):
        c = minimax(x_np, rest(fixed), w_xs, range(k, degree + 1))
        fixed.append(to_float(c[0]))
    worst = max(abs(rest(fixed) * w_xs))
    print(f"{name}: 2^{np.log2(worst):.1f}")
    for c in fixed:
        print(f"    {c:.9g}f  {c.hex()}")


def main():
    h = log(2) / 2
    fit("exp: (e^r - 1 - r) / r^2", lambda r: (expm1(r) - r) / r ** 2,
        lambda r: r ** 2 / expm1(r), -h, h, 5)
    fit("log: (log(1 + f) - f + f^2/2) / f^3",
        lambda f: (log1p(f) - f + f * f / 2) / f ** 3,
        lambda f: f ** 3 / log1p(f), sqrt(mpf(1) / 2) - 1, sqrt(mpf(2)) - 1, 8)
    q = (pi / 4) ** 2 * mpf("1.0001")
    fit("sin: (sin x / x - 1) / x^2, z = x^2",
        lambda z: (sin(sqrt(z)) / sqrt(z) - 1) / z,
        lambda z: z, 0, q, 3)
    fit("cos: (cos x - 1 + x^2/2) / x^4, z = x^2",
        lambda z: (cos(sqrt(z)) - 1 + z / 2) / z ** 2,
        lambda z: z ** 2 / cos(sqrt(z)), 0, q, 2)
    fit("atan: (atan x / x - 1) / x^2, z = x^2",
        lambda z: (atan(sqrt(z)) / sqrt(z) - 1) / z,
        lambda z: z ** 1.5 / atan(sqrt(z)), 0, 1, 8)
    fit("asin: (asin x / x - 1) / x^2, z = x^2",
        lambda z: (asin(sqrt(z)) / sqrt(z) - 1) / z,
        lambda z: z, 0, 0.25, 4)
    fit("exp2: (2^r - 1) / r", lambda r: expm1(r * log(2)) / r,
        lambda r: r / exp(r * log(2)), -0.5, 0.5, 6)
    s2 = mpf("0.0295")
    c = 2 / log(2)
    fit("log2: (2/ln 2) (atanh s / s - 1) / s^2, z = s^2",
        lambda z: c * (atanh(sqrt(z)) / sqrt(z) - 1) / z,
        lambda z: z / c, 0, s2, 3)


if __name__ == "__main__":
    main()
