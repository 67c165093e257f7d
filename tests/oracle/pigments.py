#!/usr/bin/env python3
"""Functions of pigments and patterns as POV-Ray prints them.

    tests/oracle/pigments.py >tests/data/pigments.txt

The body of a function in a line, then points with the five numbers (of a
pattern one) that it gives there. B is a declared pigment. Needs povray."""
import random

from values import written

BASE = "pigment { bozo color_map { [0 rgb 0] [1 rgb 1] } }"
BODIES = """
pigment { rgbft <.1,.2,.3,.4,.5> }
pigment { agate }
pigment { bozo }
pigment { marble }
pigment { wood }
pigment { radial }
pigment { mandel 40 }
pigment { leopard }
pigment { checker }
pigment { brick }
pigment { brick rgb 1, rgb x brick_size <1,2,3> mortar .2 }
pigment { hexagon rgb 1 rgb x rgb y }
pigment { square }
pigment { triangular }
pigment { cubic }
pigment { crackle form <1,0,0> metric 3 offset .1 }
pigment { crackle solid scale 2 }
pigment { gradient <1,2,0> }
pigment { quilted control0 .3 control1 .8 }
pigment { julia <.3,.4>, 30 interior 1, 2 exterior 2, 1 }
pigment { magnet 1 mandel 20 }
pigment { spiral1 3 }
pigment { spiral2 3 turbulence .3 }
pigment { waves }
pigment { ripples frequency 3 phase .2 }
pigment { onion sine_wave frequency 2 }
pigment { granite turbulence .2 scale 3 translate x rotate 20 }
pigment { agate agate_turb .4 octaves 3 }
pigment { marble turbulence .4 scale 2 }
pigment { wood turbulence .1 octaves 4 scale .5 }
pigment { bozo turbulence <.3,.1,.2> omega .7 lambda 3 octaves 4 scale .5 }
pigment { bozo scale .5 turbulence .3 warp { repeat x*2 offset y flip y } rotate 30 }
pigment { bozo warp { repeat x*2 } scale .5 turbulence .3 }
pigment { bozo translate .3 warp { repeat y*1.5 flip x } turbulence .3 scale 2 warp { turbulence .2 } rotate 10 }
pigment { gradient x pigment_map { [0 rgb x] [.5 B scale .3] [1 checker rgb 1 rgb 0] } scale 2 rotate 40 }
pigment { gradient x pigment_map { [0 rgb x] [.5 B scale .3] [1 checker rgb 1 rgb 0] } turbulence .5 scale 2 }
pigment { average pigment_map { [1 B] [2 rgb x] [.5 gradient y] } scale 2 }
pigment { checker pigment { B } pigment { gradient x } scale .7 }
pigment { pigment_pattern { B scale 2 } color_map { [0 rgb 0] [.5 rgb x] [1 rgb 1] } translate .4 }
pigment { function { x*y+z } triangle_wave color_map { [0 rgb 0] [1 rgb 1] } scale 2 }
pigment { bozo poly_wave 2 frequency 3 phase .4 }
pigment { bozo cubic_wave }
pigment { bozo scallop_wave frequency -2 }
pigment { bozo noise_generator 3 }
pigment { dents noise_generator 1 }
pigment { bozo color_map { [.4 rgb 1] [.5 .6 color rgb x color rgb y] [.7 rgb z] } }
pigment { bozo warp { black_hole 0, 2 strength .5 falloff 1 } }
pigment { bozo warp { black_hole <.5,0,0>, .4 strength .9 falloff 2 inverse repeat 1 turbulence .1 } }
pigment { checker warp { cylindrical } scale .3 }
pigment { bozo warp { spherical orientation y dist_exp 1 } }
pigment { bozo warp { toroidal major_radius 1.4 } }
pigment { bozo warp { planar y, .3 } }
pigment { bozo warp { cubic } }
pattern { marble turbulence .4 scale 2 }
pattern { bozo sine_wave frequency 3 }
pattern { checker }
pattern { hexagon }
pattern { gradient x }
pattern { wood }
pattern { boxed }
pattern { planar scale 3 }
pattern { cylindrical scale 3 }
pattern { spherical scale 3 }
pattern { cells }
pattern { wrinkles }
pattern { onion }
pattern { pigment_pattern { checker } }
pigment { square rgb 0 rgb .1 rgb .2 rgb .3 }
pigment { triangular rgb 0 rgb .1 rgb .2 rgb .3 rgb .4 rgb .5 }
pigment { agate turbulence .4 lambda 3 scale .7 }
pigment { tiling 8 }
pigment { tiling 24 rotate 20 }
pigment { pavement }
pigment { pavement number_of_sides 3 number_of_tiles 5 pattern 3 scale .5 }
pigment { pavement number_of_sides 4 number_of_tiles 6 pattern 30 }
""".strip().splitlines()
POINTS = 5


def measure(bodies, points, *switches):
    """Prints bodies and what they give at the points."""
    scene = ["#version 3.7;", "global_settings { assumed_gamma 1 }",
             '#fopen F "written" write', f"#declare B = {BASE}"]
    for i, body in enumerate(bodies):
        terms = 5 if body.startswith("pigment") else 1
        scene.append(f"#declare G{i} = function {{ {body} }}")
        for x, y, z in points:
            value = f"G{i}({x}, {y}, {z})"
            scene.append(f"#declare V = {value};" if terms == 5 else
                         f"#declare V = <{value}, 0>;")
            scene.append(f'#write(F, vstr({max(terms, 2)}, V, " ", 0, 8), '
                         '"\\n")')
    values = iter(written("\n".join(scene) + "\n#fclose F\n",
                          *switches).splitlines())
    for body in bodies:
        print(body)
        for point in points:
            print(*point, next(values))


def main():
    random.seed(3)
    measure(BODIES, [[round(random.uniform(-3, 3), 3) for _ in "xyz"]
                     for _ in range(POINTS)])


if __name__ == "__main__":
    main()
