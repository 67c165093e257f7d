#!/usr/bin/env python3
"""What a sky_sphere shows in POV-Ray, direction by direction.

Layers: emission (1 - filter - transmit) color + (filter color + transmit) of
what is below, the background at the bottom. A picture of map_type 1 has its
left edge at +x, and its columns go on to +z.
"""
import os
import sys
import tempfile
from math import atan2, cos, pi, radians, sin

from renderer import Table, render

BACKGROUND = (0.9, 0.8, 0.3)
LOW = (0.6, 0.3, 0.2, 0.4, 0.1)
COLUMNS, ROWS = 8, 4


def direction(azimuth, height):
    a, h = radians(azimuth), radians(height)
    return cos(h) * sin(a), sin(h), cos(h) * cos(a)


def seen(sky, d):
    scene = f"""#version 3.7;
global_settings {{ assumed_gamma 1 }}
background {{ rgb <{BACKGROUND[0]}, {BACKGROUND[1]}, {BACKGROUND[2]}> }}
camera {{
    location <3, 4, 5>
    direction <{d[0]}, {d[1]}, {d[2]}> * 1e6 right x up y
}}
sky_sphere {{ {sky} }}
"""
    return render(scene, 1, 1)[0][0]


def over(color, below, emission=1):
    f, t = color[3:]
    return [emission * (1 - f - t) * c + (f * c + t) * b
            for c, b in zip(color, below)]


def text(color):
    return "pigment { rgbft <%g, %g, %g, %g, %g> }" % tuple(color)


def report(table, name, got, truth):
    for c in range(3):
        table.row(f"{name}, {'rgb'[c]}", got[c], max(truth[c], 0))


def layers(table):
    d = direction(0, 0)
    for f, t in ((0, 0), (0, 0.5), (0.5, 0), (0.3, 0.2), (0.8, 0.7)):
        color = (0.2, 0.5, 0.7, f, t)
        report(table, f"filter {f}, transmit {t}", seen(text(color), d),
               over(color, BACKGROUND))
        report(table, "the same over another, emission 0.5",
               seen(text(LOW) + text(color) + "emission 0.5", d),
               over(color, over(LOW, BACKGROUND, 0.5), 0.5))


def gradients(table):
    sky = """pigment {
        gradient y color_map { [0 rgb 0] [1 rgb <0.5, 0.7, 1>] }
        scale <1, 2, 1> translate -y
    }"""
    for height in (-60, -10, 10, 40, 80):
        y = sin(radians(height))
        for turn, x in (("", y), ("rotate 90*z", -direction(30, height)[0])):
            report(table, f"gradient at {height} {turn}",
                   seen(sky + turn, direction(30, height)),
                   [0.5 * (x + 1) * c for c in (0.5, 0.7, 1)])


def picture(path):
    with open(path, "wb") as file:
        file.write(b"P6\n%d %d\n65535\n" % (COLUMNS, ROWS))
        for i in range(COLUMNS * ROWS):
            for v in (8000 * (i % COLUMNS), 16000 * (i // COLUMNS), 0):
                file.write(v.to_bytes(2, "big"))


def pictures(table):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "sky.ppm")
        picture(path)
        sky = f"""pigment {{ image_map {{
            ppm "{path}" gamma 1 map_type 1
        }} }}"""
        for azimuth in range(20, 360, 45):
            for height in (-70, -20, 20, 70):
                d = direction(azimuth, height)
                column = int(atan2(d[2], d[0]) / (2 * pi) % 1 * COLUMNS)
                row = int((90 - height) / 180 * ROWS)
                report(table, f"picture at {azimuth}, {height}",
                       seen(sky, d), (8000 / 65535 * column,
                                      16000 / 65535 * row, 0))


def main():
    table = Table("radiance of the sky", 1e-4)
    layers(table)
    gradients(table)
    pictures(table)
    return table.failed != 0


if __name__ == "__main__":
    sys.exit(main())
