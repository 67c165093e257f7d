#!/usr/bin/env python3
"""POV-Ray's spot cones and fading, measured against core/physics/light.h.

A light 10 above a plane that reflects the same at any angle (brilliance 0),
seen in a row of pixels from below the light outward. Prints the largest
difference of each light's row.
"""
import sys
from math import cos, hypot, radians

from renderer import Table, render

HEIGHT, REACH, PIXELS = 10, 20, 80
SPOTS = ((30, 45, 0), (10, 40, 0), (20, 50, 10), (0, 60, 0), (50, 30, 0),
         (50, 30, 3), (30, 30, 0), (30, 90, 0), (30, 150, 0))
FADES = ((3, 1.5), (3, 2), (0, 2), (15, 0))


def spot(radius, falloff, tightness, x):
    c = HEIGHT / hypot(HEIGHT, x)
    inner, outer = cos(radians(radius)), cos(radians(falloff))
    if c <= min(inner, outer):
        return 0
    t = 1 if c >= inner else (c - outer) / (inner - outer)
    return c ** tightness * t * t * (3 - 2 * t)


def fade(distance, power, x):
    if distance == 0 or power == 0:
        return 1
    return 2 / (1 + (hypot(HEIGHT, x) / distance) ** power)


def row(items):
    scene = f"""#version 3.7;
global_settings {{ assumed_gamma 1 }}
camera {{
    orthographic location <{REACH / 2}, 0, {-HEIGHT}>
    right {REACH}*x up 0.001*y direction z
}}
light_source {{ <0, 0, {-HEIGHT}> rgb 1 {items} }}
plane {{
    -z, 0 pigment {{ rgb 1 }} finish {{ ambient 0 diffuse 1 brilliance 0 }}
}}
"""
    pixels = render(scene, PIXELS, 1)[0]
    return [(REACH * (i + 0.5) / PIXELS, p[0]) for i, p in enumerate(pixels)]


def main():
    table = Table("largest difference along a row", 2e-5)
    for s in SPOTS:
        items = "spotlight point_at 0 radius {} falloff {} tightness {}"
        worst = max(abs(v - spot(*s, x))
                    for x, v in row(items.format(*s)))
        table.row(f"radius, falloff, tightness {s}", worst, 0)
    for f in FADES:
        items = "fade_distance {} fade_power {}".format(*f)
        worst = max(abs(v - fade(*f, x)) for x, v in row(items))
        table.row(f"fade distance, power {f}", worst, 0)
    return table.failed != 0


if __name__ == "__main__":
    sys.exit(main())
