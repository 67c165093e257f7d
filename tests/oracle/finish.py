#!/usr/bin/env python3
"""POV-Ray's finishes, measured against core/physics/surface.h.

A plane, tilted against an orthographic camera, is lit from far away in three
directions at once, one for each colour channel. Expected values are the
formulae of surface.h in double. The rows of tests/unit/test_surface.c are
some of those that this prints.
"""
import sys
from math import acos, cos, pi, radians, sin, sqrt

from renderer import Table, render

TILTS = (0, 30, 60)
ANGLES = ((0, 20, 40), (60, 75, 85), (-10, -30, -50))
VIEW = (0, 0, -1)
FINISHES = (
    {"diffuse": 0.6},
    {"diffuse": 0.6, "brilliance": 3},
    {"diffuse": 0.6, "brilliance": 0.5},
    {"phong": 0.7},
    {"phong": 0.7, "phong_size": 5},
    {"specular": 0.7},
    {"specular": 0.7, "roughness": 0.2},
    {"phong": 0.7, "phong_size": 1, "metallic": 1},
    {"specular": 0.7, "roughness": 1, "metallic": 0.5},
    {"diffuse": 0.3, "phong": 0.3, "phong_size": 3, "specular": 0.3},
)
PIGMENTS = ("rgb 0.3", "rgbft <0.3, 0.3, 0.3, 0.3, 0.2>")
OPACITY = {PIGMENTS[0]: 1, PIGMENTS[1]: 0.5}


def direction(angle, azimuth):
    """At `angle` degrees from the view, `azimuth` about it."""
    a, b = radians(angle), radians(azimuth)
    return sin(a) * cos(b), sin(a) * sin(b), -cos(a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def metal_curve(x, k=1.12):
    """Strauss 1990."""
    return ((1 / (x - k) ** 2 - 1 / k ** 2)
            / (1 / (1 - k) ** 2 - 1 / k ** 2))


def highlight(f, n, wi):
    total = 0
    mirror = [2 * dot(n, VIEW) * a - b for a, b in zip(n, VIEW)]
    if dot(mirror, wi) > 0:
        total += f.get("phong", 0) * dot(mirror, wi) ** f.get("phong_size", 40)
    half = [a + b for a, b in zip(wi, VIEW)]
    c = dot(n, half) / sqrt(dot(half, half))
    return total + f.get("specular", 0) * c ** (1 / f.get("roughness", 0.05))


def expected(f, pigment, n, wi):
    c = min(1, dot(n, wi))
    if c <= 0:
        return 0
    own = f.get("metallic", 0) * (1 - metal_curve(acos(c) / (pi / 2)))
    return (0.3 * OPACITY[pigment] * f.get("diffuse", 0)
            * c ** f.get("brilliance", 1)
            + highlight(f, n, wi) * (1 - own + 0.3 * own))


def scene(finish, pigment, normal, lights):
    items = " ".join(f"{key} {value}" for key, value in finish.items())
    sources = ""
    for i, w in enumerate(lights):
        color = [0, 0, 0]
        color[i] = 1
        sources += ("light_source {{ <{:.9f}, {:.9f}, {:.9f}>*1e6"
                    " rgb <{}, {}, {}> }}\n").format(*w, *color)
    return f"""#version 3.7;
global_settings {{ assumed_gamma 1 }}
camera {{ orthographic location -10*z right 0.001*x up 0.001*y direction z }}
{sources}
plane {{
    <{normal[0]:.9f}, {normal[1]:.9f}, {normal[2]:.9f}>, 0
    pigment {{ {pigment} }}
    finish {{ ambient 0 diffuse 0 {items} }}
}}
"""


def cases():
    for finish in FINISHES:
        for pigment in PIGMENTS:
            for tilt in TILTS:
                for angles in ANGLES:
                    yield finish, pigment, tilt, angles


def main():
    table = Table("radiance", 2e-5)
    for finish, pigment, tilt, angles in cases():
        normal = direction(tilt, 0)
        lights = [direction(a + tilt, 10 * (i + 1))
                  for i, a in enumerate(angles)]
        pixel = render(scene(finish, pigment, normal, lights))[1][1]
        for i, value in enumerate(pixel):
            name = (f"{finish}, opacity {OPACITY[pigment]}: {tilt}"
                    f" {angles[i] + tilt} {10 * (i + 1)}")
            table.row(name, value, expected(finish, pigment, normal, lights[i]))
    return table.failed != 0


if __name__ == "__main__":
    sys.exit(main())
