#!/usr/bin/env python3
"""The scenes that stand for those of Cha, Yi, Ihm 2010, beside its times.

    tests/bench/bench.py [--budget S] [--jobs N] [--threads N] [--scale F]
                         [--samples N] [--gpu PROGRAM] [--gpu-seconds S]
                         [--references] [--times] [--resume] [--data DIR]
                         [--out DIR] [NAME...]

Makes the grids in DIR ($B/bench) where they are not there, and for each scene
at its published size

    two references by `path`, NAME-SIZE-1.exr and -2.exr in DIR/reference, if
    they are not there: by PROGRAM, a brume with CUDA, up to S seconds each, or
    on the processor for half of the budget each;
    pictures by `photon` with a million photons, 4 samples a pixel and --samples
    (16), by `preset paper` with the published number of photons and 4 samples
    and 1, and by `path` for half of the budget (60), each from two seeds;
    `brume measure` for the budget, if that is 60 or more, for the plot.

Two seeds against two references tell error, bias and noise apart
(tests/tools/judge.h). N pictures are made at a time (1), each with so many
threads (2), on processors of its own if there are several, the scenes in the
order of the names. --references stops behind these. --times makes none, and no
picture but those of `preset paper` with 1 sample, one after another, and leaves
times.md alone: minutes, for a machine that others use too. --resume goes on from what
a call before made with the same program: pictures in DIR, and scenes in
bench.json. Leaves bench.json, bench.svg, README.md and what `measure` makes
in the folder of --out (tests/bench/results), with each scene that is done. No
number there is typed by hand but the published.
"""
import argparse
import contextlib
import fcntl
import hashlib
import json
import math
import os
import platform
import queue
import re
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
B = os.path.join(ROOT, os.environ.get("B", "build"))
BRUME = os.environ.get("BRUME", os.path.join(B, "brume"))
DATA = os.path.join(B, "bench")
GOALS = [0.03, 0.01]


class Scene:
    """What is measured, and the paper's seconds for it."""

    def __init__(self, name, file, size, published, photons, what, *switches):
        self.name, self.file, self.size = name, file, size
        self.published, self.what, self.switches = published, what, switches
        self.photons = photons


VGA = (640, 480)
NONE = "Declare=Geometry=0"
# Photons of tables 2, 3 and 4; table 1 tells none.
SCENES = [
    Scene("t1-cloud", "t1-cloud.pov", VGA, 5.82, 100000, "table 1, cloud",
          NONE),
    Scene("t1-cloud-geometry", "t1-cloud.pov", VGA, 6.16, 100000,
          "table 1, cloud with 3,592 triangles"),
    Scene("t1-fog", "t1-fog.pov", VGA, 2.36, 100000, "table 1, fog", NONE),
    Scene("t1-fog-geometry", "t1-fog.pov", VGA, 10.11, 100000,
          "table 1, fog with 66,454 triangles"),
    Scene("t2-flame1", "t2-flame1.pov", VGA, 6.20, 39000, "table 2, flame 1"),
    Scene("t2-flame2", "t2-flame2.pov", VGA, 8.03, 39000, "table 2, flame 2"),
    Scene("t2-flame3", "t2-flame3.pov", VGA, 3.61, 23000, "table 2, flame 3"),
    Scene("t2-campfire", "t2-campfire.pov", (512, 512), 7.78, 83000,
          "table 2, campfire"),
    Scene("t2-explosion", "t2-explosion.pov", (600, 800), 26.15, 444000,
          "table 2, explosion"),
    Scene("t3-flight", "t3-flight.pov", VGA, 17.19, 250000,
          "table 3, frame 200, all adaptive"),
    Scene("t4-smoke", "t4-smoke.pov", VGA, 4.45, 100000,
          "table 4, frame 31, 100,000 photons, no filter"),
]


def make_grids(data):
    """Only where grids.c or noise.h is younger than what it made."""
    made = os.path.join(data, "grids.txt")
    sources = [os.path.join(HERE, f) for f in ("grids.c", "noise.h")]
    if os.path.exists(made) and all(
            os.path.getmtime(made) >= os.path.getmtime(s) for s in sources):
        return
    os.makedirs(data, exist_ok=True)
    text = subprocess.run([os.path.join(B, "tests/bench/grids"), data],
                          check=True, capture_output=True, text=True).stdout
    with open(made, "w") as f:
        f.write(text)


# ---- measuring


def size_of(scene, options):
    return [max(8, round(side * options.scale)) for side in scene.size]


def words_of(scene, options):
    width, height = size_of(scene, options)
    return [os.path.join(HERE, scene.file), "+L" + options.data, f"+W{width}",
            f"+H{height}", *scene.switches]


def digest():
    """Of the program that is measured."""
    with open(BRUME, "rb") as f:
        return hashlib.sha256(f.read()).hexdigest()[:16]


def processor_seconds(words):
    """Runs a program; what it took of all processors together."""
    child = subprocess.Popen(words)
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise subprocess.CalledProcessError(child.returncode, words)
    return used.ru_utime + used.ru_stime


def run(words, path):
    """One picture: its numbers."""
    stats = path + ".json"
    cpu = processor_seconds(words + ["+O" + path, "--stats", stats, "-V"])
    with open(stats) as f:
        frame = json.load(f)["frames"][0]
    s, photons = frame["seconds"], frame.get("photons", {})
    return {"prepare": s["prepare"], "photons": photons.get("seconds", 0),
            "render": s["render"], "spp": frame["spp"], "cpu": cpu,
            "seconds": s["prepare"] + photons.get("seconds", 0) + s["render"],
            "cells": photons.get("cells", 0),
            "open": photons.get("books", {}).get("rest", 0)}


def run_once(options, words, path):
    """The same, or what it told a call before."""
    kept = path + ".run"
    asked = [digest(), *words[words.index(BRUME):]]
    if options.resume and os.path.exists(kept):
        with open(kept) as f:
            told = json.load(f)
        if told["asked"] == asked:
            return told["told"]
    told = run(words, path)
    with open(kept, "w") as f:
        json.dump({"asked": asked, "told": told}, f)
    return told


@contextlib.contextmanager
def alone(folder):
    """For one at a time, of all processes that make references there."""
    with open(os.path.join(folder, "lock"), "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def make_reference(scene, options, path, seed):
    words = words_of(scene, options) + ["--integrator", "path", "--spp",
                                        "65536", "--seed", str(seed)]
    part = path[:-4] + "-part.exr"
    if options.gpu:
        words = [options.gpu, *words, "--backend", "cuda", "--time",
                 str(options.gpu_seconds)]
    else:
        words = [BRUME, *words, "--backend", "cpu", "--threads",
                 str(options.threads), "--time", str(options.budget / 2)]
    run(words, part)
    os.rename(part, path)


def references(scene, options):
    """Two pictures, and by what they were made."""
    folder = os.path.join(options.data, "reference")
    os.makedirs(folder, exist_ok=True)
    width, height = size_of(scene, options)
    paths = [os.path.join(folder, f"{scene.name}-{width}x{height}-{i}.exr")
             for i in (1, 2)]
    for i, path in enumerate(paths):
        with alone(folder) if options.gpu else contextlib.nullcontext():
            if not os.path.exists(path):
                make_reference(scene, options, path, 11 + i)
    return paths


def picture_of(scene, options, label, seed):
    return os.path.join(options.data, f"{scene.name}-{label}-{seed}.exr")


def draw_seed(scene, options, cores, label, seed, *switches):
    return run_once(options, [*cores, BRUME, *words_of(scene, options),
                              "--backend", "cpu", "--threads",
                              str(options.threads), *switches, "--seed",
                              str(seed)],
                    picture_of(scene, options, label, seed))


def drawn_of(scene, options, label, switches, runs):
    """Of two seeds the quicker one's numbers, and the pictures."""
    paths = [picture_of(scene, options, label, seed) for seed in (1, 2)]
    return dict(min(runs, key=lambda r: r["seconds"]), pictures=paths,
                cpu=min(r["cpu"] for r in runs), switches=" ".join(switches))


def draw(scene, options, cores, label, *switches):
    return drawn_of(scene, options, label, switches,
                    [draw_seed(scene, options, cores, label, seed, *switches)
                     for seed in (1, 2)])


def judge(drawn, true):
    """With what the pictures tell beside the references."""
    tool = os.path.join(B, "tests/tools/compare")
    told = subprocess.run([tool, "judge", *true, *drawn.pop("pictures")],
                          check=True, text=True, capture_output=True).stdout
    return dict(drawn, **json.loads(told))


def plot(scene, options, true, cores):
    """Error against time, by `brume measure`."""
    if options.budget < 60:
        return None
    out = os.path.join(options.out, scene.name)
    done = subprocess.run(
        [*cores, BRUME, "measure", *words_of(scene, options), "--threads",
         str(options.threads), "+O" + out, "--budget", str(options.budget),
         "--reference", true[0]], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{scene.name}: status {done.returncode}\n{done.stderr}")
    return re.findall(r"^for +(\d+) %: (.*)$", done.stdout, re.M)


def kinds_of(scene, options):
    """What is drawn of a scene: labels and switches."""
    photon = ["--integrator", "photon", "--photons", "1000000", "--spp"]
    paper = ["--integrator", "photon", "--preset", "paper", "--photons",
             str(scene.photons), "--spp"]
    return {"many": [*photon, str(options.samples)], "few": [*photon, "4"],
            "paper": [*paper, "4"],
            "path": ["--integrator", "path", "--spp", "65536", "--time",
                     str(options.budget / 2)],
            "rays": [*paper, "1"]}


class Pool:
    """So many pictures at a time, each on processors of its own."""

    def __init__(self, options):
        self.free = queue.Queue()
        for i in range(options.jobs):
            first = i * options.threads
            self.free.put(["taskset", "-c",
                           f"{first}-{first + options.threads - 1}"]
                          if options.jobs > 1 else [])
        self.workers = ThreadPoolExecutor(options.jobs)

    def submit(self, work, *arguments):
        def with_cores():
            cores = self.free.get()
            try:
                return work(cores, *arguments)
            finally:
                self.free.put(cores)
        return self.workers.submit(with_cores)


def ask(scene, options, pool, beside):
    """Futures of all that a scene needs."""
    if options.gpu:
        true = beside.submit(references, scene, options)
    else:
        true = pool.submit(lambda cores: references(scene, options))
    if options.references:
        return true, {}
    return true, {
        label: [pool.submit(lambda cores, label=label, switches=switches,
                            seed=seed: draw_seed(scene, options, cores, label,
                                                 seed, *switches))
                for seed in (1, 2)]
        for label, switches in kinds_of(scene, options).items()}


def measure(scene, options, pool, asked):
    true, runs = asked[0].result(), asked[1]
    if options.references:
        return None
    r = {"name": scene.name, "what": scene.what, "size": size_of(scene, options),
         "published": scene.published, "program": digest()}
    for label, switches in kinds_of(scene, options).items():
        r[label] = judge(drawn_of(scene, options, label, switches,
                                  [x.result() for x in runs[label]]), true)
    r["advice"] = pool.submit(
        lambda cores: plot(scene, options, true, cores)).result()
    print(json.dumps(r), flush=True)
    return r


# ---- what is needed for an error


def seconds_for(r, goal):
    """Of path and of photon; None where bias is in the way. What falls with
    the samples of a pixel is told by few and many; the rest of the noise falls
    with the photons. Where neither does, the cheapest numbers of both that
    would. No bias counts as less than the mean is off."""
    path = r["path"]["prepare"] + r["path"]["render"] * \
        (r["path"]["error"] / goal) ** 2
    few, many = r["few"], r["many"]
    bias = max(many["bias"], abs(many["off"]))
    for k in (few, many):
        if math.hypot(bias, k["noise"]) <= goal:
            return path, k["seconds"]
    room = goal ** 2 - bias ** 2
    if room <= 0:
        return path, None
    pixels = max(few["noise"] ** 2 - many["noise"] ** 2, 0) / \
        (1 / few["spp"] - 1 / many["spp"])
    rest = max(many["noise"] ** 2 - pixels / many["spp"], 0)
    each = many["render"] / many["spp"]
    a, b = math.sqrt(rest * many["photons"]), math.sqrt(pixels * each)
    samples = max(math.sqrt(pixels / each) * (a + b) / room, 1)
    photons = rest / max(room - pixels / samples, 1e-12)
    return path, many["prepare"] + photons * many["photons"] + samples * each


# ---- the page


def percent(error):
    return f"{100 * error:.3g} %"


def seconds(s):
    return "not reached" if s is None else f"{s:.3g} s"


def bias_of(k):
    """With the most that chance leaves it."""
    return f"{percent(max(k['bias'], 0))} (≤ {percent(k['bias_most'])})"


def off_of(k):
    return f"{100 * k['off']:+.2f} ± {100 * k['off_doubt']:.2f} %"


def error_table(results):
    yield ("| scene | `photon`, many samples: error | of it noise | bias | mean "
           "off | `preset paper`: error | bias | mean off | books open by "
           "| noise of the references |")
    yield "|---" * 10 + "|"
    for r in results:
        k, p = r["many"], r["paper"]
        yield "| " + " | ".join(
            [r["name"], percent(k["error"]), percent(k["noise"]), bias_of(k),
             off_of(k), percent(p["error"]), bias_of(p), off_of(p),
             f"{max(abs(k['open']), abs(p['open'])):.1g}",
             percent(k["reference_noise"])]) + " |"


def time_table(results):
    yield ("| scene | paper, GTX 280 | `preset paper`, 1 sample "
           "| half of its processor seconds | 4 samples "
           "| `photon`, 4 samples | many | " +
           " | ".join(f"`path` for {100 * g:g} % | `photon` | times"
                      for g in GOALS) + " |")
    yield "|---" * (7 + 3 * len(GOALS)) + "|"
    for r in results:
        cells = [r["name"], f"{r['published']} s", seconds(r["rays"]["seconds"]),
                 seconds(r["rays"]["cpu"] / 2), seconds(r["paper"]["seconds"]),
                 seconds(r["few"]["seconds"]), seconds(r["many"]["seconds"])]
        for goal in GOALS:
            path, photon = seconds_for(r, goal)
            cells += [seconds(path), seconds(photon),
                      f"{path / photon:.2g}" if photon else ""]
        yield "| " + " | ".join(cells) + " |"


def gpu_name():
    said = subprocess.run(["nvidia-smi", "-L"], capture_output=True, text=True)
    return re.sub(r"^GPU \d+: ", "", said.stdout.split(" (")[0]).strip()


def machine(options):
    name = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo") as f:
            name = re.search(r"model name\s*: (.*)", f.read()).group(1)
    except (OSError, AttributeError):
        pass
    return {"processor": name, "processors": os.cpu_count(),
            "threads": options.threads, "jobs": options.jobs,
            "budget": options.budget, "scale": options.scale,
            "samples": options.samples,
            "gpu": gpu_name() if options.gpu else None,
            "version": subprocess.run([BRUME, "--version"], text=True,
                                      capture_output=True).stdout.strip()}


def page(data):
    m, results = data["machine"], data["results"]
    yield "# The published scenes"
    yield ""
    yield ("Made by `make bench` (`tests/bench/bench.py`). Scenes that stand "
           "for those of Cha, Yi, Ihm 2010, at " +
           ("their published sizes" if m["scale"] == 1 else
            f"{m['scale']:g} of their width and height") +
           f", by {m['version']} on {m['threads']} threads of "
           f"{m['processor']}, {m['jobs']} pictures at a time. `photon` has a "
           f"million photons and 4 or many ({m['samples']}) samples a pixel, "
           "`preset paper` the published number and 4 or 1"
           f"{', the references are of ' + m['gpu'] if m['gpu'] else ''}. "
           "Errors are relRMSE without the noise of the references; "
           "the bias is without the noise of the pictures too, and in brackets "
           "the most that two standard errors of it leave.")
    yield ""
    yield from error_table(results)
    yield ""
    yield ("Seconds of a whole picture, without reading the scene. For an "
           "error they are those of 4 or of many samples where these do. Else "
           "they are told from both: what does not fall with samples falls "
           "with photons, and the cheapest of both is taken; `path` from what "
           f"{m['budget'] / 2:g} seconds make. No bias counts as less than the "
           "mean is off. The paper tells no error of its pictures. Seconds of "
           "`preset paper` alone may be of a later program in times.md.")
    yield ""
    yield from time_table(results)
    yield ""
    yield "![error against seconds](bench.svg)"
    for r in results:
        if not r["advice"]:
            continue
        yield ""
        yield f"## {r['name']}"
        yield ""
        yield f"{r['what']}; {r['size'][0]} x {r['size'][1]}."
        yield ""
        for goal, advice in r["advice"]:
            yield f"- for {goal} %: {advice}"
        yield ""
        yield f"![error against time]({r['name']}.svg)"


# ---- the plot: error against seconds, both by their logarithms

COLORS = ["#4477aa", "#66ccee", "#228833", "#ccbb44", "#ee6677", "#aa3377",
          "#777777", "#000000", "#997700", "#004488", "#bb5566"]
WIDE, HIGH, EDGE = 720, 420, 50


def place(k):
    """From 1 to 1000 s, and from 0.3 to 100 %."""
    x = math.log10(max(k["seconds"], 1)) / 3
    y = (math.log10(max(k["error"], 0.003)) + 2.52) / 2.52
    return EDGE + x * (WIDE - 200), HIGH - EDGE - y * (HIGH - 2 * EDGE)


def svg(results):
    yield (f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDE}" '
           f'height="{HIGH}" font-family="sans-serif" font-size="12">')
    yield f'<rect width="{WIDE}" height="{HIGH}" fill="white"/>'
    for power in range(4):
        x, _ = place({"seconds": 10 ** power, "error": 1})
        yield (f'<path d="M{x:.1f} {EDGE}V{HIGH - EDGE}" stroke="#ddd"/>'
               f'<text x="{x:.1f}" y="{HIGH - 30}">{10 ** power} s</text>')
    for error in (0.01, 0.03, 0.1, 0.3, 1):
        _, y = place({"seconds": 1, "error": error})
        yield (f'<path d="M{EDGE} {y:.1f}H{WIDE - 150}" stroke="#ddd"/>'
               f'<text x="4" y="{y + 4:.1f}">{100 * error:g} %</text>')
    for i, r in enumerate(results):
        color = COLORS[i % len(COLORS)]
        (a, b), (c, d) = place(r["few"]), place(r["many"])
        (e, f), (g, h) = place(r["paper"]), place(r["path"])
        yield (f'<g stroke="{color}" fill="{color}">'
               f'<path d="M{a:.1f} {b:.1f}L{c:.1f} {d:.1f}"/>'
               f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3"/>'
               f'<circle cx="{c:.1f}" cy="{d:.1f}" r="3"/>'
               f'<path d="M{e - 4:.1f} {f + 3:.1f}h8l-4 -7z"/>'
               f'<path fill="none" d="M{g - 4:.1f} {h - 4:.1f}l8 8m0 -8l-8 8"/>'
               f'</g><text x="{WIDE - 140}" y="{EDGE + 16 * i}" '
               f'fill="{color}">{r["name"]}</text>')
    yield (f'<text x="{EDGE}" y="20">dots: photon, few and many samples; '
           'triangles: preset paper; crosses: path</text>')
    yield "</svg>"


def write(options, data):
    with open(os.path.join(options.out, "bench.svg"), "w") as f:
        f.write("\n".join(svg(data["results"])) + "\n")
    with open(os.path.join(options.out, "bench.json"), "w") as f:
        json.dump(data, f, indent=1)
        f.write("\n")
    with open(os.path.join(options.out, "README.md"), "w") as f:
        f.write("\n".join(page(data)) + "\n")


# ---- seconds alone


def times_page(options, results):
    yield "# Seconds of `preset paper`"
    yield ""
    m = machine(options)
    yield ("Made by `tests/bench/bench.py --times`: the published sizes and "
           "numbers of photons, 1 sample a pixel, whole pictures without "
           f"reading the scene, by {m['version']} on {m['threads']} threads of "
           f"{m['processor']} ({m['processors']} processors), the quicker of "
           "two. Where others use the machine too, half of the processor "
           "seconds, of the program with all it reads, are what two idle "
           "processors take, and a little: `busy` is the part of both that the "
           "program had, `load` what waited for them.")
    yield ""
    yield ("| scene | paper, GTX 280 | seconds | busy | load "
           "| half of the processor seconds |")
    yield "|---" * 6 + "|"
    for scene, r in results:
        busy = r["cpu"] / (r["wall"] * options.threads)
        yield (f"| {scene.name} | {scene.published} s | {seconds(r['seconds'])} "
               f"| {100 * busy:.0f} % | {r['load']:.1f} "
               f"| {seconds(r['cpu'] / 2)} |")


def time_one(scene, options, seed):
    start, load = time.monotonic(), os.getloadavg()[0]
    r = draw_seed(scene, options, [], "rays", seed,
                  *kinds_of(scene, options)["rays"])
    return dict(r, load=load, wall=time.monotonic() - start)


def time_all(scenes, options):
    results = []
    for scene in scenes:
        runs = [time_one(scene, options, seed) for seed in (1, 2)]
        results.append((scene, dict(min(runs, key=lambda r: r["seconds"]),
                                    cpu=min(r["cpu"] for r in runs))))
        with open(os.path.join(options.out, "times.md"), "w") as f:
            f.write("\n".join(times_page(options, results)) + "\n")


def kept_of(options):
    """Scenes that a call before measured, of the same program."""
    path = os.path.join(options.out, "bench.json")
    if not options.resume or not os.path.exists(path):
        return []
    with open(path) as f:
        return [r for r in json.load(f)["results"]
                if r.get("program") == digest()]


def measure_all(scenes, options):
    pool, beside = Pool(options), ThreadPoolExecutor(1)
    results, lock = kept_of(options), threading.Lock()
    done = [r["name"] for r in results]
    order = [s.name for s in SCENES]
    asked = {s.name: ask(s, options, pool, beside)
             for s in sorted(scenes, key=lambda s: options.names.index(s.name)
                             if options.names else 0) if s.name not in done}

    def work(scene):
        r = measure(scene, options, pool, asked[scene.name])
        with lock:
            if not r:
                return
            results.append(r)
            results.sort(key=lambda r: order.index(r["name"]))
            write(options, {"machine": machine(options), "results": results})

    with ThreadPoolExecutor(len(asked) or 1) as waiting:
        list(waiting.map(work, [s for s in scenes if s.name in asked]))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--budget", type=float, default=60)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--scale", type=float, default=1)
    parser.add_argument("--samples", type=int, default=16)
    parser.add_argument("--gpu")
    parser.add_argument("--gpu-seconds", type=float, default=15)
    parser.add_argument("--references", action="store_true")
    parser.add_argument("--times", action="store_true")
    parser.add_argument("--resume", action="store_true")
    parser.add_argument("--data", default=DATA)
    parser.add_argument("--out", default=os.path.join(HERE, "results"))
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)
    make_grids(options.data)
    scenes = [s for s in SCENES if not options.names or s.name in options.names]
    (time_all if options.times else measure_all)(scenes, options)


if __name__ == "__main__":
    main()
