#!/usr/bin/env python3
"""Times the reading of scenes by brume and by povray: a table of CPU seconds
(user + system) and peak memory, medians of alternating runs.

    tests/bench/parse.py [-n RUNS] [-s SCALE] [NAME...]

BRUME is the program (build/brume). povray is left out where it is missing."""
import argparse
import os
import random
import shutil
import statistics
import subprocess
import sys
import tempfile

HEAD = '#version 3.7;\nglobal_settings { assumed_gamma 1 }\n'


def mesh2(out, count):
    """A wavy grid of about `count` triangles."""
    side = max(2, round((count / 2) ** 0.5))
    vertices = (side + 1) ** 2
    out.write('mesh2 {\nvertex_vectors { %d' % vertices)
    noise = random.Random(1)
    for i in range(side + 1):
        for j in range(side + 1):
            out.write(',\n<%.6f,%.6f,%.6f>' % (
                10 * i / side - 5, noise.uniform(-0.1, 0.1), 10 * j / side - 5))
    out.write('\n}\nface_indices { %d' % (2 * side * side))
    for i in range(side):
        for j in range(side):
            a, b = i * (side + 1) + j, (i + 1) * (side + 1) + j
            out.write(',\n<%d,%d,%d>,<%d,%d,%d>' % (
                a, b, a + 1, b, b + 1, a + 1))
    out.write('\n}\npigment { rgb 1 }\n}\n')


def mesh(out, count):
    noise = random.Random(2)
    out.write('mesh {\n')
    for _ in range(count):
        x, y, z = (noise.uniform(-5, 5) for _ in range(3))
        out.write('triangle { <%.6f, %.6f, %.6f>, <%.6f, %.6f, %.6f>, '
                  '<%.6f, %.6f, %.6f> }\n' % (
                      x, y, z, x + 0.01, y, z, x, y + 0.01, z))
    out.write('pigment { rgb 1 }\n}\n')


def spheres(out, count):
    noise = random.Random(3)
    for _ in range(count):
        x, y, z = (noise.uniform(-50, 50) for _ in range(3))
        r, g, b = (noise.random() for _ in range(3))
        out.write('sphere { <%.5f, %.5f, %.5f>, 0.1 texture { pigment { color '
                  'rgb <%.3f, %.3f, %.3f> } finish { ambient 0.1 diffuse 0.7 '
                  'phong 0.5 } } }\n' % (x, y, z, r, g, b))


def spheres_for(out, count):
    out.write('#for (I, 1, %d) sphere { <mod(I,100), mod(I*7,1000)/10, '
              'I/1000>, 0.1 pigment { rgb 1 } } #end\n' % count)


def loop_while(out, count):
    out.write('#declare I = 0; #while (I < %d) #declare I = I + 1; #end\n'
              % count)


def loop_for(out, count):
    out.write('#declare S = 0; #for (I, 1, %d) #declare S = S + I; #end\n'
              % count)


def macros(out, count):
    out.write('#macro M(A, B) A + B #end #declare S = 0;\n'
              '#for (I, 1, %d) #declare S = M(S, I); #end\n' % count)


def array(out, count):
    out.write('#declare A = array[%d]; #for (I, 0, %d) #declare A[I] = I; '
              '#end\n#declare S = 0; #for (I, 0, %d) #declare S = S + A[I]; '
              '#end\n' % (count, count - 1, count - 1))


def empty(out, count):
    pass


SCENES = {
    'mesh2': (mesh2, 1000000), 'mesh-tenth': (mesh, 100000),
    'mesh': (mesh, 1000000), 'spheres': (spheres, 100000),
    'spheres-for': (spheres_for, 100000), 'while': (loop_while, 1000000),
    'for': (loop_for, 1000000), 'macros': (macros, 100000),
    'array': (array, 1000000), 'empty': (empty, 0),
}


# POV-Ray takes ten minutes for this one.
WITHOUT_POVRAY = {'mesh'}


def run(words):
    """CPU seconds and peak bytes of a program; None if it fails."""
    process = subprocess.Popen(words, stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        return None
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def median(results):
    if not results or None in results:
        return None
    return [statistics.median(column) for column in zip(*results)]


def row(name, brume, povray):
    cells = ['%-12s' % name]
    for result, form in ((brume, '%8.3f s %6.0f MB'), (povray,
                                                       '%8.3f s %6.0f MB')):
        cells.append('%20s' % '-' if result is None
                     else form % (result[0], result[1] / 1e6))
    if brume and povray:
        cells.append('%6.2f %6.2f' % (brume[0] / povray[0],
                                      brume[1] / povray[1]))
    print(' | '.join(cells), flush=True)


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument('-n', type=int, default=5)
    options.add_argument('-s', type=float, default=1)
    options.add_argument('name', nargs='*')
    options = options.parse_args()
    brume = os.path.abspath(os.environ.get('BRUME', 'build/brume'))
    print('%-12s | %20s | %20s | %6s %6s' % ('scene', 'brume', 'povray',
                                             'time', 'memory'))
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name in options.name or SCENES:
            make, count = SCENES[name]
            povray = None if name in WITHOUT_POVRAY else shutil.which('povray')
            with open('scene.pov', 'w') as out:
                out.write(HEAD)
                make(out, int(count * options.s))
            words = ['scene.pov', '-D', '+W16', '+H16', '-F']
            mine, theirs = [], []
            for _ in range(options.n):
                mine.append(run([brume, '--check'] + words))
                if povray:
                    theirs.append(run([povray] + words))
            row(name, median(mine), median(theirs) if povray else None)


if __name__ == '__main__':
    sys.exit(main())
