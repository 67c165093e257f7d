#!/usr/bin/env python3
"""Functions of pigments and patterns of pictures as POV-Ray prints them.

    tests/oracle/images.py >tests/data/images.txt

In the form of pigments.py. Run in the root of the tree. Needs povray.

Pictures of greys are not among them: POV-Ray rounds their light to 8 bits."""
import os
from pigments import measure

BODIES = """
pigment { image_map { png "dots.png" } }
pigment { image_map { png "dots.png" gamma 1 } }
pigment { image_map { png "dots.png" gamma 2 once } }
pigment { image_map { tga "dots.tga" gamma srgb } }
pigment { image_map { png "dots.png" interpolate 2 } }
pigment { image_map { png "dots.png" interpolate 3 } }
pigment { image_map { png "dots.png" interpolate 4 } }
pigment { image_map { png "dots.png" once interpolate 2 } }
pigment { image_map { png "dots.png" once interpolate 3 } }
pigment { image_map { png "dots.png" map_type 1 } }
pigment { image_map { png "dots.png" map_type 1 interpolate 2 } }
pigment { image_map { png "dots.png" map_type 2 interpolate 3 } }
pigment { image_map { png "dots.png" map_type 2 once } }
pigment { image_map { png "dots.png" map_type 5 interpolate 4 } }
pigment { image_map { png "dots.png" filter all .3 transmit all .2 } }
pigment { image_map { png "dots_alpha.png" } }
pigment { image_map { png "dots_alpha.png" interpolate 2 filter all .1 } }
pigment { image_map { png "dots_alpha.png" premultiplied on } }
pigment { image_map { png "dots_palette.png" } }
pigment { image_map { png "dots_palette.png" filter 0 .3 transmit 2 .7 } }
pigment { image_map { png "dots_palette.png" transmit all .2 filter 1 .4 } }
pigment { image_map { png "dots_gamma.png" } }
pigment { image_map { png "dots_gamma.png" gamma srgb } }
pigment { image_map { png "dots.png" } scale 2 rotate 30 translate x }
pigment { image_map { png "dots.png" } warp { repeat x*.5 } turbulence .1 }
pigment { image_map { jpeg "dots.jpeg" } }
pigment { image_map { gif "dots.gif" } }
pigment { image_map { gif "dots.gif" gamma 1 interpolate 2 filter 1 .4 } }
pigment { image_pattern { gif "dots.gif" use_index } }
pigment { image_pattern { png "dots.png" } }
pigment { image_pattern { png "dots.png" gamma 2 } sine_wave frequency 2 }
pigment { image_pattern { png "dots.png" interpolate 2 } color_map { [0 rgb x] [1 rgb y] } }
pigment { image_pattern { png "dots_alpha.png" use_alpha } }
pigment { image_pattern { png "dots_alpha.png" use_color } }
pattern { image_pattern { png "dots_palette.png" } }
pigment { pigment_pattern { image_map { png "dots.png" } } color_map { [0 rgb x] [1 rgb y] } }
""".strip().splitlines()
POINTS = [(0.13, 0.27, 0.4), (0.52, 0.81, -0.3), (0.94, 0.04, 0.7),
          (1.37, 0.63, -1.2), (-0.71, 1.42, 0.2), (0.41, -2.3, 0.9)]

if __name__ == "__main__":
    measure(BODIES, POINTS, "+L" + os.path.abspath("tests/data"))
