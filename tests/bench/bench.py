#!/usr/bin/env python3
"""The nine scenes that stand for those of Cha, Yi, Ihm 2010, beside its times.

    tests/bench/bench.py [--budget S] [--jobs N] [--threads N] [--scale F]
                         [--backend NAME] [--out DIR] [NAME...]

Makes the grids in $B/bench, then measures each scene at its published size
with `brume measure`, for S seconds each (60), N at a time (1). References are
those of $B/bench/reference/NAME.exr where they are, and else their own. Then
it renders the integrator photon as it comes, and with the published choices
and numbers of photons, each from two seeds, whose difference tells the noise.
It leaves bench.json, the tables and plots of `measure` and a page of them in DIR
(tests/bench/results). No number in them is typed by hand but the published.
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import platform
import re
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
B = os.path.join(ROOT, os.environ.get("B", "build"))
BRUME = os.environ.get("BRUME", os.path.join(B, "brume"))
DATA = os.path.join(B, "bench")
GOALS = [0.10, 0.03, 0.01]


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


def make_grids():
    """Only where grids.c or noise.h is younger than what it made."""
    made = os.path.join(DATA, "grids.txt")
    sources = [os.path.join(HERE, f) for f in ("grids.c", "noise.h")]
    if os.path.exists(made) and all(
            os.path.getmtime(made) >= os.path.getmtime(s) for s in sources):
        return
    os.makedirs(DATA, exist_ok=True)
    text = subprocess.run([os.path.join(B, "tests/bench/grids"), DATA],
                          check=True, capture_output=True, text=True).stdout
    with open(made, "w") as f:
        f.write(text)


# ---- measuring


def size_of(scene, scale):
    return [max(8, round(side * scale)) for side in scene.size]


def words_of(scene, options):
    width, height = size_of(scene, options.scale)
    words = [os.path.join(HERE, scene.file), "+L" + DATA, f"+W{width}",
             f"+H{height}", "--backend", options.backend, *scene.switches]
    if options.threads:
        words += ["--threads", str(options.threads)]
    return words


def measure(scene, options):
    width, height = size_of(scene, options.scale)
    out = os.path.join(options.out, scene.name)
    words = [BRUME, "measure", *words_of(scene, options), "+O" + out,
             "--budget", str(options.budget)]
    reference = os.path.join(DATA, "reference", scene.name + ".exr")
    if os.path.exists(reference):
        words += ["--reference", reference]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{scene.name}: status {done.returncode}\n{done.stderr}")
    own = out + "-reference.exr"
    if os.path.exists(own):
        reference = os.path.join(DATA, scene.name + "-own.exr")
        os.replace(own, reference)
    result = read(scene, out + ".csv", (width, height), done.stdout)
    noise = result["reference_noise"] or 0
    result["photon"] = judge(scene, options, reference, noise,
                             "--photons", "1000000", "--spp", "64")
    result["paper"] = judge(scene, options, reference, noise, "--preset",
                            "paper", "--photons", str(scene.photons), "--spp",
                            "16")
    print(scene.name, "done", flush=True)
    return result


# ---- photons as they come, and as published


def compare(*words):
    tool = os.path.join(B, "tests/tools/compare")
    return float(subprocess.run([tool, *map(str, words)], check=True, text=True,
                                capture_output=True).stdout)


def judge(scene, options, reference, reference_noise, *switches):
    """Two pictures of two seeds: their difference is sqrt(2) of their noise,
    what they share of the difference from the reference is bias."""
    width, height = size_of(scene, options.scale)
    whole = (0, 0, width, height)
    seconds, cpu, picture, mean = [], [], [], []
    for seed in (1, 2):
        path = os.path.join(DATA, f"{scene.name}-{seed}.exr")
        stats = path + ".json"
        run = subprocess.Popen([BRUME, *words_of(scene, options),
                                "--integrator", "photon", *switches, "--seed",
                                str(seed), "+O" + path, "--stats", stats])
        _, status, used = os.wait4(run.pid, 0)
        if status != 0:
            sys.exit(f"{scene.name}: {' '.join(switches)}: status {status}")
        with open(stats) as f:
            frame = json.load(f)["frames"][0]
        seconds.append(frame["seconds"]["prepare"] +
                       frame["seconds"]["render"] +
                       frame.get("photons", {}).get("seconds", 0))
        cpu.append(used.ru_utime + used.ru_stime - frame["seconds"]["parse"])
        picture.append(path)
        mean.append(compare("mean", path, *whole))
    noise = compare("relrmse", *picture) / 2 ** 0.5
    square = sum(compare("relrmse", p, reference) ** 2 for p in picture) / 2
    true = compare("mean", reference, *whole)
    return {"switches": " ".join(switches), "seconds": min(seconds),
            "cpu_seconds": min(cpu), "noise": noise,
            "error": max(square - reference_noise ** 2, 0) ** 0.5,
            "bias": max(square - reference_noise ** 2 - noise ** 2, 0) ** 0.5,
            "mean_bias": sum(mean) / 2 / true - 1}


def read(scene, path, size, printed):
    with open(path, newline="") as f:
        rows = [{key: number(value) for key, value in row.items()}
                for row in csv.DictReader(f)]
    noise = rows[0]["reference_noise"] if rows else None
    advice = re.findall(r"^for +(\d+) %: (.*)$", printed, re.M)
    return {"name": scene.name, "what": scene.what, "size": size,
            "published_seconds": scene.published,
            "reference_noise": noise if noise != "" else None,
            "reference": printed.split("\n", 1)[0].replace(ROOT + "/", ""),
            "rows": rows, "advice": {f"{g} %": text for g, text in advice}}


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


# ---- the page


def in_time(result):
    """The best row that took no longer than the paper."""
    rows = [r for r in result["rows"]
            if r["seconds"] <= result["published_seconds"]]
    return min(rows, key=lambda r: r["error"]) if rows else None


def percent(error):
    return f"{100 * error:.3g} %"


def machine(options):
    name = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo") as f:
            name = re.search(r"model name\s*: (.*)", f.read()).group(1)
    except (OSError, AttributeError):
        pass
    return {"processor": name, "processors": os.cpu_count(),
            "threads": options.threads or os.cpu_count(),
            "jobs": options.jobs, "budget": options.budget,
            "scale": options.scale, "load": os.getloadavg()[2],
            "version": subprocess.run([BRUME, "--version"], text=True,
                                      capture_output=True).stdout.strip()}


def cell(advice):
    """'--integrator path --spp 64 (3 s, extrapolated)' as time and switches."""
    found = re.match(r"(.*) \(([\d.e+-]+) s(, extrapolated)?\)", advice)
    if not found:
        return advice
    switches = found.group(1).replace("--integrator ", "").replace("--", "")
    mark = "≈ " if found.group(3) else ""
    return f"{mark}{found.group(2)} s: {switches}"


def seconds_for(rows, goal):
    """Of one series: the quickest row as good, or along the slope of the last
    rows, at most sixteen times as long where a bias may be left."""
    good = [r["cpu_seconds"] for r in rows if r["error"] <= goal]
    if good:
        return min(good)
    rows = [r for r in rows if r["error"] > 0][-3:]
    if not rows:
        return None
    last, slope = rows[-1], -0.5 if rows[-1]["series"] == "path" else 0
    if len(rows) > 1 and last["series"] != "path" and \
            last["error"] < rows[0]["error"]:
        slope = max(-0.5, math.log(last["error"] / rows[0]["error"]) /
                    math.log(last["cpu_seconds"] / rows[0]["cpu_seconds"]))
    if slope > -0.1:
        return None
    factor = (last["error"] / goal) ** (-1 / slope)
    if last["series"].startswith("photon") and factor > 16:
        return None
    return factor * last["cpu_seconds"]


def gain(result, goal):
    """How much longer path takes than the best of the others."""
    series = {}
    for row in result["rows"]:
        series.setdefault(row["series"], []).append(row)
    seconds = {n: seconds_for(rows, goal) for n, rows in series.items()}
    path = seconds.pop("path", None)
    best = min((s, n) for n, s in seconds.items() if s) \
        if any(seconds.values()) else None
    if not path or not best:
        return "none known"
    return f"{path / best[0]:.2g}: {best[1]}"


def photon_table(results):
    yield ("| scene | paper, GTX 280 | photon, 1 M photons, 64 samples | error | bias "
           "| mean off | preset paper, its photons, 16 samples | error | bias | mean off "
           "| gain over path at 3 % | at 1 % |")
    yield "|---" * 12 + "|"
    for r in results:
        cells = [r["name"], f"{r['published_seconds']} s"]
        for kind in ("photon", "paper"):
            k = r[kind]
            cells += [f"{k['cpu_seconds']:.3g} s", percent(k["error"]),
                      percent(k["bias"]), f"{100 * k['mean_bias']:+.2f} %"]
        cells += [gain(r, 0.03), gain(r, 0.01)]
        yield "| " + " | ".join(cells) + " |"


def table(results):
    yield ("| scene | paper, GTX 280 | ours in no more time | error "
           "| " + " | ".join(f"for {100 * g:g} %" for g in GOALS) +
           " | reference's noise |")
    yield "|---" * (5 + len(GOALS)) + "|"
    for r in results:
        best = in_time(r)
        ours = (f"{best['seconds']:.3g} s: " +
                best["switches"].replace("--integrator ", "").replace("--", "")
                if best else "nothing")
        noise = r["reference_noise"]
        yield (f"| [{r['name']}](#{r['name']}) | {r['published_seconds']} s "
               f"| {ours} | {percent(best['error']) if best else ''} | " +
               " | ".join(cell(r["advice"].get(f"{100 * g:g} %", ""))
                          for g in GOALS) +
               f" | {percent(noise) if noise is not None else 'unknown'} |")


def page(data):
    m, results = data["machine"], data["results"]
    yield "# The nine scenes"
    yield ""
    scale = m["scale"]
    yield ("Made by `make bench`. Scenes that stand for those of Cha, Yi, Ihm "
           "2010, at " + ("their published sizes" if scale == 1 else
                          f"{scale:g} of the width and height published, so "
                          f"with {scale * scale:g} of the pixels and as many "
                          "photons") +
           "; the paper's seconds are its GPU's, and it tells no error. Ours: "
           f"{m['version']} on {m['threads']} threads of {m['processor']}, "
           f"{m['jobs']} scenes at a time, where {m['load']:.1f} threads "
           "wanted to run. "
           "Errors are relRMSE against a reference, less its noise; "
           "times are of a whole picture, without reading the scene. "
           "≈: extrapolated.")
    yield ""
    yield from table(results)
    yield ""
    yield "## Photons"
    yield ""
    yield ("Two seeds of each. The error has the reference's noise taken off, "
           "the bias that of the pictures too; it can't be told where it is "
           "less than half of the reference's noise, in the last column above. "
           "The mean is over all pixels. Seconds here are of the processor, all "
           "threads together. The last columns: how many times as many of them "
           "`path` takes for an error, and what takes the least.")
    yield ""
    yield from photon_table(results)
    for r in results:
        yield ""
        yield f"## {r['name']}"
        yield ""
        yield (f"{r['what']}; {r['size'][0]} x {r['size'][1]}. "
               f"{r['reference'][0].upper()}{r['reference'][1:]}.")
        yield ""
        yield f"![error against time]({r['name']}.svg)"


def write(options, data):
    with open(os.path.join(options.out, "bench.json"), "w") as f:
        json.dump(data, f, indent=1)
        f.write("\n")
    with open(os.path.join(options.out, "README.md"), "w") as f:
        f.write("\n".join(page(data)) + "\n")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--budget", type=float, default=60)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--scale", type=float, default=1)
    parser.add_argument("--backend", default="auto")
    parser.add_argument("--out", default=os.path.join(HERE, "results"))
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)
    make_grids()
    scenes = [s for s in SCENES if not options.names or
              s.name in options.names]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(lambda s: measure(s, options), scenes))
    write(options, {"machine": machine(options), "results": results})


if __name__ == "__main__":
    main()
