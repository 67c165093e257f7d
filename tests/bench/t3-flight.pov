// A flight through clouds, 640x480, 600 frames (t3-flight.ini): table 3 of
// Cha, Yi, Ihm 2010. The camera comes to the box's face at frame 100 and is
// through it at frame 500; it looks ahead.
#include "bench.inc"
#declare Side = 1 / 96;
#declare Frame = (clock_on ? frame_number : 200);
camera {
    location -z * 128 * Side * (300 - Frame) / 199.5
    right x * image_width / image_height
    angle Angle
    look_at z * 1000
}
Container(<256, 96, 256>, Side, Cloudy("t3-flight.vdb", 10, 0.999))
