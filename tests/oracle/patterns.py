#!/usr/bin/env python3
"""Values of POV-Ray's noise, patterns and warps at a few points.

    tests/oracle/patterns.py tests/data

writes noise.txt, patterns.txt and warps.txt there, which unit tests read. Of each point
noise.txt has x y z, the noise of generators 1, 2 and 3, the vector noise and
two vector turbulences. patterns.txt has the points first; then of each case a
line of words, and the value at each point. The words are the kind, its
numbers, `item` if it is a block pattern, `turbulence` and the numbers of a
turbulence that moves the point before, `wave` and type, exponent, frequency
and phase. Fractals are looked up nearer to the origin (see below). warps.txt
is like it, with the coordinates of the warped point as values.
"""
import os
import random
import sys

from values import values

NOISE_TURBULENCES = ((6, 2, 0.5), (4, 1.7, 0.7))    # octaves, lambda, omega
SERIES = "6 2 0.5"


def points(seed, sizes=(1, 3, 40, 600), each=10):
    r = random.Random(seed)
    return [[round(r.uniform(-size, size), 4) for _ in range(3)]
            for size in sizes for _ in range(each)]


def near(p):
    """Not further out than 1 in any coordinate."""
    size = max(map(abs, p))
    return [c / size for c in p] if size > 1 else p


def vector(p):
    return "<" + ", ".join(map(str, p)) + ">"


def noise(file):
    for p in points(1):
        at = ", ".join(map(str, p))
        texts = [f"f_noise_generator({at}, {i})" for i in (1, 2, 3)]
        for octaves, scale, weight in ((1, 2, 0.5),) + NOISE_TURBULENCES:
            texts += [f"vturbulence({scale}, {weight}, {octaves},"
                      f" {vector(p)}).{axis}" for axis in "xyz"]
        found = values(texts, '#include "functions.inc"\n')
        print(*p, *(f"{v:.15g}" for v in found), file=file)


def wave(kind, exponent=1, frequency=1, phase=0):
    return f"wave {kind} {exponent} {frequency} {phase}"


# Words of the case, and the pattern that POV-Ray is asked for.
CASES = [
    (f"agate 2 {SERIES} 1", "agate"),
    (f"agate 1 {SERIES} -2.5", "agate agate_turb -2.5 noise_generator 1"),
    ("agate 2 3 3 0.25 1 turbulence 3 3 0.25 0.5 0.25 1",
     "agate turbulence <0.5, 0.25, 1> octaves 3 lambda 3 omega 0.25"),
    ("boxed", "boxed"),
    ("bozo 1", "bozo noise_generator 1"),
    ("bozo 2", "bumps"),
    ("bozo 3", "spotted noise_generator 3"),
    ("brick 8 3 4.5 0.5 item", "brick rgb 0, rgb 1"),
    ("brick 2 0.7 5 0.25 item",
     "brick rgb 0, rgb 1 brick_size <2, 0.7, 5> mortar 0.25"),
    ("cells", "cells"),
    ("checker item", "checker rgb 0, rgb 1"),
    ("cubic item", "cubic rgb 0, rgb 1, rgb 2, rgb 3, rgb 4, rgb 5"),
    ("hexagon item", "hexagon rgb 0, rgb 1, rgb 2"),
    ("square item", "square rgb 0, rgb 1, rgb 2, rgb 3"),
    ("triangular item",
     "triangular rgb 0, rgb 1, rgb 2, rgb 3, rgb 4, rgb 5"),
    ("crackle 2 -1 1 0 2 0 0", "crackle"),
    ("crackle 2 0.2 0.1 0.1 2 0.3 0",
     "crackle form <0.2, 0.1, 0.1> offset 0.3"),
    ("crackle 2 0 0.4 0 1 0.25 0", "crackle form 0.4*y metric 1 offset 0.25"),
    ("crackle 2 0.5 0 0.1 3 0.25 0",
     "crackle form <0.5, 0, 0.1> metric 3 offset 0.25"),
    ("crackle 3 -1 1 0 2 0 1", "crackle solid noise_generator 3"),
    ("cylindrical", "cylindrical"),
    ("dents 2", "dents"),
    ("gradient 1 2 -0.5", "gradient <1, 2, -0.5>"),
    ("granite 1", "granite noise_generator 1"),
    ("granite 2", "granite"),
    ("granite 3", "granite noise_generator 3"),
    ("leopard", "leopard"),
    (f"marble 2 {SERIES} 0 {wave('TRIANGLE')}", "marble"),
    (f"marble 2 {SERIES} 0.7", "marble turbulence 0.7 ramp_wave"),
    ("marble 3 4 3 0.7 -1.2", "marble turbulence -1.2*x octaves 4 lambda 3"
     " omega 0.7 ramp_wave noise_generator 3"),
    ("onion", "onion"),
    ("quilted 1 1", "quilted"),
    ("quilted 0.25 -0.5", "quilted control0 0.25 control1 -0.5"),
    ("planar", "planar"),
    ("radial", "radial"),
    ("ripples 10 1 0", "ripples"),
    (f"ripples 10 2 0.25 {wave('RAMP', 1, 2, 0.25)}",
     "ripples frequency 2 phase 0.25"),
    ("spherical", "spherical"),
    (f"spiral1 2 {SERIES} 0 3 {wave('TRIANGLE')}", "spiral1 3"),
    (f"spiral1 2 {SERIES} 0.5 2 turbulence {SERIES} 0.5 0.25 1",
     "spiral1 2 turbulence <0.5, 0.25, 1> ramp_wave"),
    (f"spiral2 2 {SERIES} 0 5 {wave('TRIANGLE')}", "spiral2 5"),
    (f"spiral2 2 {SERIES} 0.5 2 turbulence {SERIES} 0.5 0.25 1",
     "spiral2 2 turbulence <0.5, 0.25, 1> ramp_wave"),
    ("waves 10 1 0", "waves"),
    (f"waves 10 2 0.25 {wave('RAMP', 1, 2, 0.25)}",
     "waves frequency 2 phase 0.25"),
    (f"wood {SERIES} 0 0 {wave('TRIANGLE')}", "wood"),
    (f"wood {SERIES} 0.5 0.25", "wood turbulence <0.5, 0.25, 1> ramp_wave"),
    ("wrinkles 1", "wrinkles noise_generator 1"),
    ("wrinkles 2", "wrinkles"),
    ("wrinkles 3", "wrinkles noise_generator 3"),
    (f"wood {SERIES} 0 0 turbulence {SERIES} 0.5 0.25 1",
     "wood warp { turbulence <0.5, 0.25, 1> } ramp_wave"),
] + [(f"tiling {i} item", f"tiling {i} color_map {{ [0 rgb 0] [1 rgb 1] }}")
     for i in range(1, 25)
] + [(f"pavement {sides} {tiles} {variant} item",
      f"pavement number_of_sides {sides} number_of_tiles {tiles}"
      f" pattern {variant} color_map {{ [0 rgb 0] [1 rgb 1] }}")
     for sides, tiles, variant in (
         (3, 1, 1), (3, 3, 1), (3, 5, 3), (3, 6, 5), (3, 6, 12), (4, 1, 1),
         (4, 4, 5), (4, 6, 20), (4, 6, 35), (6, 1, 1), (6, 3, 3), (6, 5, 22))
] + [(f"fractal {magnet} 20 {exponent} {exterior} 0.25 {interior} 0.5"
      f" {1 if julia else 0} {julia or '0 0'}",
      (f"magnet {magnet} " if magnet else "")
      + (f"julia <{julia.replace(' ', ',')}>," if julia else "mandel")
      + (" 20" if magnet else f" 20 exponent {exponent}")
      + f" exterior {exterior}, 0.25 interior {interior}, 0.5")
     for magnet, exponent, exterior, interior, julia in (
         [(0, 2, i, i, "") for i in range(7)]
         + [(0, 3, 1, 1, ""), (0, 4, 2, 5, ""), (0, 7, 6, 0, ""),
            (0, 33, 1, 1, ""), (0, 2, 1, 1, "0.353 0.288"),
            (0, 5, 4, 6, "0.6 0.3"), (1, 2, 1, 1, ""), (1, 2, 2, 6, ""),
            (2, 2, 1, 2, ""), (2, 2, 5, 3, ""), (1, 2, 1, 1, "1.2 0.7"),
            (2, 2, 6, 6, "1.5 -0.3")])
] + [(f"gradient 1 1 1 {wave(kind.upper(), exponent, frequency, phase)}",
      f"gradient <1, 1, 1> {kind}_wave {exponent if kind == 'poly' else ''}"
      f" frequency {frequency} phase {phase}")
     for kind in ("ramp", "triangle", "sine", "scallop", "cubic", "poly")
     for exponent, frequency, phase in ((1, 1, 0), (0.5, -2.5, 0.25),
                                        (2, 0, 3))]


def patterns(file):
    print(len(points(2)), file=file)
    for p in points(2):
        print(*p, file=file)
    for words, text in CASES:
        item = words.endswith("item")
        move = near if words.startswith("fractal") else list
        found = values(
            [f"F({', '.join(map(repr, move(p)))})" + ".x" * item
             for p in points(2)],
            "#declare F = function {"
            f" {'pigment' if item else 'pattern'} {{ {text} }} }}\n")
        print(words, file=file)
        print(*(f"{v:.12g}" for v in found), file=file)


WARPS = [
    ("turbulence 6 2 0.5 0.5 0.25 1", "turbulence <0.5, 0.25, 1>"),
    ("turbulence 3 1.5 0.3 0 1 1",
     "turbulence <0, 1, 1> octaves 3 lambda 1.5 omega 0.3"),
    ("repeat 0 2 0 0 0 0 0 0", "repeat 2*x"),
    ("repeat 1 -1.5 0.1 0.2 0.3 0 0 0",
     "repeat -1.5*y offset <0.1, 0.2, 0.3>"),
    ("repeat 2 0.7 0.1 0.2 0.3 1 0 1",
     "repeat 0.7*z offset <0.1, 0.2, 0.3> flip <1, 0, 1>"),
    ("black_hole 0.1 0.2 0.3 1.5 1 2 0 0 0 0 0 0 0 0",
     "black_hole <0.1, 0.2, 0.3>, 1.5"),
    ("black_hole 0.1 0.2 0.3 2.5 1.8 0.5 1 0 0 0 0 0 0 0",
     "black_hole <0.1, 0.2, 0.3>, 2.5 strength 1.8 falloff 0.5 inverse"),
    ("black_hole 0.7 0.7 0.7 0.6 1 2 0 2 1.5 0 0 0 0 0",
     "black_hole <0.7, 0.7, 0.7>, 0.6 repeat <2, 1.5, 0>"),
    ("black_hole 0.7 0.7 0.7 0.6 1 1 0 2 2 2 0.5 0.6 0.4 1",
     "black_hole <0.7, 0.7, 0.7>, 0.6 falloff 1 repeat <2, 2, 2>"
     " turbulence <0.5, 0.6, 0.4>"),
    ("planar 0 0 1 0", "planar"),
    ("planar 0.6 -0.8 0 0.5", "planar <0.6, -0.8, 0>, 0.5"),
    ("cylindrical 0 0 1 0", "cylindrical"),
    ("cylindrical 0 1 0 1", "cylindrical orientation y dist_exp 1"),
    ("spherical 0 0 1 0", "spherical"),
    ("spherical 0.6 0 -0.8 0.5",
     "spherical orientation <0.6, 0, -0.8> dist_exp 0.5"),
    ("toroidal 0 0 1 0 1", "toroidal"),
    ("toroidal 0 0.8 0.6 1 2.5",
     "toroidal orientation <0, 0.8, 0.6> dist_exp 1 major_radius 2.5"),
    ("cubic", "cubic"),
]

SPAN = 8192     # patterns wrap at 1: coordinates are looked at through this


def warps(file):
    print(len(points(2)), file=file)
    for p in points(2):
        print(*p, file=file)
    for words, text in WARPS:
        print(words, file=file)
        found = [values([f"F({', '.join(map(str, p))})" for p in points(2)],
                        f"#declare F = function {{ pattern {{ function {{"
                        f" {axis} / {SPAN} + 0.5 }} warp {{ {text} }} }} }}\n")
                 for axis in "xyz"]
        print(*(f"{(v - 0.5) * SPAN:.12g}" for p in zip(*found) for v in p),
              file=file)


def main(folder):
    for write in (noise, patterns, warps):
        with open(os.path.join(folder, write.__name__ + ".txt"), "w") as file:
            write(file)


if __name__ == "__main__":
    main(*sys.argv[1:])
