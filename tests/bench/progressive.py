#!/usr/bin/env python3
"""What the integrator progressive is wrong by, pass after pass.

    tests/bench/progressive.py [--program PROGRAM] [--backend NAME]
                               [--seconds S] [--photons N] [--passes N,N,...]
                               [--data DIR] [--out FILE] [NAME...]

Of scenes of the bench, three if none is named, at 1/16 of their width and
height: pictures by `progressive` of so many passes, each from two seeds, beside
two references by `path` of S seconds each (40). These are of the published size,
256 of their pixels the mean of one, and kept in DIR/reference ($B/bench), where
bench.py looks for its own. The error is without the references' noise, which is
told too (tests/tools/judge.h); of it, noise is what the seeds differ by, bias
what they have in common. Prints a table as it grows, and writes it to FILE with
the slopes of straight lines through the logarithms of error and passes.
"""
import argparse
import json
import math
import os
import subprocess
import sys

import bench

SCALE = 16
NAMES = ["t1-cloud", "t1-fog", "t2-flame1"]
HEAD = ("| scene | passes | seconds | side of the last cells | error | noise "
        "| bias | mean off |")


def reference(scene, options):
    full = argparse.Namespace(**vars(options))
    full.scale, full.gpu, full.threads = 1, None, 0
    if options.backend == "cuda":
        full.gpu, full.gpu_seconds = options.program, options.seconds
    full.budget = 2 * options.seconds
    return bench.references(scene, full)


def draw(scene, options, passes):
    """Seconds of a picture, the last cells' side, and two pictures."""
    paths, seconds = [], []
    for seed in (1, 2):
        path = os.path.join(options.data,
                            f"{scene.name}-progressive-{passes}-{seed}.exr")
        told = path + ".json"
        subprocess.run(
            [options.program, *bench.words_of(scene, options), "--backend",
             options.backend, "--integrator", "progressive", "--photons",
             str(options.photons), "--spp", str(passes), "--seed", str(seed),
             "+O" + path, "--stats", told, "-V"], check=True)
        with open(told) as f:
            frame = json.load(f)["frames"][0]
        if frame["photons"]["traced"] != passes * options.photons:
            sys.exit(f"{path}: {frame['photons']['traced']} photons")
        paths.append(path)
        seconds.append(frame["seconds"]["prepare"] + frame["seconds"]["render"])
    return min(seconds), frame["photons"]["side"], paths


def row_of(name, passes, seconds, side, j):
    return (f"| {name} | {passes} | {bench.seconds(seconds)} | {side:.3g} "
            f"| {bench.percent(j['error'])} | {bench.percent(j['noise'])} "
            f"| {bench.bias_of(j)} | {bench.off_of(j)} |")


def slope(points):
    """Of the straight line that lies nearest to the logarithms."""
    x = [math.log(p) for p, _ in points]
    y = [math.log(max(e, 1e-6)) for _, e in points]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / \
        sum((a - mx) ** 2 for a in x)


def measure(scene, options):
    """Rows of the table, and what they come to."""
    true, points, rows = reference(scene, options), [], []
    for passes in options.passes:
        seconds, side, paths = draw(scene, options, passes)
        j = bench.judge({"pictures": paths}, true)
        points.append((passes, j["error"]))
        rows.append(row_of(scene.name, passes, seconds, side, j))
        print(rows[-1], flush=True)
    end = points[min(len(points) // 2, len(points) - 2):]
    rest = (f"- {scene.name}: down to {bench.percent(points[-1][1])}, with the "
            f"power {slope(points):.2f} of the passes, {slope(end):.2f} from "
            f"{end[0][0]} on; noise of the references "
            f"{bench.percent(j['reference_noise'])}.")
    print(rest, flush=True)
    return rows, rest


def write(options, rows, rests, by):
    with open(options.out, "w") as f:
        f.write("\n".join([
            "# Passes of `progressive`", "",
            f"Made by `tests/bench/progressive.py`: {options.photons} photons a "
            f"pass, at 1/{SCALE} of the published width and height, by {by}. "
            "relRMSE without the noise of the references; in brackets the most "
            "that chance leaves of the bias.", "", HEAD, "|---" * 8 + "|", *rows,
            "", *rests]) + "\n")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default=bench.BRUME)
    parser.add_argument("--backend", default="cpu")
    parser.add_argument("--seconds", type=float, default=40)
    parser.add_argument("--photons", type=int, default=1000000)
    parser.add_argument("--passes", default="1,4,16,64,256")
    parser.add_argument("--data", default=bench.DATA)
    parser.add_argument("--out", default=os.path.join(
        bench.HERE, "results", "progressive.md"))
    parser.add_argument("names", nargs="*", default=NAMES)
    options = parser.parse_args()
    options.scale = 1 / SCALE
    options.passes = [int(n) for n in options.passes.split(",")]
    bench.make_grids(options.data)
    by = bench.gpu_name() if options.backend == "cuda" else "the processor"
    rows, rests = [], []
    for scene in bench.SCENES:
        if scene.name not in (options.names or NAMES):
            continue
        more, rest = measure(scene, options)
        rows += more
        rests.append(rest)
        write(options, rows, rests, by)


if __name__ == "__main__":
    main()
