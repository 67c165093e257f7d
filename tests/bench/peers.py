#!/usr/bin/env python3
"""The three scenes of media.c with Mitsuba 3: work-normalised variance.

    python3 -m venv /tmp/mitsuba && /tmp/mitsuba/bin/pip install mitsuba
    make tools && /tmp/mitsuba/bin/python tests/bench/peers.py

The variants of LLVM want its version 17 or later (of Debian 12, libllvm19),
named by DRJIT_LIBLLVM_PATH: 14 to 16 end the program. Rows are printed as they
come.

Each program draws independent frames on the same processor, in turn; relMSE
is the mean over pixels of variance / (mean^2 + 0.01 (mean of picture)^2), and
is multiplied by CPU seconds, of all threads. The means must agree: they are
of the same scene.
"""
import os
import subprocess
import sys
import tempfile
import time

import mitsuba as mi
import numpy as np

BRUME = os.environ.get("BENCH", "build/tests/bench/media")
SIDE, WIDTH = 96, 96
SPP = {"cloud": 16, "smoke": 16, "fog": 16}
FRAMES = int(os.environ.get("FRAMES", 6))


def brume(scene, folder):
    out = subprocess.run([BRUME, scene, str(FRAMES), str(SPP[scene]), folder],
                         capture_output=True, text=True, check=True).stdout
    words = out.split()
    return float(words[2]), float(words[4]), float(words[9])


def density(folder):
    data = np.fromfile(os.path.join(folder, "density.f32"), np.float32)
    grid = mi.VolumeGrid(data.reshape(SIDE, SIDE, SIDE, 1))
    t = mi.ScalarTransform4f
    return {"type": "gridvolume", "grid": grid, "filter_type": "trilinear",
            "to_world": t().translate([-1, -1, -1]).scale([2, 2, 2])}


def sensor(z, tangent):
    t = mi.ScalarTransform4f
    return {
        "type": "perspective", "fov_axis": "x",
        "fov": float(np.degrees(2 * np.arctan(tangent))),
        "to_world": t().look_at(origin=[0, 0, z], target=[0, 0, 0],
                                up=[0, 1, 0]),
        "film": {"type": "hdrfilm", "width": WIDTH, "height": WIDTH,
                 "rfilter": {"type": "box"}, "pixel_format": "rgb"},
        "sampler": {"type": "independent"},
    }


def medium(sigma, albedo, g, volume=None):
    phase = {"type": "hg", "g": g}
    if volume is None:
        return {"type": "homogeneous", "albedo": albedo, "sigma_t": sigma,
                "phase": phase}
    return {"type": "heterogeneous", "albedo": albedo, "sigma_t": volume,
            "scale": sigma, "phase": phase}


def container(inside, half):
    t = mi.ScalarTransform4f
    return {"type": "cube", "to_world": t().scale([half] * 3),
            "bsdf": {"type": "null"}, "interior": inside}


def gray(value):
    return {"type": "rgb", "value": [value] * 3}


def lamp(place, intensity):
    return {"type": "point", "position": place, "intensity": gray(intensity)}


def triangles(name, points, corners):
    mesh = mi.Mesh(name, len(points), len(corners))
    params = mi.traverse(mesh)
    params["vertex_positions"] = np.array(points, np.float32).ravel()
    params["faces"] = np.array(corners, np.uint32).ravel()
    params.update()
    path = os.path.join(tempfile.gettempdir(), name + ".ply")
    mesh.write_ply(path)
    return {"type": "ply", "filename": path, "face_normals": True,
            "bsdf": {"type": "twosided", "inner": {
                "type": "diffuse", "reflectance": gray(0.6)}}}


def room():
    p = [(-2, -2, -2), (2, -2, -2), (2, 2, -2), (-2, 2, -2), (-2, -2, 2),
         (2, -2, 2), (2, 2, 2), (-2, 2, 2)]
    f = [(4, 5, 6), (4, 6, 7), (0, 4, 7), (0, 7, 3), (1, 2, 6), (1, 6, 5),
         (0, 1, 5), (0, 5, 4), (3, 7, 6), (3, 6, 2)]
    return triangles("room", p, f)


def body():
    p = [(0.8, -1.2, 0.6), (1.6, -1.2, 0.6), (1.2, -1.6, 0.6),
         (1.2, -0.8, 0.6), (1.2, -1.2, 0.2), (1.2, -1.2, 1.0)]
    f = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5),
         (3, 1, 5), (0, 3, 5)]
    return triangles("body", p, f)


def scene(name, folder, integrator):
    s = {"type": "scene", "integrator": {
        "type": integrator, "max_depth": 512, "rr_depth": 8}}
    if name == "cloud":
        s["sensor"] = sensor(-4.5, 0.3)
        s["box"] = container(medium(60.0, 0.99, 0.6, density(folder)), 1)
        s["sky"] = {"type": "constant", "radiance": gray(0.3)}
        s["sun"] = {"type": "directional", "direction": [2, -2, 1],
                    "irradiance": gray(3.0)}
    elif name == "smoke":
        s["sensor"] = sensor(-5.0, 0.4)
        s["box"] = container(medium(2.0, 0.8, 0.3, density(folder)), 1)
        s["room"], s["body"] = room(), body()
        s["lamp"] = lamp([-1.2, 1.5, -1.0], 5.0)
    else:
        fog = medium(0.2, 0.9, 0.5)
        s["fog"] = fog
        s["sensor"] = sensor(-4.0, 0.5)
        s["sensor"]["medium"] = {"type": "ref", "id": "fog"}
        s["box"] = container({"type": "ref", "id": "fog"}, 5)
        s["lamp"] = lamp([0.6, 0.4, 0.0], 5.0)
        s["lamp"]["medium"] = {"type": "ref", "id": "fog"}
    return s


def mitsuba(name, folder, integrator):
    loaded = mi.load_dict(scene(name, folder, integrator))
    mi.render(loaded, spp=1, seed=99).numpy()     # compiles the kernels
    frames, start = [], time.process_time()
    for k in range(FRAMES):
        frames.append(np.array(mi.render(loaded, spp=SPP[name], seed=k)))
    cost = (time.process_time() - start) / FRAMES
    frames = np.array(frames, np.float64)[:, :, ::-1, :3]
    mean, var = frames.mean(0), frames.var(0, ddof=1)
    floor = 0.01 * mean.mean() ** 2
    return (var / (mean ** 2 + floor)).mean(), cost, mean.mean()


def row(scene, what, measured, own):
    mse, cost, mean = measured
    print(f"| {scene} | {what} | {mse:.4g} | {cost:.3g} | {mse * cost:.4g} | "
          f"{mse * cost / own:.3g} | {mean:.5g} |", flush=True)


def peers(scene, folder, own):
    for variant in "scalar_rgb", "llvm_ad_rgb":
        try:
            mi.set_variant(variant)
            for integrator in "volpath", "volpathmis":
                row(scene, f"{variant} {integrator}",
                    mitsuba(scene, folder, integrator), own)
        except Exception as problem:
            print(f"{variant}: {problem}", file=sys.stderr)


def main():
    print("| scene | program | relMSE | CPU s | product | over Brume | mean |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for scene in sys.argv[1:] or SPP:
        with tempfile.TemporaryDirectory() as folder:
            ours = brume(scene, folder)
            own = ours[0] * ours[1]
            row(scene, "brume path", ours, own)
            peers(scene, folder, own)


if __name__ == "__main__":
    main()
