#!/usr/bin/env python3
"""The tables of POV-Ray's noise, worked out from values that it prints.

    tests/oracle/noise_tables.py core/physics

writes noise_table.h, perlin_table.h and cell_table.h there. How:

Generators 1 and 2 are lattice noise. At a lattice point the value is that of
the point's entry, and on an edge between two of them it is

    (1 - s) (v0 + g0 t) + s (v1 + g1 (t - 1)),  s = 3 t^2 - 2 t^3,

so that values at lattice points and slopes there give all entries. They are
windows of one list: v and the three slopes stand one behind the other, and
the next entry begins one further. The vector noise reads on, four by four.
Which entry a point has is P[P[P[x] ^ y] ^ z] & 255 with x, y, z counted from
an origin far off (ORIGIN), P a permutation of 4096: rows along z, matched
against one another, give P[x] ^ P[0], and consistency the rest.

Generator 3 is gradient noise on a lattice shifted by SHIFT, period 2048, with
gradients that are integer vectors, normalised, numbered p[p[x] + y] + z.

What cells and crackle need are the first numbers of a Mersenne twister (MT
19937, seed 5489; Matsumoto & Nishimura 1998), numbered by P without ORIGIN.
"""
import os
import sys

from tables import table
from values import values

SIZE, ORIGIN = 4096, 10000
PERLIN, SHIFT, LOW, SPAN = 2048, 0.0231572125, 0.4925, 0.795


def noise(points, generator):
    return values([f"f_noise_generator({x:.17g}, {y:.17g}, {z:.17g},"
                   f" {generator})" for x, y, z in points],
                  '#include "functions.inc"\n')


def vectors(points):
    found = values([f"vturbulence(2, 0.5, 1, <{x:.17g}, {y:.17g}, {z:.17g}>)"
                    f".{c}" for x, y, z in points for c in "xyz"])
    return [found[i:i + 3] for i in range(0, len(found), 3)]


def edge_slope(at_third, at_two_thirds):
    """Of v0 = v1 = 0: the slope at the edge's begin."""
    def row(t):
        s = t * t * (3 - 2 * t)
        return (1 - s) * t, s * (t - 1)
    (a, b), (c, d) = row(1 / 3), row(2 / 3)
    return (d * at_third - b * at_two_thirds) / (a * d - b * c)


def along(axis, point, t):
    moved = list(point)
    moved[axis] += t
    return moved


# ----------------------------------------------------------- generators 1, 2

def lattice_list():
    """The 267 numbers, and the value at a lattice point of each entry."""
    line = [(0, 0, z) for z in range(SIZE)]
    first = {}
    for point, value in zip(line, noise(line, 1)):
        first.setdefault(value, point)
    h = 1e-5
    probes = [along(axis, p, t) for p in first.values() for axis in range(3)
              for t in (h, -h, 2 * h, -2 * h)]
    found = iter(noise(probes, 1))
    entries = []        # value doubled, slopes
    for value in first:
        slopes = []
        for _ in range(3):
            a, b, c, d = (next(found) for _ in range(4))
            slopes.append((a - b) / h - (c - d) / (4 * h))
        entries.append([2 * value - 1] + slopes)
    chain = [min(entries)]
    chain[0][1] *= 2    # its value is cut off below, its slopes seen one-sided
    while len(chain) < len(entries):
        chain.append(min(entries, key=lambda e: abs(e[0] - chain[-1][1])))
    numbers = [e[0] for e in chain] + chain[-1][1:]
    keys = {min(first, key=lambda v: abs(2 * v - 1 - e[0])): i
            for i, e in enumerate(chain)}
    return [float(f"{n:.6g}") for n in numbers], keys


def permutation(keys):
    def rows(points):
        entries = [keys[v] for v in noise(points, 1)]
        return [tuple(entries[i:i + 4]) for i in range(0, len(entries), 4)]

    def shifted(items):
        return [items[(i - ORIGIN) % SIZE] for i in range(SIZE)]

    t = shifted([keys[v] for v in noise([(0, 0, z) for z in range(SIZE)], 1)])
    o = ORIGIN % SIZE
    which = {tuple(t[d ^ (o + z)] for z in range(4)): d for d in range(SIZE)}
    r = shifted([which[row] for row in rows(
        [(0, y, z) for y in range(SIZE) for z in range(4)])])
    pair = {(r[d ^ o], r[d ^ (o + 1)], r[d ^ (o + 2)]): d for d in range(SIZE)}
    columns = [shifted([which[row] for row in rows(
        [(x, y, z) for x in range(SIZE) for z in range(4)])])
        for y in range(3)]
    s = [pair[c] for c in zip(*columns)]
    for b in range(SIZE):
        p = [v ^ b for v in s]
        a = p[b ^ o]
        if all(p[b ^ i] ^ a == r[i] and p[a ^ i] & 255 == t[i]
               for i in range(SIZE)):
            return p
    raise RuntimeError("no permutation fits")


def entry(p, x, y, z):
    i = [(c + ORIGIN) % SIZE for c in (x, y, z)]
    return p[p[p[i[0]] ^ i[1]] ^ i[2]] & 255


def tail(numbers, p):
    """Numbers 259 to 266, which the vector noise alone reads."""
    numbers = numbers + [None] * 8
    point = next((x, 0, 0) for x in range(SIZE) if entry(p, x, 0, 0) == 255)
    h = 1e-5
    probes = [point] + [along(axis, point, t) for axis in range(3)
                        for t in (h, -h, 2 * h, -2 * h)]
    found = vectors(probes)
    for i in (1, 2):
        at = 255 + 4 * i
        numbers[at] = 2 * found[0][i]
        for axis in range(3):
            a, b, c, d = (found[1 + 4 * axis + k][i] for k in range(4))
            numbers[at + 1 + axis] = (a - b) / h - (c - d) / (4 * h)
    return [float(f"{n:.6g}") for n in numbers]


# -------------------------------------------------------------- generator 3

def perlin_gradients(points):
    probes = [[c - SHIFT for c in along(axis, p, t)] for p in points
              for axis in range(3) for t in (1 / 3, 2 / 3)]
    found = [(v - LOW) / SPAN for v in noise(probes, 3)]
    slopes = [edge_slope(*found[i:i + 2]) for i in range(0, len(found), 2)]
    return [slopes[i:i + 3] for i in range(0, len(slopes), 3)]


def integer_vector(g):
    largest = max(g, key=abs)
    for k in range(1, PERLIN + 1):
        v = [k * c / abs(largest) for c in g]
        if all(abs(c - round(c)) < 3e-5 for c in v):
            return [round(c) for c in v]
    raise RuntimeError("no integer direction")


def perlin_tables():
    line = perlin_gradients([(0, 0, z) for z in range(PERLIN)])
    ordered = sorted((g, i) for i, g in enumerate(line))

    def number(g):
        low, high = 0, len(ordered)
        while low < high:
            middle = (low + high) // 2
            if ordered[middle][0][0] < g[0] - 1e-6:
                low = middle + 1
            else:
                high = middle
        while max(abs(a - b) for a, b in zip(ordered[low][0], g)) > 1e-6:
            low += 1
        return ordered[low][1]

    r = [number(g) for g in perlin_gradients(
        [(0, y, 0) for y in range(PERLIN)])]
    pair = {(r[d], r[(d + 1) % PERLIN]): d for d in range(PERLIN)}
    found = [number(g) for g in perlin_gradients(
        [(x, y, 0) for x in range(PERLIN) for y in (0, 1)])]
    x = [pair[tuple(found[i:i + 2])] for i in range(0, len(found), 2)]
    for first in range(PERLIN):
        if len({(r[(i - first) % PERLIN] - x[i]) % PERLIN
                for i in range(PERLIN)}) == 1:
            break
    p = [(v + first) % PERLIN for v in x]
    b = p[first] - r[0]
    vector = [integer_vector(g) for g in line]
    return p, [c for i in range(PERLIN) for c in vector[(i - b) % PERLIN]]


# --------------------------------------------------------- cells and crackle

def mersenne_twister(count, seed=5489):
    n, m = 624, 397
    state = [seed]
    for i in range(1, n):
        state.append((1812433253 * (state[-1] ^ state[-1] >> 30) + i)
                     & 0xffffffff)
    numbers = []
    for i in range(count):
        y = state[i] & 0x80000000 | state[i + 1] & 0x7fffffff
        state.append(state[i + m] ^ y >> 1 ^ (y & 1) * 0x9908b0df)
        y = state[-1]
        y ^= y >> 11
        y ^= y << 7 & 0x9d2c5680
        y ^= y << 15 & 0xefc60000
        numbers.append(y ^ y >> 18)
    return numbers


# -------------------------------------------------------------------- output

def header(folder, name, comment, *tables):
    guard = f"CORE_PHYSICS_{name.upper()}_H"
    with open(os.path.join(folder, name + ".h"), "w") as file:
        file.write(f"/* {name}.h - {comment}\n * Written by"
                   " tests/oracle/noise_tables.py. */\n"
                   f"#ifndef {guard}\n#define {guard}\n"
                   '#include "core/physics/hd.h"\n'
                   '#include "core/physics/real.h"\n\n'
                   + "\n".join(tables) + "\n#endif\n")


def main(folder):
    numbers, keys = lattice_list()
    p = permutation(keys)
    numbers = tail(numbers, p)
    header(folder, "noise_table", "lattice noise: a permutation, and values"
           " and slopes\n * times 1e8.",
           table("uint16_t", "noise_permutation", p),
           table("real", "noise_lattice", [f"REAL({round(n * 1e8)}.0)"
                                           for n in numbers]))
    p, gradients = perlin_tables()
    header(folder, "perlin_table", "gradient noise: numbers of the gradients,"
           " and directions,\n * three integers each.",
           table("uint16_t", "perlin_permutation", p),
           table("int16_t", "perlin_gradient", gradients))
    header(folder, "cell_table", "random numbers of cells, times 2^32.",
           table("uint32_t", "cell_random", mersenne_twister(SIZE + 2)))


if __name__ == "__main__":
    main(*sys.argv[1:])
