#!/usr/bin/env python3
"""Splines at parameters as POV-Ray prints them.

    tests/oracle/splines.py >tests/data/splines.txt

Each line: kind, points, then parameter and x y z of each, then a parameter
and the x y z of the spline there. Needs povray."""
import random

from values import written

KINDS = ["linear", "quadratic", "cubic", "natural"]
# The points at these parameters, in this order.
KNOTS = [[0], [0, 1], [0, 1, 2], [0, 1, 2, 3], [0, .5, 1, 2, 3, 4],
         [3, -1, .25, 2.5, .75], [0, 1, 1, 2], [2, 1, 1, 0], [0, 1, 0],
         [-2, -1.75, -.5, 0, .01, 1, 1.5, 4, 9, 9.5]]


def main():
    random.seed(1)
    rows, scene = [], ['#version 3.7;', '#fopen F "written" write']
    for kind in range(len(KINDS)):
        for knots in KNOTS:
            points = [(t, [random.randint(-9, 9) for _ in "xyz"])
                      for t in knots]
            low, high = min(knots), max(knots)
            body = ", ".join(f"{t}, <{x},{y},{z}>" for t, (x, y, z) in points)
            scene.append(f"#declare S=spline{{{KINDS[kind]}_spline {body}}}")
            ats = knots + [low - 1, high + 1] + [
                round(random.uniform(low, high), 3) for _ in range(8)]
            for at in ats:
                scene.append(f"#declare V=S({at});#write(F,"
                             'vstr(3, V, " ", 0, 13), "\\n")')
                rows.append((kind, points, at))
    values = written("\n".join(scene) + "\n#fclose F\n").splitlines()
    for (kind, points, at), value in zip(rows, values):
        print(kind, len(points), *(f"{t} {x} {y} {z}"
                                   for t, (x, y, z) in points), at, value)


main()
