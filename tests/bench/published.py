#!/usr/bin/env python3
"""The bench's scenes at their published sizes, many at a time, each on two
processors of its own, against path on a GPU.

    tests/bench/published.py --gpu PROGRAM [--gpu-seconds S] [--data DIR]
                             [--slots N] [--out FILE] [NAME...]

PROGRAM is brume with CUDA; $BRUME (build/brume) is what is measured. A
reference is rendered from two seeds for S seconds each (5): their difference
tells its noise, which is taken off the errors. `photon` is rendered with 4
samples from two seeds, whose difference tells its noise, and with 16, both
with a million photons; `preset paper` with the published numbers from two;
`path` with 2. What they would need for 3 and 1 % is told from these: samples
by the square of their noise, with the photons' time as it is. FILE gets JSON,
and beside it, as .md, a table.
"""
import argparse
import json
import math
import os
import queue
import subprocess
import threading
from concurrent.futures import ThreadPoolExecutor

import bench

GPU = threading.Lock()


def run(words, cores, data, name):
    """One picture: its path, and the seconds that it took."""
    path = os.path.join(data, name + ".exr")
    stats = path + ".json"
    if cores:
        words = ["taskset", "-c", cores] + words
    subprocess.run(words + ["+O" + path, "--stats", stats, "-V"], check=True)
    with open(stats) as f:
        frame = json.load(f)["frames"][0]
    s = frame["seconds"]
    photons = frame.get("photons", {}).get("seconds", 0)
    return path, {"prepare": s["prepare"], "photons": photons,
                  "render": s["render"],
                  "seconds": s["prepare"] + photons + s["render"]}


def relrmse(a, b):
    return bench.compare("relrmse", a, b)


def less(error, noise):
    return math.sqrt(max(error ** 2 - noise ** 2, 0))


def reference(scene, words, options):
    with GPU:
        seeds = [run([options.gpu] + words +
                     ["--backend", "cuda", "--integrator", "path", "--spp",
                      "65536", "--time", str(options.gpu_seconds), "--seed",
                      str(seed)], None, options.data,
                     f"{scene.name}-path-{seed}")[0] for seed in (11, 12)]
    return seeds[0], relrmse(*seeds) / math.sqrt(2)


def several(scene, words, cores, options, true, noise, label, *switches):
    """Of two seeds: seconds, error, noise, bias, and how far the mean is off."""
    whole = (0, 0) + scene.size
    runs = [run([bench.BRUME] + words + list(switches) + ["--seed", str(seed)],
                cores, options.data, f"{scene.name}-{label}-{seed}")
            for seed in (1, 2)]
    own = relrmse(runs[0][0], runs[1][0]) / math.sqrt(2)
    error = math.sqrt(sum(relrmse(p, true) ** 2 for p, _ in runs) / 2)
    mean = sum(bench.compare("mean", p, *whole) for p, _ in runs) / 2
    return dict(min((t for _, t in runs), key=lambda t: t["seconds"]),
                error=less(error, noise), noise=own,
                bias=less(less(error, noise), own),
                mean=mean / bench.compare("mean", true, *whole) - 1)


def measure(scene, cores, options):
    words = [os.path.join(bench.HERE, scene.file), "+L" + options.data,
             f"+W{scene.size[0]}", f"+H{scene.size[1]}", "--threads", "2",
             *scene.switches]
    true, noise = reference(scene, words, options)
    photon = ["--integrator", "photon", "--photons", "1000000", "--spp"]
    r = {"name": scene.name, "size": scene.size,
         "published": scene.published, "reference_noise": noise}
    r["photon4"] = several(scene, words, cores, options, true, noise,
                           "photon4", *photon, "4")
    path, r["photon16"] = run([bench.BRUME] + words + photon +
                              ["16", "--seed", "3"], cores, options.data,
                              scene.name + "-photon16")
    r["photon16"]["error"] = less(relrmse(path, true), noise)
    r["paper"] = several(scene, words, cores, options, true, noise, "paper",
                         "--integrator", "photon", "--preset", "paper",
                         "--photons", str(scene.photons), "--spp", "4")
    path, r["path2"] = run([bench.BRUME] + words +
                           ["--integrator", "path", "--spp", "2", "--seed",
                            "4"], cores, options.data, scene.name + "-path2")
    r["path2"]["error"] = less(relrmse(path, true), noise)
    print(json.dumps(r), flush=True)
    return r


def needed(r, goal):
    """Seconds of path and of photon for an error; None where bias is in the
    way. No error counts as less than the noise of which it must be, nor a bias
    as less than the mean is off."""
    path = r["path2"]["prepare"] + r["path2"]["render"] * \
        (r["path2"]["error"] / goal) ** 2
    four, last = r["photon4"], r["photon16"]
    bias = max(four["bias"], abs(four["mean"]))
    if max(four["error"], four["noise"]) <= goal:
        return path, four["seconds"]
    error = max(last["error"], four["noise"] / 2)
    if error <= goal:
        return path, last["seconds"]
    room = less(goal, bias)
    if not room > 0:
        return path, None
    return path, last["prepare"] + last["photons"] + last["render"] * max(
        less(error, bias) / room, 1) ** 2


def cell(seconds):
    return "not reached" if seconds is None else f"{seconds:.3g} s"


def table(results):
    percent = bench.percent
    yield ("| scene | paper, GTX 280 | preset paper, 4 samples | error | bias "
           "| mean off | photon, 16 samples | error | bias | mean off "
           "| path for 3 % | photon | times | path for 1 % | photon | times "
           "| reference's noise |")
    yield "|---" * 17 + "|"
    for r in results:
        paper, four, last = r["paper"], r["photon4"], r["photon16"]
        cells = [r["name"], f"{r['published']} s", cell(paper["seconds"]),
                 percent(paper["error"]), percent(paper["bias"]),
                 f"{100 * paper['mean']:+.2f} %", cell(last["seconds"]),
                 percent(last["error"]), percent(four["bias"]),
                 f"{100 * four['mean']:+.2f} %"]
        for goal in (0.03, 0.01):
            path, photon = needed(r, goal)
            cells += [cell(path), cell(photon),
                      f"{path / photon:.2g}" if photon else ""]
        yield "| " + " | ".join(cells + [percent(r["reference_noise"])]) + " |"


def processor():
    with open("/proc/cpuinfo") as f:
        names = [line.split(":")[1].strip() for line in f
                 if line.startswith("model name")]
    return f"{names[0]}, {len(names)} of them" if names else "a processor"


def page(data):
    m = data["machine"]
    yield "# The scenes of the bench at their published sizes"
    yield ""
    yield ("Made by `tests/bench/published.py`: each scene on two processors of "
           f"{m['processor']}, {m['slots']} scenes at a time, against `path` on "
           f"{m['gpu']}. Seconds are of a whole picture, without reading the "
           "scene; `preset paper` has the published numbers of photons, "
           "`photon` a million. Errors are relRMSE, without the reference's "
           "noise; the bias is what two seeds share of them, and can't be told "
           "below a tenth of the reference's noise or of their own. Where a "
           "time for an error was not met by 4 or 16 samples (`path`: 2), it "
           "is told from these by the square of the noise; no error counts "
           "there as less than the noise that two seeds tell, no bias as less "
           "than the mean is off.")
    yield ""
    yield from table(data["results"])


def write(path, data):
    with open(path, "w") as f:
        json.dump(data, f, indent=1)
        f.write("\n")
    with open(os.path.splitext(path)[0] + ".md", "w") as f:
        f.write("\n".join(page(data)) + "\n")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--gpu", required=True)
    parser.add_argument("--gpu-seconds", type=float, default=5)
    parser.add_argument("--data", default=bench.DATA)
    parser.add_argument("--slots", type=int, default=(os.cpu_count() or 2) // 2)
    parser.add_argument("--out", default="published.json")
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    scenes = [s for s in bench.SCENES if not options.names or
              s.name in options.names]
    free = queue.Queue()
    for i in range(options.slots):
        free.put(f"{2 * i},{2 * i + 1}")
    results = []
    gpu = subprocess.run(["nvidia-smi", "-L"], capture_output=True, text=True)
    machine = {"gpu": gpu.stdout.split(" (")[0].strip() or "a GPU",
               "processor": processor(), "slots": options.slots}

    def work(scene):
        cores = free.get()
        try:
            results.append(measure(scene, cores, options))
        except (subprocess.CalledProcessError, OSError) as error:
            print(scene.name, "failed:", error, flush=True)
        free.put(cores)
        results.sort(key=lambda r: [s.name for s in scenes].index(r["name"]))
        write(options.out, {"machine": machine, "results": results})

    with ThreadPoolExecutor(options.slots) as pool:
        list(pool.map(work, scenes))


if __name__ == "__main__":
    main()
