#!/usr/bin/env python3
"""Values of the internal functions of functions.inc as POV-Ray prints them.

    tests/oracle/internal.py >tests/data/internal.txt

Each line: name, number of internal(), arguments x y z P0 ..., value. Needs
povray; the names and numbers are read from its functions.inc."""
import random
import re

from values import written

INCLUDE = "/usr/share/povray-3.7/include/functions.inc"
ROWS = 12
# Not identified: Brume has none.
LEFT_OUT = {"comma"}
# Parameters after x, y, z, as the manual lists them; a pair is a range.
PLAIN = (0.2, 2)
ANY = (-2, 2)
SWITCH = [0, 1]
SWEEP = [SWITCH, ANY, (-90, 90)]
STRENGTH = (-0.1, 0.1)
FIELD = [STRENGTH]
GENERATOR = [0, 1, 2, 3]
FRACTAL = [(0.2, 1), (1.5, 3), [1, 2, 3, 5.5], (0, 1.5), [0.5, 1, 2], GENERATOR]
PARAMETERS = {
    "algbr_cyl1": FIELD + [PLAIN] + SWEEP, "algbr_cyl2": FIELD + [PLAIN] + SWEEP,
    "algbr_cyl3": FIELD + [PLAIN] + SWEEP, "algbr_cyl4": FIELD + [PLAIN] + SWEEP,
    "bicorn": FIELD + [PLAIN], "bifolia": FIELD + [PLAIN],
    "blob": [PLAIN] * 5, "blob2": [PLAIN] * 4, "boy_surface": FIELD + [PLAIN],
    "cross_ellipsoids": [PLAIN] * 4,
    "devils_curve_2d": FIELD + [PLAIN] * 2 + SWEEP,
    "dupin_cyclid": FIELD + [PLAIN] * 2 + [ANY] * 2 + [PLAIN],
    "ellipsoid": [PLAIN] * 3, "flange_cover": [PLAIN] * 4,
    "folium_surface": FIELD + [PLAIN] * 2,
    "folium_surface_2d": FIELD + [PLAIN] * 2 + SWEEP,
    "helical_torus": [(0.8, 1.5), [3, 5, 8], [0, 1, 2], (0.1, 0.5), (0, 1),
                      (-0.5, 0.5), (0, 1), [1, 2, 5], (0.1, 1), (0, 2)],
    "helix1": [[1, 2, 3], PLAIN, (0.1, 0.5), (0.6, 1.5), (0.5, 2),
               [0, 0.5, 1, 1.5, 2, 3], [0, 30, 70]],
    "helix2": [[0], PLAIN, (0.1, 0.5), (0.1, 1), [0],
               [0, 0.5, 1, 1.5, 2, 3], [0, 30, 70]],
    "hyperbolic_torus": FIELD + [PLAIN] * 2, "isect_ellipsoids": [PLAIN] * 4,
    "kampyle_of_eudoxus": FIELD + [PLAIN] * 2,
    "kampyle_of_eudoxus_2d": FIELD + [PLAIN] * 2 + SWEEP,
    "kummer_surface_v2": FIELD + [ANY] * 3,
    "lemniscate_of_gerono_2d": FIELD + [PLAIN] * 2 + SWEEP,
    "noise3d": [], "noise_generator": [GENERATOR], "hetero_mf": FRACTAL,
    "ridge": [(1.5, 3), [1, 2, 3, 5.5], (0.2, 1), (0, 1.5), (0, 1.5),
              GENERATOR],
    # POV-Ray goes on with the first three of the first call.
    "ridged_mf": [[0.7], [2.17], [4]] + FRACTAL[3:], "mesh1": [PLAIN] * 5, "ovals_of_cassini": FIELD + [PLAIN] * 3,
    "parabolic_torus": FIELD + [PLAIN] * 2, "ph": [], "r": [], "th": [],
    "piriform_2d": FIELD + [PLAIN, ANY, PLAIN] + SWEEP,
    "poly4": [ANY] * 5, "polytubes": [[1, 2, 3, 4, 7]] + [ANY] * 5,
    "quartic_cylinder": FIELD + [PLAIN] * 2,
    "rounded_box": [(0, 0.2)] + [PLAIN] * 3, "sphere": [PLAIN],
    "spikes": [PLAIN] * 5, "spikes_2d": [PLAIN] * 4,
    "spiral": [(0.2, 1), (0.02, 0.1), PLAIN, [0], [0], [0, 0.5, 1, 2, 3]],
    "strophoid": FIELD + [ANY, ANY, PLAIN],
    "strophoid_2d": FIELD + [ANY, ANY, PLAIN] + SWEEP,
    "superellipsoid": [PLAIN] * 2, "torus": [PLAIN] * 2,
    "torus2": FIELD + [PLAIN] * 2, "witch_of_agnesi": FIELD + [PLAIN],
    "witch_of_agnesi_2d": FIELD + [PLAIN] * 2 + SWEEP,
}


def draw(rule):
    if isinstance(rule, tuple):
        return round(random.uniform(*rule), 4)
    return random.choice(rule)


def rows():
    """Of each function: two rows at plain points, then random ones; of the
    helical torus, whose axis is singular, random ones."""
    text = open(INCLUDE, encoding="latin-1").read()
    for name, number in re.findall(r"f_(\w+)\s*=\s*function\s*{\s*internal\("
                                   r"\s*(\d+)\s*\)", text):
        for i in range(0 if name in LEFT_OUT else ROWS):
            point = ([(0, 0, 0), (1, 0, 0)][i]
                     if i < 2 and name != "helical_torus" else
                     [round(random.uniform(-1.5, 1.5), 4) for _ in "xyz"])
            yield name, number, [*point] + [
                draw(rule) for rule in PARAMETERS.get(name, FIELD)]


def main():
    random.seed(1)
    table = list(rows())
    scene = ['#version 3.7; #include "functions.inc"',
             '#fopen F "written" write']
    for name, _, args in table:
        call = f"f_{name}({','.join(map(str, args))})"
        scene.append(f'#write(F, str({call}, 0, 15), "\\n")')
    values = written("\n".join(scene) + "\n#fclose F\n").split()
    for (name, number, args), value in zip(table, values):
        print(name, number, *args, value)


main()
