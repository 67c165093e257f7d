#!/usr/bin/env python3
"""What POV-Ray's trace, inside and extents say of its further primitives.

    tests/oracle/solids.py [KIND]...        writes tests/data/solids/KIND.txt

A line `solid KIND NUMBERS...` begins a solid; the numbers are what the builder
of tests/unit/solids.h takes. Then come `bounds` (two corners), `inside` (a
point, 0 or 1) and `trace` (origin, direction, then point and normal, or the
point alone, or `miss`). Rays and points are random, by a generator that is
written down here.
"""
import os
import re
import sys

from values import written

FOLDER = os.path.join(os.path.dirname(__file__), "..", "data", "solids")
RAYS, POINTS = 40, 60


def vector(numbers):
    return "<" + ",".join(map(repr, numbers)) + ">"


def vectors(numbers, size):
    return [vector(numbers[i:i + size]) for i in range(0, len(numbers), size)]


class Random:
    """Numerical Recipes' generator of 64 bits: the same everywhere."""

    def __init__(self, seed):
        self.state = seed

    def uniform(self, low=-1.0, high=1.0):
        self.state = (self.state * 6364136223846793005 +
                      1442695040888963407) % 2**64
        return low + (high - low) * (self.state >> 11) / 2**53

    def point(self, size):
        return [round(self.uniform(-size, size), 6) for _ in range(3)]


# ---- kinds: a text of the language from the numbers, and sets of numbers

def torus(n):
    return f"torus {{ {n[0]}, {n[1]} }}"


def quadric(n):
    a, b, c = vectors(n[:9], 3)
    return f"quadric {{ {a}, {b}, {c}, {n[9]} }}"


def poly(n):
    return f"poly {{ {n[0]}, {vector(n[1:])} sturm }}"


def terms(order, given):
    """Coefficients in POV-Ray's order from {(x, y, z): value}."""
    return [given.get((x, y, z), 0)
            for x in range(order, -1, -1)
            for y in range(order - x, -1, -1)
            for z in range(order - x - y, -1, -1)]


def quartic_torus(major, minor):
    s, k = major * major + minor * minor, major * major - minor * minor
    return {(4, 0, 0): 1, (0, 4, 0): 1, (0, 0, 4): 1, (2, 2, 0): 2,
            (2, 0, 2): 2, (0, 2, 2): 2, (2, 0, 0): -2 * s, (0, 2, 0): 2 * k,
            (0, 0, 2): -2 * s, (0, 0, 0): k * k}


def superellipsoid(n):
    return f"superellipsoid {{ {vector(n)} }}"


def ovus(n):
    return f"ovus {{ {n[0]}, {n[1]} }}"


IDENTITY = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0)
# Rows of A|b.
MAPS = (IDENTITY,
        (1, 0, 0, 0.2, 0, 0.5, 0, -0.1, 0, 0, 1.5, 0.3),
        (0.6, -0.8, 0, 0, 0.8, 0.6, 0.3, 0.1, 0, 0.2, 0.9, 0))


def matrix(rows):
    """As the language has it: p' = p M, columns of the map."""
    m = [rows[4 * i + j] for j in range(4) for i in range(3)]
    return "matrix " + vector(m)


def blob(n):
    text = f"blob {{ threshold {n[0]} "
    for i in range(1, len(n), 21):
        kind, strength, radius, *rest = n[i:i + 21]
        ends, rows = vectors(rest[:6], 3), rest[6:]
        text += (f"cylinder {{ {ends[0]}, {ends[1]}," if kind else
                 f"sphere {{ {ends[0]},")
        text += f" {radius}, {strength} {matrix(rows)} }} "
    return text + "sturm }"


def ball(strength, radius, centre, rows=IDENTITY):
    return (0, strength, radius, *centre, 0, 0, 0, *rows)


def rod(strength, radius, base, end, rows=IDENTITY):
    return (1, strength, radius, *base, *end, *rows)


def many(count):
    """Balls and rods of all kinds, here and there."""
    random, numbers = Random(5), []
    for i in range(count):
        strength = round(random.uniform(-0.5, 1.5), 3)
        radius = round(random.uniform(0.2, 0.7), 3)
        numbers += (rod(strength, radius, random.point(1.5), random.point(1.5),
                        MAPS[i // 3 % 3]) if i % 3 == 0 else
                    ball(strength, radius, random.point(1.8), MAPS[i // 2 % 3]))
    return numbers


CURVES = ("linear_spline", "quadratic_spline", "cubic_spline",
          "bezier_spline", "b_spline")
LINEAR, QUADRATIC, CUBIC, BEZIER, B_SPLINE = range(5)


def prism(n):
    curve, conic, is_open, low, high, *points = n
    return (f"prism {{ {CURVES[curve]} {'conic_sweep' if conic else ''} "
            f"{low}, {high}, {len(points) // 2}, "
            f"{', '.join(vectors(points, 2))} {'open' if is_open else ''} "
            f"sturm }}")


def lathe(n):
    points = n[1:]
    return (f"lathe {{ {CURVES[n[0]]} {len(points) // 2}, "
            f"{', '.join(vectors(points, 2))} sturm }}")


def sor(n):
    points = n[1:]
    return (f"sor {{ {len(points) // 2}, {', '.join(vectors(points, 2))} "
            f"{'open' if n[0] else ''} sturm }}")


def sphere_sweep(n):
    spheres = n[1:]
    text = ", ".join(f"{vector(spheres[i:i + 3])}, {spheres[i + 3]}"
                     for i in range(0, len(spheres), 4))
    return f"sphere_sweep {{ {CURVES[n[0]]} {len(spheres) // 4}, {text} }}"


FUNCTIONS = ("sqr cube exp reciprocal sin asin sinh asinh cos acos cosh acosh "
             "tan atan tanh atanh ln pwr").split()


def julia(n):
    function = FUNCTIONS[n[1]]
    if function == "pwr":
        function += f"({n[13]}, {n[14]})"
    # Its roots of most functions are as coarse as its steps.
    precision = n[3] * (100 if n[0] else 1)
    return (f"julia_fractal {{ {vector(n[4:8])} "
            f"{'hypercomplex' if n[0] else 'quaternion'} {function} "
            f"max_iteration {n[2]} precision {precision} "
            f"slice {vector(n[8:12])}, {n[12]} }}")


SURFACES = ("x*x + y*y + z*z - 1",
            "pow(sqrt(x*x + z*z) - 0.7, 2) + y*y - 0.09",
            "sin(3*x) + sin(3*y) + sin(3*z)",
            "y + 0.3*sin(4*x)*cos(3*z)")


def isosurface(n):
    a, b = vectors(n[2:8], 3)
    container = (f"sphere {{ {a}, {n[5]} }}" if n[1] else
                 f"box {{ {a}, {b} }}")
    evaluate = "evaluate {}, {}, {}".format(*n[12:]) if n[12:] else ""
    return (f"isosurface {{ function {{ {SURFACES[n[0]]} }} "
            f"contained_by {{ {container} }} threshold {n[8]} "
            f"accuracy {n[9]} max_gradient {n[10]} {evaluate} "
            f"all_intersections {'open' if n[11] else ''} }}")


def off(*points):
    """With the corner in the origin moved away: rays are aimed there."""
    return [round(x - 0.07, 6) for x in points]


FRAME = off(0, 0, 2, 0.1, 1.9, 2, -0.1, 2, 0, 0,
         0.5, 0.5, 1.5, 0.4, 1.4, 1.6, 0.5, 0.5)
KINDS = {
    "torus": (torus, [
        (1, 0.25), (1, 1), (3, 2.5), (1, 0.01), (0.5, 1), (0.1, 1), (0, 1)],
              1.4),
    "quadric": (quadric, [
        (1, 2, 3, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, -1),
        (1, 0, 1, 0, 0, 0, 0, -1, 0, 0),
        (1, -1, 1, 0, 0, 0, -0.2, 0.4, 0.2, -0.02),
        (1, -1, 1, 0, 0, 0, 0, 0, 0, -0.3),
        (0, 0, 0, 1, 0, 0, 0, 0, -1, 0),
        (0, 0, 0, 0, 0, 0, 1, 2, 3, -1)], 1.5),
    "poly": (poly, [
        (2, *terms(2, {(2, 0, 0): 1, (0, 2, 0): 1, (0, 0, 2): 2,
                       (0, 0, 0): -1})),
        (3, *terms(3, {(3, 0, 0): 1, (1, 2, 0): -1, (0, 0, 2): 1,
                       (0, 1, 0): 0.5, (0, 0, 0): -0.2})),
        (4, *terms(4, quartic_torus(1, 0.4))),
        # Along some lines no more than linear.
        (3, *terms(3, {(3, 0, 0): 1, (0, 3, 0): -27, (0, 0, 3): 1,
                       (0, 0, 1): 1, (1, 0, 0): 0.3, (0, 0, 0): -0.2})),
        (5, *terms(5, {(5, 0, 0): 1, (0, 1, 0): 1, (0, 0, 3): -2,
                       (1, 1, 1): 3, (0, 0, 0): 0.1})),
        (6, *terms(6, {(6, 0, 0): 1, (0, 6, 0): 1, (0, 0, 6): 1,
                       (2, 2, 2): -3, (0, 0, 0): -1}))], 1.5),
    "superellipsoid": (superellipsoid, [
        (1, 1), (0.2, 0.3), (1, 0.1), (0.05, 1.7), (2, 2), (3, 3), (2.5, 0.5),
        (0.5, 3)], 1.1),
    "blob": (blob, [
        (0.5, *ball(1, 1, (0.1, 0, 0.2))),
        (0.6, *ball(1, 1, (0.75, 0, 0)), *ball(1, 1, (-0.375, 0.64952, 0)),
         *ball(1, 1, (-0.375, -0.64952, 0))),
        (0.4, *rod(1, 0.8, (-1, 0, 0.2), (1, 0.5, 0)),
         *ball(-1, 0.7, (0, 0.6, 0.2))),
        (0.5, *ball(1, 1.3, (0.2, 0, 0), MAPS[1]),
         *rod(1.2, 0.7, (-1, -1, -0.4), (1, 1, 0.3), MAPS[2])),
        (0.3, *many(40))], 1.5),
    "prism": (prism, [
        (LINEAR, 0, 0, -0.5, 1, *FRAME),
        (LINEAR, 0, 0, 1, 0, *off(0, 0, 1, 0.3, 0.2, 1.1)),
        (QUADRATIC, 0, 0, 0, 1,
         *off(-1, -1, 0, 0, 1, 0.2, 1, 1.5, 0, 1, 0, 0)),
        (CUBIC, 0, 0, 0, 1,
         *off(-1, -1, 0, 0, 1.4, 0.1, 1, 1.5, 0, 1, 0, 0, 1, 1)),
        (CUBIC, 0, 0, 0.2, 1,
         *off(-1, -1, 0, 0, 1.4, 0.1, 1, 1.5, 0, 1, 0, 0, 1, 1,
              0.2, -0.3, 0.3, 0.3, 0.8, 0.4, 0.5, 0.9, 0.3, 0.3, 0.7, 0.5)),
        (BEZIER, 0, 0, 0, 1, *off(0, 0, 0.5, -0.7, 1, -0.7, 1.5, 0,
                                  1.5, 0, 1.2, 1.9, 0.5, 1.9, 0, 0)),
        (LINEAR, 1, 0, 0.3, 1.4, -0.5, -0.6, 0.7, -0.5, 0.4, 0.6, -0.5, 0.4),
        (LINEAR, 1, 0, -0.6, 1.2, -0.5, -0.6, 0.7, -0.5, 0.4, 0.6, -0.5, 0.4),
        (CUBIC, 1, 0, -1.3, -0.2, -0.8, -0.8, -0.5, -0.5, 0.6, -0.5, 0.7, 0.6,
         -0.6, 0.5, -0.5, -0.5, 0.4, -0.6)], 1.5),
    "lathe": (lathe, [
        (LINEAR, 0.4, 0, 1, 0.1, 1.1, 1, 0.5, 1, 0.4, 0),
        (LINEAR, 0, 0, 1, 0.1, 0.3, 1, 0, 1.2),
        (QUADRATIC, 1, -0.5, 0, 0.1, 1, 0.3, 0.6, 1, 0, 1.3),
        (CUBIC, 0.4, 0, 0.3, 0.8, 0.8, 1.2, 1.2, 0.6, 0.8, -0.1, 0.3, 0.8,
         0.8, 1.2),
        (CUBIC, 1, -1, 0, -0.6, 1.2, 0, 0.4, 0.8, 0, 1.1, -1, 1.4),
        (BEZIER, 0, -1, 1.2, -1, 1.3, 0.2, 0.6, 0.4,
         0.6, 0.4, 0.2, 0.6, 0.5, 1.2, 0, 1.1)], 1.4),
    "sor": (sor, [
        (0, 0.5, -0.2, 0.8, 0, 1.2, 0.7, 0.3, 1.1, 0, 1.4),
        (0, 0, 0, 0.118143, 0, 0.620253, 0.540084, 0.21097, 0.827004,
         0.194093, 0.962025, 0.28692, 1, 0.468354, 1.033755),
        (0, 1, -0.8, 0, -0.6, 1, 0.1, 0.7, 0.5, 0, 1.2, 1, 1.3)], 1.3),
    "sphere_sweep": (sphere_sweep, [
        (LINEAR, -1, 0, 0.2, 0.5, 1, 0.3, 0, 0.2),
        (LINEAR, -1, 0, 0, 0.3, 0, 0.8, 0, 0.6, 1, 0, 0, 0.3, 0, -1, 0.5, 0),
        (LINEAR, 0, 0, 0, 1, 0.3, 0, 0, 0.2, 1.3, 0.2, 0, 0.4),
        (CUBIC, -1, 1, 0, 1, -0.5, -0.2, 0, 0.4, 0.9, 0.4, 0, 0.3,
         1.5, 1, 0.6, 0.6),
        (CUBIC, -1, 0, 0, 0.2, -1, 1, 0, 0.3, 1, 1, 0.3, 0.2, 1, -1, 0, 0.3,
         -1, -1, 0.5, 0.2, -1, 0, 0, 0.2),
        (B_SPLINE, -1, 1, 0, 1, 0, 0, 0, 0.5, 1, 0.4, 0, 0.5, 1.5, 1, 1, 0.6,
         0, 1.6, 0.2, 0.1)], 1.5),
    "julia": (julia, [
        (0, 0, 6, 20, -0.083, 0, -0.83, -0.025, 0, 0, 0, 1, 0, 0, 0),
        # POV-Ray's normals know nothing of a slice's tilt.
        (0, 1, 4, 20, -0.5, 0.3, 0.2, 0.1, 0.004, 0.01, -0.005, 2, 0.1,
         0, 0),
        *((1, i, 4, 50, round(-0.3 + 0.02 * i, 2), 0.2, -0.4, 0.1,
           0, 0, 0, 1, 0.2, 1.8, 0.3)
          for i in range(18) if i != 1)], 1.2),     # its own cube is another
    "isosurface": (isosurface, [
        (0, 0, -1.1, -1.2, -1.1, 1.1, 1.2, 1.1, 0, 1e-5, 5, 0),
        (0, 0, -0.9, -0.8, -1.1, 0.7, 0.9, 1.1, 0.1, 1e-5, 5, 0),
        (1, 0, -1.1, -0.5, -1.1, 1.1, 0.4, 1, 0, 1e-5, 5, 0),
        (2, 0, -1, -1, -1, 1, 1, 1, 0.2, 1e-5, 5.2, 0),
        (2, 0, -1, -1, -1, 1, 1, 1, 0.2, 1e-5, 6, 0, 5.5, 1.3, 0.9),
        (3, 1, 0.1, 0, 0, 1.2, 0, 0, 0, 1e-5, 2, 0)], 1.2),
    "ovus": (ovus, [
        (1, 0.5), (1, 1), (1, 0), (1, 1.7), (1, 2.5), (0.8, 0.1)], 1.5),
}


# ---- the probe

MACROS = """#version 3.7;
global_settings { assumed_gamma 1 }
#fopen out "written" write
#macro V(A) concat(" ",str(A.x,0,12)," ",str(A.y,0,12)," ",str(A.z,0,12)) #end
#macro T(O, D)
  #local N = <0,0,0>;
  #local H = trace(S, O, D, N);
  #write(out, "trace", V(O), V(D),
         #if (vlength(N) = 0) " miss" #else concat(V(H), V(N)) #end, "\\n")
#end
#macro I(P) #write(out, "inside", V(P), " ", str(inside(S, P),0,0), "\\n") #end
"""


def probe(kind, text, numbers, size, seed):
    """The commands for one solid."""
    random = Random(seed)
    lines = [f"#declare S = {text(numbers)}",
             '#write(out, "solid\\n")',
             '#write(out, "bounds", V(min_extent(S)), V(max_extent(S)), "\\n")']
    for i in range(RAYS):
        origin = random.point(size * (3 if i % 4 else 1))
        target = random.point(size)
        if i % 8 == 0:              # along an axis, and through the middle
            target = [t if j == i // 8 % 3 else o
                      for j, (o, t) in enumerate(zip(origin, target))]
        if i % 8 == 1:
            target = [0, 0, 0]
        away = [round(t - o, 6) for o, t in zip(origin, target)]
        lines.append(f"T({vector(origin)}, {vector(away)})")
    lines += [f"I({vector(random.point(size))})" for _ in range(POINTS)]
    return "\n".join(lines)


def measure(kind):
    text, sets, size = KINDS[kind]
    scene = MACROS + "\n".join(
        probe(kind, text, numbers, size * scale(kind, numbers), i + 1)
        for i, numbers in enumerate(sets)) + "\n#fclose out\n"
    said = written(scene).split("solid\n")[1:]
    return "".join(" ".join(map(str, ("solid", kind, *numbers))) + "\n" +
                   "".join(trusted(kind, numbers, line + "\n")
                           for line in shorter(text).splitlines())
                   for numbers, text in zip(sets, said))


def trusted(kind, numbers, line):
    """The line without what POV-Ray contradicts itself in: a torus that
    overlaps itself has surfaces within; of most functions of hypercomplex
    numbers normals are not across the surfaces that it traces, and some
    insides do not end there."""
    if kind == "torus" and numbers[0] < numbers[1]:
        return "" if line.startswith("trace") else line
    if kind != "julia" or not numbers[0] or numbers[1] <= 1:
        return line
    function = FUNCTIONS[numbers[1]]
    if line.startswith("inside"):
        return "" if function in ("exp sin sinh cos cosh tan ln pwr"
                                  ).split() else line
    return " ".join(line.split()[:10]) + "\n"


def scale(kind, numbers):
    """How large a solid is beside the others of its kind."""
    return sum(numbers) if kind == "torus" else 1


def shorter(text):
    """Without zeros at the ends of the numbers."""
    return re.sub(r"(\.\d*?)0+\b", lambda m: m[1].rstrip("."), text)


def main():
    for kind in sys.argv[1:] or KINDS:
        said = measure(kind)
        with open(os.path.join(FOLDER, kind + ".txt"), "w") as file:
            file.write("# Made by tests/oracle/solids.py with POV-Ray 3.7.\n")
            file.write(said)


if __name__ == "__main__":
    main()
