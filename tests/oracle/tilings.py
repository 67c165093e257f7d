#!/usr/bin/env python3
"""The tiles of POV-Ray's tiling pattern, worked out from its values.

    tests/oracle/tilings.py core/physics        (needs numpy; two minutes)

writes tiling_table.h. A tile of type t of N has the value (t + 1) / N at its
edge, falling inwards by a constant slope down to t / N. So on a grid of points
tiles are found by flooding (no step may pass an edge), their edges from value
and gradient, the periods by trying the ways from tile to tile. All edges turn
out to stand at multiples of 15 degrees, at quarters of whole numbers and of
multiples of a square root from the origin, to which they are rounded.
Tilings 25 to 27, which do not repeat, are left out.
"""
import math
import os
import random
import sys

import numpy as np

from tables import table
from values import values

TYPES = (1, 1, 2, 1, 3, 2, 2, 3, 3, 1, 3, 3, 3, 5, 2, 3, 6, 2, 3, 3, 6, 3, 3,
         5)
EDGE, STEP, DELTA = 5.0, 0.05, 0.004
SLOPES = (1, math.sqrt(0.75))       # one tile has two, the others one
HALVES_OF_ROOT_2 = (7, 13, 14)      # the others have the root of 3


def tiling(number, points):
    return np.array(values(
        [f"F({x:.9g}, 0.2, {z:.9g}).x" for x, z in points],
        f"#declare F = function {{ pigment {{ tiling {number}"
        " color_map { [0 rgb 0] [1 rgb 1] } } }\n"))


class Grid:
    """Values, gradients, types and distances to the edge, on a grid."""

    def __init__(self, number):
        self.at = np.arange(-EDGE, EDGE, STEP) + 0.0137
        count = len(self.at)
        points = [(x + a, z + b) for x in self.at for z in self.at + 0.0071
                  for a, b in ((0, 0), (DELTA, 0), (0, DELTA))]
        found = tiling(number, points).reshape(count, count, 3)
        self.value = found[..., 0]
        self.gx = (found[..., 1] - self.value) / DELTA
        self.gz = (found[..., 2] - self.value) / DELTA
        self.slope = np.hypot(self.gx, self.gz)
        self.types = TYPES[number - 1]
        self.type = np.maximum(
            np.ceil(self.value * self.types - 1e-6) - 1, 0)
        self.usual = np.median(self.slope[self.slope > 0.1])
        self.depth = ((self.type + 1) / self.types - self.value) / self.usual

    def point(self, i, j):
        return np.array([self.at[i], self.at[j] + 0.0071])

    def tiles(self):
        """Lists of cells, of the tiles that do not touch the border."""
        count = len(self.at)
        seen = np.zeros((count, count), bool)
        for first in np.ndindex(count, count):
            if seen[first] or self.depth[first] < STEP:
                continue
            seen[first] = True
            cells, stack = [], [first]
            while stack:
                i, j = stack.pop()
                cells.append((i, j))
                for k in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
                    if (0 <= min(k) and max(k) < count and not seen[k]
                            and self.type[k] == self.type[i, j]
                            and self.depth[k] + self.depth[i, j]
                            > 1.3 * STEP):
                        seen[k] = True
                        stack.append(k)
            flat = [c for cell in cells for c in cell]
            if len(cells) > 3 and min(flat) > 0 and max(flat) < count - 1:
                yield cells

    def edges(self, cells):
        """(normal, offset, slope) of each line that some cells are nearest
        to."""
        top = (self.type[cells[0]] + 1) / self.types
        groups = {}
        for cell in cells:
            slope = self.slope[cell]
            if min(abs(slope / self.usual - r) for r in SLOPES) > 0.01:
                continue
            n = np.array([self.gx[cell], self.gz[cell]]) / slope
            c = n @ self.point(*cell) + (top - self.value[cell]) / slope
            for m, d in groups:
                if math.dist(n, m) < 0.05 and abs(c - d) < 0.1:
                    groups[m, d].append(cell)
                    break
            else:
                groups[tuple(n), c] = [cell]
        for group in groups.values():
            a = np.array([(1, *self.point(*cell)) for cell in group])
            v = np.array([self.value[cell] for cell in group])
            for _ in range(2):      # the second time without what is off
                s = np.linalg.lstsq(a, v, rcond=None)[0]
                off = np.abs(a @ s - v)
                good = off <= max(3e-7, 4 * np.median(off))
                a, v = a[good], v[good]
            if len(v) >= 3:
                slope = np.hypot(*s[1:])
                yield s[1:] / slope, (top - s[0]) / slope, slope


def clip(polygon, n, c):
    result = []
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        da, db = c - n @ a, c - n @ b
        if da >= 0:
            result.append(a)
        if (da >= 0) != (db >= 0):
            result.append(a + (b - a) * (da / (da - db)))
    return result


def polygon_of(edges):
    polygon = [np.array(p, float) for p in ((-9, -9), (9, -9), (9, 9), (-9, 9))]
    for n, c, _ in edges:
        polygon = clip(polygon, n, c)
    return polygon


def length_on(polygon, n, c):
    on = [p for p in polygon if abs(c - n @ p) < 1e-4]
    return max((math.dist(a, b) for a in on for b in on), default=0)


def tiles_of(number):
    """(type, centre, edges)"""
    grid = Grid(number)
    for cells in grid.tiles():
        edges = list(grid.edges(cells))
        polygon = polygon_of(edges)
        if len(polygon) < 3 or np.abs(polygon).max() > 8.9:
            continue
        edges = [e for e in edges if length_on(polygon, *e[:2]) > 0.02]
        corners = polygon_of(edges)
        yield int(grid.type[cells[0]]), sum(corners) / len(corners), edges


def periods(number, tiles):
    first = min(tiles, key=lambda t: np.hypot(*t[1]))
    ways = sorted((t[1] - first[1] for t in tiles if t[0] == first[0]
                   and len(t[2]) == len(first[2])), key=lambda d: np.hypot(*d))
    r = random.Random(5)
    points = [(r.uniform(-3, 3), r.uniform(-3, 3)) for _ in range(60)]
    base = tiling(number, points)
    found = []
    for d in ways[1:]:
        moved = tiling(number, [(x + d[0], z + d[1]) for x, z in points])
        if np.sum(np.abs(moved - base) > 1e-4) <= 1:
            if not found:
                found.append(d)
            elif abs(found[0][0] * d[1] - found[0][1] * d[0]) > 0.05:
                return np.array([found[0], d]).T
    raise RuntimeError(f"tiling {number} does not repeat")


def quarters(number, c):
    """(i, j) of the nearest i / 4 + j / 4 sqrt(2 or 3)"""
    root = math.sqrt(2 if number in HALVES_OF_ROOT_2 else 3)
    near = ((round(4 * c - j * root), j) for j in range(-40, 41))
    best = min(near, key=lambda p: abs(4 * c - p[0] - p[1] * root))
    if abs(4 * c - best[0] - best[1] * root) > 4e-6:
        raise RuntimeError(f"tiling {number}: {c}")
    return best


def unique(number):
    """Periods, and the tiles of one cell as (type, ((turn, i, j, slope)
    ...)), turns being 15 degrees, i and j the offset."""
    tiles = list(tiles_of(number))
    matrix = periods(number, tiles)
    inverse = np.linalg.inv(matrix)
    result, centres = [], []
    for kind, centre, edges in tiles:
        shift = matrix @ np.floor(inverse @ centre + 1e-4)
        centre = centre - shift
        if any(math.dist(c, centre) < 0.01 for c in centres):
            continue
        centres.append(centre)
        result.append((kind, [
            (round(math.degrees(math.atan2(n[1], n[0])) / 15) % 24,
             *quarters(number, c - n @ shift), slope)
            for n, c, slope in edges]))
    return [q for c in matrix.T.flat for q in quarters(number, c)], result


def fixed(v):
    return round(v * 1e8)


def slope_of(tiles):
    """That of most edges: squares are rational."""
    square = max(e[3] for _, edges in tiles for e in edges) ** 2
    return math.sqrt(round(square * 2700) / 2700)


def main(folder):
    first, period, slopes = [0], [], []
    kinds, edge_first, edges = [], [0], []
    for number in range(1, len(TYPES) + 1):
        ways, tiles = unique(number)
        period += ways
        slopes.append(fixed(slope_of(tiles)))
        for kind, sides in tiles:
            kinds.append(kind)
            for turn, i, j, slope in sides:
                less = slope < 0.95 * slope_of(tiles)
                edges += [turn + 24 * less, i, j]
            edge_first.append(len(edges) // 3)
        first.append(len(kinds))
    with open(os.path.join(folder, "tiling_table.h"), "w") as file:
        file.write('''/* tiling_table.h - the tiles of each tiling.
 * Written by tests/oracle/tilings.py. A pair i, j is the length
 * (i + j root) / 4, the root being that of 2 or 3. */
#ifndef CORE_PHYSICS_TILING_TABLE_H
#define CORE_PHYSICS_TILING_TABLE_H
#include "core/physics/hd.h"

''' + "\n".join([
            "/* Types of tiles that a tiling has; of what its root is. */\n"
            + table("uint8_t", "tiling_types", TYPES)
            + table("uint8_t", "tiling_root",
                    [2 if i + 1 in HALVES_OF_ROOT_2 else 3
                     for i in range(len(TYPES))]),
            "/* By how much its value falls from edges inwards, times 1e8."
            " */\n" + table("int32_t", "tiling_slope", slopes),
            "/* Its first tile, and the end. */\n"
            + table("uint8_t", "tiling_first", first),
            "/* Two ways by which it repeats, x z x z, pairs. */\n"
            + table("int8_t", "tiling_period", period),
            "/* Cosines of multiples of 15 degrees, times 1e8. */\n"
            + table("int32_t", "tiling_cosine",
                    [fixed(math.cos(math.radians(15 * i)))
                     for i in range(24)]),
            table("uint8_t", "tile_type", kinds),
            "/* The first edge of each tile, and the end. */\n"
            + table("uint16_t", "tile_first", edge_first),
            "/* Of each edge: where it faces, in 15 degrees from x to z (24"
            " more: its slope\n * is less, by the root of 3/4); distance"
            " from the origin that way, a pair. */\n"
            + table("int8_t", "tile_edge", edges)]) + "\n#endif\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
