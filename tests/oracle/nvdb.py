#!/usr/bin/env python3
"""NanoVDB files as other programs write them.

    tests/oracle/nvdb.py tests/data

Makes kinds.nvdb and tiles.nvdb of the .vdb files of these names, codes.nvdb
of a ramp in each quantised type, and warp.nvdb. Needs OpenVDB's Python module
(Debian: python3-openvdb), nanovdb_convert (libnanovdb-tools) and NVIDIA's
Warp (PyPI: warp-lang), which writes without bounds, counts and names."""
import subprocess
import sys
import tempfile

import numpy
import pyopenvdb
import warp


def convert(to, source, *options):
    subprocess.run(["nanovdb_convert", "-f", *options, source, to], check=True)


def join(temp, to, parts):
    """One file of several segments."""
    with open(to, "wb") as whole:
        for part in parts:
            convert(temp + "/part.nvdb", *part)
            with open(temp + "/part.nvdb", "rb") as file:
                whole.write(file.read())


def ramp(shape):
    """Value (x + 100 y + 10000 z) / 4."""
    x, y, z = numpy.indices(shape, numpy.float32)
    return (x + 100 * y + 10000 * z) / 4


def main(folder):
    temp = tempfile.mkdtemp()
    join(temp, folder + "/kinds.nvdb", (
        (folder + "/kinds.vdb", "-z", "-g", name)
        for name in "big count empty mask real surface velocity".split()))
    convert(folder + "/tiles.nvdb", folder + "/tiles.vdb", "-b")
    grid = pyopenvdb.FloatGrid()
    grid.name = "density"
    grid.copyFromArray(ramp((9, 8, 8)))
    pyopenvdb.write(temp + "/ramp.vdb", grid)
    join(temp, folder + "/codes.nvdb", (
        (temp + "/ramp.vdb", "-z", "--fp" + code) for code in ("4", "8", "16", "N")))
    warp.Volume.load_from_numpy(
        ramp((9, 3, 17)), min_world=(-4, 2, 8), voxel_size=0.5, bg_value=0.25,
        device="cpu").save_to_nvdb(folder + "/warp.nvdb", codec="zip")


main(*sys.argv[1:])
