"""Renders a scene given as text and reads the pixels back as linear light.

The program is POV-Ray, or any other that takes its switches; the command line
of each probe may give one, with switches of its own:

    TOLERANCE=0.01 tests/oracle/finish.py build/brume --spp 4096

Pictures are 16-bit PPM, coded as sRGB: good to 1e-5, and nothing above 1 is
seen, so a probe chooses the brightness of its lights to land below that.
"""
import os
import subprocess
import sys
import tempfile

PROGRAM = sys.argv[1:] or ["povray"]
SWITCHES = ["+FP16", "File_Gamma=sRGB", "-D", "-A", "-V"]


def linear(code):
    """Of an sRGB code value in [0, 1] (IEC 61966-2-1)."""
    if code <= 0.04045:
        return code / 12.92
    return ((code + 0.055) / 1.055) ** 2.4


def ppm_pixels(data):
    """Width, height and rows of (r, g, b) of a 16-bit P6, 1 being white."""
    fields, at = [], 0
    while len(fields) < 4:
        end = data.index(b"\n", at)
        fields += data[at:end].split(b"#")[0].split()
        at = end + 1
    width, height, white = map(int, fields[1:])
    if white != 65535:
        raise ValueError("not a 16-bit picture")
    words = [linear(int.from_bytes(data[i:i + 2], "big") / white)
             for i in range(at, at + 6 * width * height, 2)]
    pixels = list(zip(words[0::3], words[1::3], words[2::3]))
    return [pixels[y * width:(y + 1) * width] for y in range(height)]


def render(scene, width=4, height=4):
    with tempfile.TemporaryDirectory() as folder:
        source = os.path.join(folder, "scene.pov")
        output = os.path.join(folder, "picture.ppm")
        with open(source, "w") as file:
            file.write(scene)
        done = subprocess.run(
            [*PROGRAM, source, "+O" + output, f"+W{width}", f"+H{height}",
             *SWITCHES], capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(done.stderr + scene)
        with open(output, "rb") as file:
            return ppm_pixels(file.read())


class Table:
    """Measured against expected values, a line each; counts the failures."""

    def __init__(self, title, tolerance):
        self.tolerance = float(os.environ.get("TOLERANCE", tolerance))
        self.failed = 0
        print(f"{title} (tolerance {self.tolerance:g})")

    def row(self, name, measured, expected):
        good = abs(measured - expected) <= self.tolerance * max(
            1, abs(expected))
        self.failed += not good
        print(f"    {name:40} {measured:.5f} {expected:.5f}"
              f"{'' if good else '  DIFFERS'}")
