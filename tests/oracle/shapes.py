#!/usr/bin/env python3
"""What POV-Ray's trace, inside and extents say of simple shapes and of CSG.

    tests/oracle/shapes.py                  writes tests/data/shapes.txt

A line `shape NAME` begins one of those that tests/unit/test_query.c builds;
the lines after it are those of solids.py.
"""
import os

from solids import MACROS, Random, shorter, vector
from values import written

PATH = os.path.join(os.path.dirname(__file__), "..", "data", "shapes.txt")
RAYS, POINTS = 24, 24

TURN = ("matrix <0.6, 0.8, 0, -0.64, 0.48, 0.6, 0.48, -0.36, 0.8, "
        "0.3, -0.2, 0.1>")
BOX = "box { -1, 1 }"
BALL = "sphere { <0.5, 0.2, 0>, 0.9 }"
TUBE = "cylinder { <0, -2, 0>, <0, 2, 0>, 0.5 }"
SHAPES = {
    "sphere": f"sphere {{ <0.1, 0.2, 0.3>, 0.8 scale <1, 2, 0.5> {TURN} }}",
    "box": f"box {{ <-1, -0.5, 0>, <0.4, 1, 0.7> {TURN} }}",
    "cylinder": "cylinder { <-0.5, -0.3, 0.2>, <0.5, 0.9, 1.2>, 0.4 }",
    "backward": "cylinder { <0.5, 0.2, 0.2>, <-0.5, 0.9, -1.2>, 0.4 }",
    "cone": "cone { <0.2, -0.6, -0.4>, 0.8, <0.1, 0.9, 0.5>, 0.25 }",
    "open": "cone { <0, -1, 0>, 0.8, <0, 1, 0>, 0.25 open }",
    "disc": "disc { <0.1, 0.2, 0.3>, <1, 2, 1>, 1, 0.3 }",
    "plane": "plane { <1, 2, -1>, 0.3 }",
    "torus": f"torus {{ 0.8, 0.3 {TURN} }}",
    "inverse": "sphere { 0, 1 inverse }",
    "difference": f"difference {{ {BOX} {BALL} {TUBE} }}",
    "turned": f"difference {{ {BOX} {BALL} {TUBE} {TURN} }}",
    "intersection": f"intersection {{ {BOX} {BALL} plane {{ y, 0.5 }} }}",
    "union": f"union {{ {BOX} {BALL} {TUBE} scale 0.7 {TURN} }}",
    "merge": f"merge {{ {BOX} {BALL} {TUBE} }}",
    "cut union": f"intersection {{ sphere {{ 0, 1.2 }} "
                 f"union {{ {BOX} {BALL} }} }}",
    "less union": f"difference {{ sphere {{ 0, 1.6 }} "
                  f"union {{ {BOX} {BALL} }} }}",
    "twice": f"difference {{ sphere {{ 0, 1.6 }} difference {{ {BOX} "
             f"union {{ {BALL} {TUBE} }} }} }}",
    "clipped": f"sphere {{ 0, 1 clipped_by {{ box {{ <-2, -0.4, -2>, "
               f"<0.5, 0.6, 2> }} }} }}",
    "clipped difference": f"difference {{ {BOX} {TUBE} "
                          f"clipped_by {{ plane {{ <1, 1, 0>, 0.2 }} }} }}",
    "less clipped": f"difference {{ {BOX} sphere {{ 0, 0.9 "
                    f"clipped_by {{ plane {{ x, 0.1 }} }} }} }}",
    "text": "text { ttf \"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf\" "
            "\"B g%\" 2.5, <0.1, 0.05> translate <-1.3, -0.2, -1> }",
    "opened": f"difference {{ {BOX} cylinder {{ <0, -2, 0>, <0, 0.5, 0>, "
              f"0.5 open }} }}",
}


def probe(name, seed):
    random = Random(seed)
    lines = [f"#declare S = {SHAPES[name]}", '#write(out, "solid\\n")',
             '#write(out, "bounds", V(min_extent(S)), V(max_extent(S)), "\\n")']
    for i in range(RAYS):
        origin = random.point(1 if i % 3 == 0 else 4)
        target = random.point(1)
        away = [round(t - o, 6) for o, t in zip(origin, target)]
        lines.append(f"T({vector(origin)}, {vector(away)})")
    lines += [f"I({vector(random.point(1.5))})" for _ in range(POINTS)]
    return "\n".join(lines)


def main():
    scene = MACROS + "\n".join(
        probe(name, i + 1) for i, name in enumerate(SHAPES)) + "\n#fclose out\n"
    said = written(scene).split("solid\n")[1:]
    with open(PATH, "w") as file:
        file.write("# Made by tests/oracle/shapes.py with POV-Ray 3.7.\n")
        for name, text in zip(SHAPES, said):
            file.write(f"shape {name}\n" + shorter(text))


if __name__ == "__main__":
    main()
