#!/usr/bin/env python3
"""Writes the plates of tests/data by another program than Brume's: the OpenEXR
library's Python package (PyPI: OpenEXR, numpy). From the root of the tree:

    python3 tests/oracle/plates.py
"""
import numpy as np
import OpenEXR


def half(values):
    return np.ascontiguousarray(values, dtype=np.float16)


def whole(values):
    return np.ascontiguousarray(values, dtype=np.float32)


def ramp():
    """160 x 120 in tiles of 32 x 16: red (x + 1) / 256, green (y + 1) / 128,
    blue 3; depth 3 + x / 40, in the last row infinite."""
    y, x = np.mgrid[0:120, 0:160]
    z = whole(3 + x / 40)
    z[119, :] = np.inf
    channels = {"R": half((x + 1) / 256), "G": half((y + 1) / 128),
                "B": half(0 * x + 3), "Z": z}
    header = {"compression": OpenEXR.ZIP_COMPRESSION,
              "type": OpenEXR.tiledimage,
              "tiles": OpenEXR.TileDescription()}
    header["tiles"].xSize = 32
    header["tiles"].ySize = 16
    with OpenEXR.File(header, channels) as file:
        file.write("tests/data/plate.exr")


def layers():
    """As Blender names a view layer's passes; the data window is columns 1 to 5
    and rows 2 to 4 of a display window of 160 x 120. Alpha 0.5 where the sum of
    column and row is odd; depths with all that can be wrong of them."""
    y, x = np.mgrid[2:5, 1:6]
    alpha = half(np.where((x + y) % 2, 0.5, 1.0))
    z = whole(x + 10 * y)
    z[0, :4] = [np.nan, 0, -1, np.inf]
    red = half(x * alpha)
    red[1, 1] = np.inf
    name = "ViewLayer.Combined."
    channels = {name + "R": red, name + "G": half(y * alpha),
                name + "B": half(0.25 * alpha), name + "A": alpha,
                "ViewLayer.Depth.Z": z,
                "ViewLayer.IndexOB.X": np.zeros_like(z)}
    header = {"compression": OpenEXR.PIZ_COMPRESSION,
              "type": OpenEXR.scanlineimage,
              "dataWindow": (np.array([1, 2], np.int32),
                             np.array([5, 4], np.int32)),
              "displayWindow": (np.array([0, 0], np.int32),
                                np.array([159, 119], np.int32))}
    with OpenEXR.File(header, channels) as file:
        file.write("tests/data/plate_layers.exr")


ramp()
layers()
