#!/usr/bin/env python3
"""Slope, aoi and normals of POV-Ray: what tests/unit/test_pattern_normal.c has.

Slopes are seen on discs that lean by -80 to 80 degrees in steps of 32, the
k-th at x = k - 2.5; normals on a sphere of radius 1 under three lights, from
which the normal follows.
"""
from math import sqrt

from renderer import render

SLOPES = ("slope { y }", "slope { y, 0.25, 1.25 }", "aoi",
          "slope { <0, 0.5, 0>, 0, 1 altitude <2, 0, 0>, -8, 8 }",
          "slope { point_at <3, 7, -4> }")
NORMALS = ("facets size 0.5", "facets size 0.3", "facets coords 0.7",
           "bumps 0.4", "dents 1.5", "wrinkles -0.4",
           "quilted 0.4 control0 0.25 control1 0.75",
           "ripples 0.4 frequency 2 phase 0.25",
           "waves 0.4 frequency 2 phase 0.25", "leopard 0.4",
           "bozo 0.4 accuracy 0.1")
CAMERA = """#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -50*z direction z right %s*x up %s*y }
"""
LIGHTS = ((0.6, 0.2, -1), (-0.6, 0.3, -1), (0.1, -0.7, -1))


def slopes(pattern):
    scene = CAMERA % (6, 1)
    for k in range(6):
        scene += f"""disc {{ 0, -z, 0.45 rotate {-80 + 32 * k}*x
            translate {k - 2.5}*x
            pigment {{ {pattern} color_map {{ [0 rgb 0] [1 rgb 1] }} }}
            finish {{ ambient 1 diffuse 0 }} }}\n"""
    return [pixel[0] for pixel in render(scene, 6, 1)[0]]


def solve(a, b):
    """Cramer's rule, of three."""
    def det(m):
        return sum(m[0][i] * (m[1][i - 2] * m[2][i - 1]
                              - m[1][i - 1] * m[2][i - 2]) for i in range(3))
    return [det([[b[r] if c == k else a[r][c] for c in range(3)]
                 for r in range(3)]) / det(a) for k in range(3)]


def normals(words):
    scene = CAMERA % (1.2, 1.2)
    lights = [[c / sqrt(sum(d * d for d in light)) for c in light]
              for light in LIGHTS]
    for light, colour in zip(lights, "xyz"):
        x, y, z = (c * 1e5 for c in light)
        scene += (f"light_source {{ <{x}, {y}, {z}> rgb 0.5*{colour} parallel"
                  " point_at 0 shadowless }\n")
    scene += ("sphere { 0, 1 pigment { rgb 1 } finish { ambient 0 diffuse 1 }"
              f" normal {{ {words} }} }}\n")
    for row, pixels in enumerate(render(scene, 4, 4)):
        for column, pixel in enumerate(pixels):
            x, y = -0.45 + 0.3 * column, 0.45 - 0.3 * row
            if row % 2 == column % 2:
                yield (x, y), solve(lights, [2 * c for c in pixel])


for text in SLOPES:
    print(text, *(f"{v:.5f}" for v in slopes(text)))
for text in NORMALS:
    print(text)
    for at, normal in normals(text):
        print("   ", *(f"{c:.2f}" for c in at),
              *(f"{c:.5f}" for c in normal))
