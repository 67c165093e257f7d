#!/usr/bin/env python3
"""Heights of height fields of pictures as POV-Ray's trace() finds them.

    tests/oracle/heights.py

Prints for each use the first two of four heights, those of the upper row of a
picture of 2 x 2: the figures of tests/unit/test_heights.c. Needs povray."""
import struct

from values import written

FILES = {
    "a.pgm": b"P5\n2 2\n255\n" + bytes([10, 60, 0, 255]),
    "w.pgm": b"P5\n2 2\n65535\n" + struct.pack(">4H", 0x0A4D, 0x3C4D, 0, 65535),
    "c.ppm": b"P6\n2 2\n255\n" + bytes([10, 128, 7, 60, 128, 7, 0, 0, 0,
                                      255, 255, 0]),
    "w.ppm": b"P6\n2 2\n65535\n" + struct.pack(
        ">12H", 0x0A05, 0x7530, 0x02BC, 0x3C05, 0x7530, 0x02BC, 0, 0, 0,
        65535, 65535, 65535),
    "p.tga": bytes([0, 1, 1, 0, 0, 0, 1, 24, 0, 0, 0, 0, 2, 0, 2, 0, 8, 0x20])
             + bytes(3 * 256) + bytes([10, 60, 0, 255]),
}
USES = [
    'pgm "a.pgm"', 'pgm "w.pgm"', 'pgm "w.pgm" gamma 2.2',
    'pgm "w.pgm" gamma srgb', 'ppm "c.ppm"', 'ppm "c.ppm" gamma 2',
    'ppm "w.ppm"', 'tga "p.tga" gamma 2',
]
NEAR = 1e-6     # to the corner, where the surface still is


def scene():
    yield "#version 3.7; global_settings { assumed_gamma 1 }"
    yield '#fopen F "written" write'
    for use in USES:
        yield f"#declare H = height_field {{ {use} }}"
        for x in (NEAR, 1 - NEAR):
            yield "#declare N = <0, 0, 0>;"
            yield (f"#declare P = trace(H, <{x:.7f}, 2, {1 - NEAR:.7f}>, -y, "
                   "N);")
            yield '#write(F, str(P.y, 0, 7), "\\n")'
    yield "#fclose F"


def main():
    found = written("\n".join(scene()) + "\n", files=FILES).split()
    for use, *heights in zip(USES, found[::2], found[1::2]):
        print(use, *heights)


main()
