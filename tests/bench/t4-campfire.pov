// The campfire that was simulated with Mantaflow (scenes/README.md), frame by
// frame: its smoke, lit by its fire and the sun of the bench.
#include "bench.inc"
Look(2.4, 0)
#declare Frame = (clock_on ? frame_number : 1);
#declare File = concat("campfire_", str(Frame, -2, 0), ".vdb");
box {
    <0, 0, 0>, <1.6, 2.4, 1.6>
    hollow
    pigment { rgbt 1 }
    interior {
        media {
            density { density_file vdb File "density" up z }
            velocity { vdb File "velocity" units voxels strength 0.09 }
            absorption rgb 12
            scattering { 1, rgb 28 }
            fire {
                temperature { density_file vdb File "temperature" up z }
                kelvin 1000, 0
                reference 2000
                brightness physical
                coupling absorption
            }
        }
    }
    translate <-0.8, -1.2, -0.8>
}
