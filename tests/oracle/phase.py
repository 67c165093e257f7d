#!/usr/bin/env python3
"""POV-Ray's phase functions, measured.

A thin slab (optical depth 1e-6) is seen straight on, through an orthographic
camera, and lit from far away at a known angle; each colour channel has an
angle of its own. What is printed is the in-scattered radiance over
sigma_s C length 4 pi p, p the normalised function of core/physics/phase.h:
1 for types 1 and 5, phase_pov_scale for the others.
"""
import sys
from math import cos, radians, sin

from renderer import Table, render

SCALE = {1: 1.0, 2: 1.15331, 3: 1.24681, 4: 1.06584, 5: 1.0}
ANGLES = ((0, 30, 60), (75, 90, 105), (120, 150, 180))
ECCENTRICITIES = (0, 0.3, 0.9, 0.99, -0.5, -0.9)
SIGMA, LENGTH, TARGET = 1e-5, 0.1, 0.8


def phase_4pi(kind, g, c):
    x = (1 + c) / 2
    return {1: 1,
            2: (1 + 9 * x ** 8) / 2,
            3: (1 + 50 * x ** 32) * 33 / 83,
            4: 0.75 * (1 + c * c),
            5: (1 - g * g) / (1 + g * g - 2 * g * c) ** 1.5}[kind]


def light(kind, g, angle, channel):
    """Light that must turn by `angle` to reach the camera."""
    a = radians(angle)
    color = [0, 0, 0]
    color[channel] = TARGET / (SIGMA * LENGTH * SCALE[kind]
                               * phase_4pi(kind, g, cos(a)))
    return (f"light_source {{ <{-1e6 * sin(a):.9f}, 0, {1e6 * cos(a):.9f}>"
            f" rgb <{color[0]:.9g}, {color[1]:.9g}, {color[2]:.9g}> }}\n")


def scene(kind, g, angles):
    lights = "".join(light(kind, g, angle, i)
                     for i, angle in enumerate(angles))
    eccentricity = f"eccentricity {g}" if kind == 5 else ""
    return f"""#version 3.7;
global_settings {{ assumed_gamma 1 }}
camera {{ orthographic location -10*z right 0.1*x up 0.1*y direction z }}
{lights}
box {{
    <-1, -1, {-LENGTH / 2}>, <1, 1, {LENGTH / 2}>
    pigment {{ rgbt 1 }} hollow
    interior {{
        media {{
            method 3 samples 10
            scattering {{ {kind}, rgb {SIGMA} {eccentricity} }}
        }}
    }}
}}
"""


def main():
    table = Table("radiance over sigma_s C length 4 pi p", 5e-5)
    for kind in SCALE:
        for g in ECCENTRICITIES if kind == 5 else (0,):
            for angles in ANGLES:
                pixel = render(scene(kind, g, angles))[1][1]
                for angle, value in zip(angles, pixel):
                    table.row(f"type {kind}, g {g}, {angle} degrees",
                              value / TARGET * SCALE[kind], SCALE[kind])
    return table.failed != 0


if __name__ == "__main__":
    sys.exit(main())
