#!/usr/bin/env python3
"""POV-Ray's cones, tubes, areas and fading against core/physics/light.h.

A light 10 above a plane that reflects the same at any angle (brilliance 0),
seen in a row of pixels from below the light outward. Prints the largest
difference of each light's row. Figures of tests/unit/test_lights.c are here
too: parallel light, shadows of areas behind a knife's edge, highlights.
"""
import sys
from math import cos, hypot, radians

from renderer import Table, render

HEIGHT, REACH, PIXELS = 10, 20, 80
SPOTS = ((30, 45, 0), (10, 40, 0), (20, 50, 10), (0, 60, 0), (50, 30, 0),
         (50, 30, 3), (30, 30, 0), (30, 90, 0), (30, 150, 0))
TUBES = ((3, 6, 0), (3, 6, 10), (0, 8, 0), (6, 3, 0))
FADES = ((3, 1.5), (3, 2), (0, 2), (15, 0))


def spot(radius, falloff, tightness, x):
    c = HEIGHT / hypot(HEIGHT, x)
    inner, outer = cos(radians(radius)), cos(radians(falloff))
    if c <= min(inner, outer):
        return 0
    t = 1 if c >= inner else (c - outer) / (inner - outer)
    return c ** tightness * t * t * (3 - 2 * t)


def tube(radius, falloff, tightness, x):
    if x >= falloff:
        return 0
    sharp = x <= radius or radius == 0 or radius >= falloff
    t = 1 if sharp else (falloff - x) / (falloff - radius)
    return (1 - x / falloff) ** tightness * t * t * (3 - 2 * t)


def fade(distance, power, x):
    if distance == 0 or power == 0:
        return 1
    return 2 / (1 + (hypot(HEIGHT, x) / distance) ** power)


def row(items, location=(0, 0, -HEIGHT), finish="brilliance 0", more="",
        color=1, start=0, reach=REACH, pixels=PIXELS):
    scene = f"""#version 3.7;
global_settings {{ assumed_gamma 1 }}
camera {{
    orthographic location <{start + reach / 2}, 0, {-4 * HEIGHT}>
    right {reach}*x up 0.001*y direction z
}}
light_source {{ <{location[0]}, {location[1]}, {location[2]}>
    rgb {color} {items} }}
plane {{
    -z, 0 pigment {{ rgb 1 }} finish {{ ambient 0 diffuse 1 {finish} }}
}}
{more}
"""
    return [(start + reach * (i + 0.5) / pixels, p[0])
            for i, p in enumerate(render(scene, pixels, 1)[0])]


def at(x, items, **more):
    more = {"finish": "brilliance 0", **more}
    return row(items, color=0.5, start=x - 1e-4, reach=2e-4, pixels=1,
               **more)[0][1]


def figures(table):
    """One pixel of a row each, as the unit test has them."""
    knife = f"""box {{
        <-100, -100, {-HEIGHT / 2 - 0.01}>, <0, 100, {-HEIGHT / 2}>
        pigment {{ rgb 0 }} no_image
    }}"""
    faded = "parallel point_at <10, 0, 0> fade_distance 5 fade_power 2"
    cone = "spotlight parallel point_at 0 radius 30 falloff 45"
    panel = "area_light 8*x, 8*y, 65, 65"
    disc = "area_light 8*x, 8*y, 65, 65 circular"
    shine = "diffuse 0 phong 0.5 phong_size 5"
    table.row("parallel, faded", at(0.5, faded), 0.31201)
    table.row("parallel spotlight", at(19.5, cone), 0.5)
    table.row("panel", at(7, panel, finish=""), 0.4096)
    table.row("panel, area_illumination",
              at(7, panel + " area_illumination", finish=""), 0.4018)
    # A square squashed to a disc is not quite even: an even disc has 0.0361.
    table.row("circular panel's shadow", at(-3, disc, more=knife), 0.0325)
    table.row("shadowless highlight", at(1, "shadowless", finish=shine), 0)


def main():
    table = Table("largest difference along a row", 5e-5)
    for s in SPOTS:
        items = "spotlight point_at 0 radius {} falloff {} tightness {}"
        worst = max(abs(v - spot(*s, x))
                    for x, v in row(items.format(*s)))
        table.row(f"radius, falloff, tightness {s}", worst, 0)
    for t in TUBES:
        items = "cylinder point_at 0 radius {} falloff {} tightness {}"
        worst = max(abs(v - tube(*t, x)) for x, v in row(items.format(*t)))
        table.row(f"tube of radius, falloff, tightness {t}", worst, 0)
    for f in FADES:
        items = "fade_distance {} fade_power {}".format(*f)
        worst = max(abs(v - fade(*f, x)) for x, v in row(items))
        table.row(f"fade distance, power {f}", worst, 0)
    figures(table)
    return table.failed != 0


if __name__ == "__main__":
    sys.exit(main())
