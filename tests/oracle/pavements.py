#!/usr/bin/env python3
"""The tiles of POV-Ray's pavement pattern, worked out from its values.

    tests/oracle/pavements.py core/physics

writes pavement_table.h. Tiles are made of squares, triangles or hexagons of
side 1. Where the value is 1 in the middle of a side, two tiles meet there. The
sides are numbered by points of a lattice: of squares those from a corner to +z
and to +x, of triangles those from a corner at 0, 60 and 120 degrees, of
hexagons those that face 30, 90 and 150 degrees. The shortest two ways along
which all sides repeat give the table's shape.
"""
import os
import sys
from math import cos, gcd, radians, sin, sqrt

from tables import table
from values import values

VARIANTS = {3: (1, 1, 1, 3, 4, 12), 4: (1, 1, 2, 5, 12, 35),
            6: (1, 1, 3, 7, 22)}
REACH = 12
HEIGHT = sqrt(0.75)


def middle(sides, i, j, side):
    if sides == 4:
        return (i, j + 0.5) if side == 0 else (i + 0.5, j)
    if sides == 3:
        di, dj = ((0.5, 0), (0, 0.5), (-0.5, 0.5))[side]
        return i + di + (j + dj) / 2, (j + dj) * HEIGHT
    turn = radians(30 + 60 * side)
    return (1 + 1.5 * i + HEIGHT * cos(turn),
            HEIGHT * (i + 2 * j + sin(turn)))


def borders(sides, tiles, variant):
    """By lattice point: a number of a bit for each side."""
    count = 2 if sides == 4 else 3
    places = [(i, j) for i in range(-REACH, REACH)
              for j in range(-REACH, REACH)]
    points = [middle(sides, i, j, side) for i, j in places
              for side in range(count)]
    found = values(
        [f"F({x:.9g}, 0.2, {z:.9g}).x" for x, z in points],
        "#declare F = function { pigment { pavement"
        f" number_of_sides {sides} number_of_tiles {tiles}"
        f" pattern {variant} color_map {{ [0 rgb 0] [1 rgb 1] }} }} }}\n")
    return {place: sum((found[count * k + side] > 0.99) << side
                       for side in range(count))
            for k, place in enumerate(places)}


def repeats(border, di, dj):
    return all(border.get((i + di, j + dj), bits) == bits
               for (i, j), bits in border.items())


def ways(border):
    candidates = sorted(((i, j) for i in range(-9, 10) for j in range(10)
                         if j or i > 0), key=lambda w: w[0] ** 2 + w[1] ** 2)
    first = next(w for w in candidates if repeats(border, *w))
    second = next(w for w in candidates
                  if first[0] * w[1] != first[1] * w[0]
                  and repeats(border, *w))
    return first, second


def shape(first, second):
    """Width, height and shift of a table that repeats along x by its width,
    and by its height and shift."""
    (a, b), (c, d) = first, second
    height = gcd(b, d)
    width = abs(a * d - b * c) // height
    shift = next((x * a + y * c) % width for x in range(-9, 10)
                 for y in range(-9, 10) if x * b + y * d == height)
    return width, height, shift


def main(folder):
    first, shapes, bits, group = [], [], [], []
    for sides, counts in VARIANTS.items():
        for tiles in range(1, 7):
            group.append(len(first))
            for variant in range(1, dict(enumerate(counts, 1)).get(tiles, 0)
                                 + 1):
                border = borders(sides, tiles, variant)
                width, height, shift = shape(*ways(border))
                first.append(len(bits))
                shapes += [width, height, shift]
                bits += [border[i - REACH // 2, j - REACH // 2]
                         for j in range(REACH // 2, REACH // 2 + height)
                         for i in range(REACH // 2, REACH // 2 + width)]
    group.append(len(first))
    with open(os.path.join(folder, "pavement_table.h"), "w") as file:
        file.write('''/* pavement_table.h - where tiles of pavements meet.
 * Written by tests/oracle/pavements.py. */
#ifndef CORE_PHYSICS_PAVEMENT_TABLE_H
#define CORE_PHYSICS_PAVEMENT_TABLE_H
#include "core/physics/hd.h"

''' + "\n".join([
            "/* The first pavement of 1 to 6 triangles, squares, hexagons; the"
            " end. */\n" + table("uint8_t", "pavement_group", group),
            "/* Of each: width and height of its table, and by how much the"
            " next table up is\n * shifted. */\n"
            + table("uint8_t", "pavement_shape", shapes),
            "/* Where its table begins. */\n"
            + table("uint16_t", "pavement_first", first),
            "/* A bit for each side of a lattice point: do tiles meet there?"
            " */\n" + table("uint8_t", "pavement_borders", bits)])
            + "\n#endif\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
