#!/usr/bin/env python3
"""A dense cloud under sun and sky: Brume beside Blender's Cycles, both on one
thread of this processor.

    make && tests/bench/cycles.py

The cloud is grids.c's peer-cloud: 192 x 128 x 192 voxels, optical width about
50, albedo 0.99, g 0.6. Each program draws FRAMES pictures of two numbers of
samples, in turn; what the larger number takes longer, of the CPU's time, is
what its samples cost without start-up. relMSE is the mean over pixels of the
pictures' variance / (mean^2 + 0.01 (mean of picture)^2); times samples, and
over paths per second, it is the cost of a wanted error. The means of the
pictures must agree: else they are not of the same scene. Cycles marches with
steps of a voxel, as it does unless told otherwise (STEP).

Run by blender (-b -P cycles.py -- FILE SAMPLES SEED), it draws one picture.
"""
import math
import os
import subprocess
import sys
import tempfile

SIDE, HEIGHT, EXTINCTION, ALBEDO, G = 96, 1.15, 60.0, 0.99, 0.6
SIZE = (192, 128, 192)
SUN, SKY = 3.0, 0.3         # irradiance, radiance
EYE, SUNWARD = (0.0, 0.5, -3.6), (-4.0, 5.0, -4.0)
TANGENT = 0.3               # of half the angle of view
SAMPLES = (4, 20)
FRAMES = int(os.environ.get("FRAMES", 4))
BRUME = os.path.abspath(os.environ.get("BRUME", "build/brume"))
GRIDS = os.path.abspath("build/tests/bench/grids")


def unit(v):
    size = math.sqrt(sum(x * x for x in v))
    return [x / size for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0]]


def frame_of(forward):
    """Right, up and backward of what looks along `forward`."""
    back = [-x for x in unit(forward)]
    right = unit(cross((0.0, 1.0, 0.0), back))
    return right, cross(back, right), back


# ---- inside of blender -----------------------------------------------------

def place(bpy, thing, axes, at):
    from mathutils import Matrix
    o = bpy.data.objects.new("it", thing)
    rows = [[axes[k][i] for k in range(3)] + [at[i]] for i in range(3)]
    o.matrix_world = Matrix(rows + [[0, 0, 0, 1]])
    bpy.context.scene.collection.objects.link(o)
    return o


def cloud_material(bpy):
    m = bpy.data.materials.new("cloud")
    m.use_nodes = True
    m.cycles.volume_step_rate = float(os.environ.get("STEP", 1))
    nodes, links = m.node_tree.nodes, m.node_tree.links
    nodes.clear()
    out = nodes.new("ShaderNodeOutputMaterial")
    both = nodes.new("ShaderNodeAddShader")
    density = nodes.new("ShaderNodeAttribute")
    density.attribute_name = "density"
    links.new(both.outputs[0], out.inputs["Volume"])
    for i, (kind, share, color) in enumerate((
            ("ShaderNodeVolumeScatter", ALBEDO, 1),
            ("ShaderNodeVolumeAbsorption", 1 - ALBEDO, 0))):
        shader, scale = nodes.new(kind), nodes.new("ShaderNodeMath")
        scale.operation = "MULTIPLY"
        scale.inputs[1].default_value = EXTINCTION * share
        shader.inputs["Color"].default_value = (color, color, color, 1)
        if i == 0:
            shader.inputs["Anisotropy"].default_value = G
        links.new(density.outputs["Fac"], scale.inputs[0])
        links.new(scale.outputs[0], shader.inputs["Density"])
        links.new(shader.outputs[0], both.inputs[i])
    return m


def settings(bpy, path, samples, seed):
    s = bpy.context.scene
    s.render.engine = "CYCLES"
    s.render.resolution_x = s.render.resolution_y = SIDE
    s.render.resolution_percentage = 100
    s.render.threads_mode, s.render.threads = "FIXED", 1
    s.render.image_settings.file_format = "OPEN_EXR"
    s.render.image_settings.color_depth = "32"
    s.render.image_settings.exr_codec = "ZIP"
    s.render.filepath = path
    c = s.cycles
    c.device, c.samples, c.seed = "CPU", samples, seed
    c.use_adaptive_sampling = c.use_denoising = False
    c.sample_clamp_direct = c.sample_clamp_indirect = 0
    c.light_sampling_threshold = 0
    c.max_bounces = c.volume_bounces = 1024
    c.volume_max_steps = 65536
    c.pixel_filter_type = "BOX"
    return s


def inside_blender():
    import bpy
    path, samples, seed = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    s = settings(bpy, path, int(samples), int(seed))
    volume = bpy.data.volumes.new("cloud")
    volume.filepath = os.path.join(os.path.dirname(path), "peer-cloud.vdb")
    volume.materials.append(cloud_material(bpy))
    place(bpy, volume, ((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0, 0, 0))
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy, sun.angle = SUN, 0
    place(bpy, sun, frame_of([-x for x in SUNWARD]), (0, 0, 0))
    camera = bpy.data.cameras.new("eye")
    camera.sensor_fit, camera.angle = "HORIZONTAL", 2 * math.atan(TANGENT)
    s.camera = place(bpy, camera, frame_of([-x for x in EYE]), EYE)
    s.world = bpy.data.worlds.new("sky")
    s.world.use_nodes = True
    sky = s.world.node_tree.nodes["Background"].inputs
    sky["Color"].default_value = (SKY, SKY, SKY, 1)
    sky["Strength"].default_value = 1
    bpy.ops.render.render(write_still=True)


# ---- outside ---------------------------------------------------------------

def vector(v):
    return "<" + ", ".join(f"{x:.9g}" for x in v) + ">"


def brume_scene():
    right, up, back = frame_of([-x for x in EYE])
    half = vector([0.5 * HEIGHT / SIZE[1] * n for n in SIZE])
    return f"""#version 3.7;
global_settings {{
    assumed_gamma 1 light_units physical
    transport {{ media multiple surfaces indirect environment on }}
}}
background {{ rgb {SKY} }}
camera {{
    location {vector(EYE)}
    direction {vector([-x for x in back])}
    right {vector([2 * TANGENT * x for x in right])}
    up {vector([2 * TANGENT * x for x in up])}
}}
light_source {{ {vector(SUNWARD)} rgb {SUN / math.pi} parallel point_at 0 }}
box {{
    -{half}, {half} hollow
    pigment {{ rgbt 1 }}
    interior {{
        media {{
            density {{ density_file vdb "peer-cloud.vdb" "density" }}
            absorption rgb {EXTINCTION * (1 - ALBEDO):.9g}
            scattering {{ 5, rgb {EXTINCTION * ALBEDO:.9g} eccentricity {G} }}
        }}
    }}
}}
"""


def timed(command, folder):
    # Not at the top: Blender's own Python looks for no modules here.
    from povray_media import cpu_seconds
    return cpu_seconds(command, folder)


def cycles(folder, samples, seed):
    path = os.path.join(folder, "cycles.exr")
    return path, timed(["blender", "-b", "-P", os.path.abspath(__file__), "--",
                        path, str(samples), str(seed)], folder)


def brume(folder, samples, seed):
    path = os.path.join(folder, "brume.exr")
    return path, timed([BRUME, "cloud.pov", "+O" + path, f"+W{SIDE}",
                        f"+H{SIDE}", "--spp", str(samples), "--seed",
                        str(seed), "--threads", "1", "-V", "+WL0"], folder)


def measure(program, folder, load):
    """relMSE times samples, paths per second, mean."""
    seconds, pictures = [0.0, 0.0], []
    for seed in range(1, FRAMES + 1):
        for i, samples in enumerate(SAMPLES):
            path, used = program(folder, samples, seed)
            seconds[i] += used / FRAMES
        pictures.append([v for plane in load(path)[2] for v in plane])
    n = len(pictures[0])
    means = [sum(p[i] for p in pictures) / FRAMES for i in range(n)]
    mean, error = sum(means) / n, 0.0
    for i, m in enumerate(means):
        variance = sum((p[i] - m) ** 2 for p in pictures) / (FRAMES - 1)
        error += variance / (m * m + 0.01 * mean * mean) / n
    paths = SIDE * SIDE * (SAMPLES[1] - SAMPLES[0])
    return error * SAMPLES[1], paths / (seconds[1] - seconds[0]), mean


def main():
    from povray_media import exr_load
    print("| program | paths per CPU second | relMSE x samples | error per "
          "cost, over Cycles | mean |\n| --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([GRIDS, folder, "peer-cloud"], check=True,
                       stdout=subprocess.DEVNULL)
        with open(os.path.join(folder, "cloud.pov"), "w") as file:
            file.write(brume_scene())
        theirs = None
        for name, program in ("Cycles", cycles), ("Brume path", brume):
            noise, rate, mean = measure(program, folder, exr_load)
            theirs = theirs or rate / noise
            print(f"| {name} | {rate:.4g} | {noise:.3g} | "
                  f"{rate / noise / theirs:.3g} | {mean:.5g} |", flush=True)


if __name__ == "__main__":
    if "bpy" in sys.modules or "-P" in sys.argv:
        inside_blender()
    else:
        main()
