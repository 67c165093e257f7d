#!/usr/bin/env python3
"""What POV-Ray's media do per unit length, measured.

A box of length 1 is seen straight on. Emission is a radiance per length,
absorption and extinction times scattering are the coefficients of exp(-tau),
and extinction attenuates the light on its way in as well. In-scattering needs
many samples: POV-Ray's sum over a ray converges from above.
"""
import sys
from math import exp

from renderer import Table, render

COLOR = (0.5, 1, 2)
EXTINCTIONS = (0, 0.5, 1, 2)
SAMPLES = 1000
LIGHT = 0.4


def scene(media, around="", length=1):
    return f"""#version 3.7;
global_settings {{ assumed_gamma 1 }}
camera {{ orthographic location -10*z right 0.1*x up 0.1*y direction z }}
{around}
box {{
    <-1, -1, 0>, <1, 1, {length}>
    pigment {{ rgbt 1 }} hollow
    interior {{ media {{ method 3 samples {SAMPLES} {media} }} }}
}}
"""


def report(table, name, text, expected):
    pixel = render(text)[1][1]
    for c, value, truth in zip(COLOR, pixel, expected):
        table.row(f"{name}, {c}", value, truth)


def in_scattered(c, extinction):
    tau = 2 * c * extinction    # there and back
    return LIGHT * c * ((1 - exp(-tau)) / tau if tau else 1)


def main():
    color = "rgb <{}, {}, {}>".format(*COLOR)
    white = "background { rgb 1 }"
    lamp = f"light_source {{ -1e6*z rgb {LIGHT} }}"
    table = Table("radiance", 1e-3)
    report(table, "emission over 0.4", scene("emission " + color, length=0.4),
           [0.4 * c for c in COLOR])
    report(table, "absorption", scene("absorption " + color, white),
           [exp(-c) for c in COLOR])
    report(table, "emission 1 with absorption",
           scene("emission rgb 1 absorption " + color),
           [(1 - exp(-c)) / c for c in COLOR])
    for e in EXTINCTIONS:
        scattering = f"scattering {{ 1, {color} extinction {e} }}"
        report(table, f"through extinction {e}", scene(scattering, white),
               [exp(-c * e) for c in COLOR])
        report(table, f"in-scattered, extinction {e}",
               scene(scattering, lamp),
               [in_scattered(c, e) for c in COLOR])
    return table.failed != 0


if __name__ == "__main__":
    sys.exit(main())
