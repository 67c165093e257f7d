"""Rows of tests/gpu/run peers: `path` and the default integrator beside Mitsuba
3's volpath, on one GPU, in one run.

Three scenes: a cloud of 192 x 128 x 192 voxels, albedo 0.99, g 0.6, optical
width about 50, in the sun under an even sky; smoke in a room with a mesh; fog
around the eye with a lamp in it. What each picture's error is, is told by two
references, one of each program: the mean of (picture - one) (picture - other)
over mean^2 + 0.01 (mean of picture)^2 is the square of the picture's error,
whatever the noise of either, as they are independent and have no bias. That the
references are of one scene, is told by the row `between`: what is left of their
difference beside their noise, and the ratio of their means.
"""
import os
import statistics
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__))))
SIDE = int(os.environ.get("PEER_SIDE", 512))
VARIANT = os.environ.get("PEER_VARIANT", "cuda_ad_rgb")
SCENES = os.environ.get("PEER_SCENES", "cloud smoke fog").split()
# Samples of: a picture of each, a reference's part and its parts.
SAMPLES = [int(n) for n in os.environ.get("PEER_SAMPLES", "64 64 8").split()]
RR_DEPTHS = (64, 8)
# Of the default integrator, whose fields' cells leave an error, and of the one
# that goes on to smaller ones: photons and samples a pixel.
OURS = {"photon": [(250000, 1), (1000000, 1), (1000000, 4), (1000000, 16),
                   (4000000, 16), (4000000, 64), (16000000, 64)],
        "progressive": [(1000000, 4), (1000000, 16), (4000000, 16),
                        (4000000, 64)]}
# So deep a cloud that noise is left of the photons above.
MORE_PHOTONS = {"cloud": [(64000000, 64), (256000000, 64), (512000000, 64)]}
GRID = {"cloud": (192, 128, 192), "smoke": (96, 96, 96)}
# Half the sides of the containers.
HALF = {"cloud": (0.8625, 0.575, 0.8625), "smoke": (1, 1, 1)}
EYE = {"cloud": (-3.6, 0.17), "smoke": (-5.0, 0.4), "fog": (-4.0, 0.5)}
HEAD = """#version 3.7;
global_settings {
    assumed_gamma 1 light_units physical
    transport { media multiple surfaces indirect environment on }
}
"""
INSIDE = {"cloud": """
background { rgb 0.3 }
light_source { <-2000, 2000, -1000> rgb 3 / pi parallel point_at 0 }
""", "smoke": """
light_source { <-1.2, 1.5, -1> rgb 5 / pi }
mesh { ply "room.ply" pigment { rgb 0.6 } finish { diffuse 1 ambient 0 } }
mesh { ply "body.ply" pigment { rgb 0.6 } finish { diffuse 1 ambient 0 } }
""", "fog": """
light_source { <0.6, 0.4, 0> rgb 5 / pi }
box { -5, 5 hollow pigment { rgbt 1 } interior { media {
    absorption rgb 0.02 scattering { 5, rgb 0.18 eccentricity 0.5 } } } }
"""}
# Extinction, albedo, g.
MEDIUM = {"cloud": (60.0, 0.99, 0.6), "smoke": (2.0, 0.8, 0.3)}


# ---- densities: the same numbers for both ----------------------------------

def hashed(np, x, y, z):
    u = np.uint32
    h = (x.astype(u) * u(73856093) ^ y.astype(u) * u(19349663) ^
         z.astype(u) * u(83492791))
    h = (h ^ h >> u(15)) * u(0x2c1b3c6d)
    h = (h ^ h >> u(12)) * u(0x297a2d39)
    return (h ^ h >> u(15)) / 4294967296.0


def value_noise(np, x, y, z):
    corner = [np.floor(v).astype(np.int64) for v in (x, y, z)]
    part = [v - c for v, c in zip((x, y, z), corner)]
    part = [p * p * (3.0 - 2.0 * p) for p in part]
    total = 0.0
    for c in range(8):
        weight, at = 1.0, []
        for i in range(3):
            one = c >> i & 1
            weight = weight * (part[i] if one else 1.0 - part[i])
            at.append(corner[i] + one)
        total = total + weight * hashed(np, *at)
    return total


def fractal(np, x, y, z):
    total, size, amount = 0.0, 5.0, 0.5
    for _ in range(5):
        total = total + amount * value_noise(np, size * x, size * y, size * z)
        size, amount = size * 2.03, amount * 0.5
    return total


def density(np, name):
    """As whole numbers of 16 bits, z, y, x; 0 at the faces."""
    nx, ny, nz = GRID[name]
    z, y, x = np.meshgrid(*[(np.arange(n) + 0.5) / n for n in (nz, ny, nx)],
                          indexing="ij")
    noise = fractal(np, x, y, z)
    dx, dy, dz = x - 0.5, y - 0.5, z - 0.5
    if name == "cloud":
        r = np.sqrt(dx * dx + 1.1 * dy * dy + dz * dz)
        v = np.clip(12.0 * (0.42 - r + 0.55 * (noise - 0.5)), 0, 1)
        v = v * (0.4 + 0.6 * noise)
    else:
        r = np.hypot(dx, dz) / (0.08 + 0.3 * y)
        v = np.clip(np.exp(-r * r) * noise * 2.0 - 0.2, 0, 1)
    v[[0, -1]] = v[:, [0, -1]] = v[:, :, [0, -1]] = 0.0
    return np.round(v * 65535).astype(np.uint16)


def write_df3(np, path, values):
    with open(path, "wb") as f:
        f.write(np.array(values.shape[::-1], ">u2").tobytes())
        f.write(values.astype(">u2").tobytes())


# ---- Brume -----------------------------------------------------------------

def vector(v):
    return "<" + ", ".join(f"{x:.9g}" for x in v) + ">"


def write_scene(np, folder, name):
    z, tangent = EYE[name]
    text = HEAD + INSIDE[name] + (
        f"camera {{ location <0, 0, {z}> direction z right {2 * tangent} * x "
        f"up {2 * tangent} * y }}\n")
    if name in GRID:
        sigma, albedo, g = MEDIUM[name]
        half = HALF[name]
        # A sample of a df3 stands at its voxel's lower corner.
        place = (f"translate {vector([0.5 / n for n in GRID[name]])} "
                 f"translate -0.5 scale {vector([2 * h for h in half])}")
        text += f"""box {{ -{vector(half)}, {vector(half)} hollow
    pigment {{ rgbt 1 }} interior {{ media {{
        density {{ density_file df3 "{name}.df3" interpolate 1 {place} }}
        absorption rgb {sigma * (1 - albedo):.9g}
        scattering {{ 5, rgb {sigma * albedo:.9g} eccentricity {g} }} }} }} }}
"""
    path = os.path.join(folder, f"peer-{name}.pov")
    with open(path, "w") as f:
        f.write(text)
    return path


class Brume:
    """Draws pictures of a scene; `render` is tests/gpu/run's."""

    def __init__(self, render, folder, scene, mi, np):
        self.render, self.folder, self.scene = render, folder, scene
        self.mi, self.np = mi, np

    def draw(self, seed, *switches):
        """A picture, the device's seconds and the frame's."""
        name = os.path.basename(self.scene)[:-4]
        backend = "cpu" if VARIANT.startswith("scalar") else "cuda"
        frame = self.render(self.scene, backend, name, f"+W{SIDE}", f"+H{SIDE}",
                            "--seed", str(seed), f"+L{self.folder}", *switches)
        whole = (frame["seconds"]["prepare"] + frame["seconds"]["render"]
                 + frame.get("photons", {}).get("seconds", 0))
        device = sum(frame.get("device_seconds", {"": 0}).values()) or whole
        bitmap = self.mi.Bitmap(os.path.join(self.folder, name + ".exr"))
        names = [field.name for field in bitmap.struct_()]
        picture = self.np.array(bitmap, dtype=self.np.float64)
        return picture[..., [names.index(c) for c in "RGB"]], device, whole

    def path(self, seed, spp):
        return self.draw(seed, "--integrator", "path", "--spp", str(spp))


# ---- Mitsuba ---------------------------------------------------------------

def sensor(mi, np, name):
    z, tangent = EYE[name]
    t = mi.ScalarTransform4f
    return {"type": "perspective", "fov_axis": "x",
            "fov": float(np.degrees(2 * np.arctan(tangent))),
            "to_world": t().look_at(origin=[0, 0, z], target=[0, 0, 0],
                                    up=[0, 1, 0]),
            "film": {"type": "hdrfilm", "width": SIDE, "height": SIDE,
                     "rfilter": {"type": "box"}, "pixel_format": "rgb",
                     "component_format": "float32"},
            "sampler": {"type": "independent"}}


def volume(mi, np, name, values):
    t, half = mi.ScalarTransform4f, HALF[name]
    grid = mi.VolumeGrid((values[..., None] / 65535.0).astype(np.float32))
    return {"type": "gridvolume", "grid": grid, "filter_type": "trilinear",
            "to_world": t().translate([-h for h in half]).scale(
                [2 * h for h in half])}


def describe(mi, np, parts, name, values, rr_depth):
    """`parts` is tests/bench/peers.py."""
    t = mi.ScalarTransform4f
    s = {"type": "scene", "sensor": sensor(mi, np, name),
         "integrator": {"type": "volpath", "max_depth": 4096,
                        "rr_depth": rr_depth}}
    if name == "fog":
        s["fog"] = parts.medium(0.2, 0.9, 0.5)
        inside = {"type": "ref", "id": "fog"}
        s["sensor"]["medium"] = inside
        s["box"] = parts.container(inside, 5)
        s["lamp"] = {**parts.lamp([0.6, 0.4, 0.0], 5.0), "medium": inside}
        return s
    sigma, albedo, g = MEDIUM[name]
    s["box"] = {"type": "cube", "bsdf": {"type": "null"},
                "to_world": t().scale(list(HALF[name])),
                "interior": parts.medium(sigma, albedo, g,
                                         volume(mi, np, name, values))}
    if name == "cloud":
        s["sky"] = {"type": "constant", "radiance": parts.gray(0.3)}
        s["sun"] = {"type": "directional", "direction": [2, -2, 1],
                    "irradiance": parts.gray(3.0)}
    else:
        s["room"], s["body"] = parts.room(), parts.body()
        s["lamp"] = parts.lamp([-1.2, 1.5, -1.0], 5.0)
    return s


class Volpath:
    def __init__(self, mi, np, scene):
        self.mi, self.np = mi, np
        self.scene = mi.load_dict(scene)

    def draw(self, seed, spp):
        """A picture as Brume's, whose x runs the other way, and seconds."""
        start = time.perf_counter()
        picture = self.np.array(self.mi.render(self.scene, spp=spp, seed=seed))
        seconds = time.perf_counter() - start
        return picture.astype(self.np.float64)[:, ::-1, :3], seconds


# ---- errors ----------------------------------------------------------------

class Judge:
    def __init__(self, np, ours, theirs):
        self.np, self.ours, self.theirs = np, ours, theirs
        mean = 0.5 * (ours + theirs)
        self.scale = 1.0 / (mean * mean + 0.01 * mean.mean() ** 2)

    def error(self, picture):
        """The square of its relRMSE."""
        return float(((picture - self.ours) * (picture - self.theirs) *
                      self.scale).mean())

    def noise(self, a, b):
        """The relMSE of each of two pictures that are independent."""
        return float((0.5 * (a - b) ** 2 * self.scale).mean())

    def noise_of_most(self, a, b):
        """The same without a thousandth of all values, the worst: what few
        bright pixels have of it, is not there by chance in one of them."""
        each = self.np.sort((0.5 * (a - b) ** 2 * self.scale).ravel())
        return float(each[:-(each.size // 1000 + 1)].sum() / each.size)


def mean_of(pictures):
    return sum(pictures) / len(pictures)


def reference(pictures):
    """Their mean, and those of two halves, whose noise is twice its."""
    half = len(pictures) // 2
    return (mean_of(pictures), mean_of(pictures[:half]),
            mean_of(pictures[half:2 * half]))


def between(judge, name, ours, theirs):
    noise = [0.5 * judge.noise(*r[1:]) for r in (ours, theirs)]
    apart = 2 * judge.noise(ours[0], theirs[0]) - sum(noise)
    return {"scene": name, "who": "between",
            "noise_%": " ".join(f"{100 * n ** 0.5:.2f}" for n in noise),
            "apart_%": f"{100 * abs(apart) ** 0.5 * (1 if apart > 0 else -1):.2f}",
            "means": f"{ours[0].mean() / theirs[0].mean():.5f}"}


def to_reach(row, error, seconds):
    """Seconds to errors of 3 and 1 %, where error falls as 1 over time."""
    for percent in (3, 1):
        row[f"s_to_{percent}_%"] = f"{error * seconds / (percent / 100) ** 2:.4g}"
    row["relmse_s"] = f"{error * seconds:.3g}"
    return row


def path_row(judge, name, who, spp, pictures, seconds, first):
    """Of two pictures of as many seconds each; of the first there were more,
    as it was compiled or a program started. `most`: without a thousandth of
    the pixels, see noise_of_most."""
    error = judge.noise(*pictures)
    most = judge.noise_of_most(*pictures)
    row = {"scene": name, "who": who, "spp": spp,
           "relmse_spp": f"{error * spp:.3g}",
           "most_spp": f"{most * spp:.3g}", "s": f"{seconds:.3f}",
           "with_start_s": f"{first:.3f}",
           "mpaths_s": f"{SIDE * SIDE * spp / seconds / 1e6:.1f}"}
    return to_reach(row, error, seconds), error * seconds, most * seconds


def path_rows(judge, name, spp, ours, theirs):
    """`ours`: two of Brume's pictures with their times; `theirs`: of Volpath's,
    by rr_depth, with the seconds of the first picture. Also the least relMSE
    times seconds of these, of all pixels and of most."""
    row, all_of_ours, most_of_ours = path_row(
        judge, name, "brume path", spp, [p[0] for p in ours],
        statistics.median(p[1] for p in ours),
        statistics.median(p[2] for p in ours))
    rows, costs = [row], []
    for rr_depth, (pictures, first) in theirs.items():
        row, *cost = path_row(judge, name, f"volpath rr {rr_depth}", spp,
                              [p[0] for p in pictures],
                              statistics.median(p[1] for p in pictures), first)
        row["over_path"] = f"{cost[0] / all_of_ours:.2f}"
        row["most_over_path"] = f"{cost[1] / most_of_ours:.2f}"
        rows.append(row)
        costs.append(cost)
    return rows, [min(kind) for kind in zip(*costs)]


def field_rows(judge, name, integrator, brume, theirs):
    """An integrator that makes fields, by its photons and samples, and the least
    time of these to an error beside that of volpath, `theirs` relMSE times
    seconds, of all pixels and of most."""
    rows, seen = [], []
    more = MORE_PHOTONS.get(name, []) if integrator == "photon" else []
    for photons, spp in OURS[integrator] + more:
        picture, device, whole = brume.draw(
            7, "--integrator", integrator, "--photons", str(photons), "--spp",
            str(spp))
        error = max(judge.error(picture), 0.0) ** 0.5
        seen.append((device, error))
        rows.append({"scene": name, "who": f"brume {integrator} {photons}",
                     "spp": spp, "s": f"{device:.4f}",
                     "with_start_s": f"{whole:.3f}",
                     "error_%": f"{100 * error:.2f}"})
    for percent in (3, 1):
        good = [s for s, error in seen if error <= percent / 100]
        over = [f"{cost / (percent / 100) ** 2 / min(good):.0f}"
                for cost in theirs if good]
        rows.append({"scene": name, "who": f"{integrator} to {percent} %",
                     "s": f"{min(good):.4f}" if good else "not reached",
                     "times": " ".join(over)})
    return rows


def scene_rows(mi, np, parts, render, folder, name):
    spp, part_spp, parts_count = SAMPLES
    values = density(np, name) if name in GRID else None
    if values is not None:
        write_df3(np, os.path.join(folder, name + ".df3"), values)
    brume = Brume(render, folder, write_scene(np, folder, name), mi, np)
    theirs, peers = {}, {}
    for rr_depth in RR_DEPTHS:
        start = time.perf_counter()
        peers[rr_depth] = Volpath(mi, np, describe(mi, np, parts, name, values,
                                                   rr_depth))
        peers[rr_depth].draw(0, spp)
        first = time.perf_counter() - start
        theirs[rr_depth] = ([peers[rr_depth].draw(seed, spp)
                             for seed in (1, 2)], first)
    ours = [brume.path(seed, spp) for seed in (1, 2)]
    seeds = range(100, 100 + parts_count)
    rr_depth = min(RR_DEPTHS, key=lambda r: theirs[r][0][0][1])
    references = [reference([brume.path(seed, part_spp)[0] for seed in seeds]),
                  reference([peers[rr_depth].draw(seed, part_spp)[0]
                             for seed in seeds])]
    judge = Judge(np, references[0][0], references[1][0])
    rows = [between(judge, name, *references)]
    more, costs = path_rows(judge, name, spp, ours, theirs)
    rows += more
    for integrator in OURS:
        rows += field_rows(judge, name, integrator, brume, costs)
    return rows


def rows(render, folder):
    sys.path.insert(0, os.path.join(ROOT, "tests/bench"))
    os.environ["TMPDIR"] = folder       # where room.ply goes
    try:
        import mitsuba as mi
        import numpy as np
        mi.set_variant(VARIANT)
        import peers
    except Exception as error:
        return [{"who": f"volpath: {error}"}]
    out = []
    for name in SCENES:
        start = time.monotonic()
        try:
            out += scene_rows(mi, np, peers, render, folder, name)
        except Exception as error:
            out.append({"scene": name, "who": f"volpath: {error!r}"[:300]})
        print(f"{name}: {time.monotonic() - start:.0f} s", file=sys.stderr)
    return out
