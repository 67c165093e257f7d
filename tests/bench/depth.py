#!/usr/bin/env python3
"""Cells that follow the media beside cells of one size.

    tests/bench/depth.py [--data DIR] [--scale F] [--budget S] [--photons N]
                         [NAME...]

Of scenes of the bench at F (0.1) of their width and height: cells, bytes,
seconds of the processor for the photons, error, noise and how far the mean is
off, from two seeds beside two references by `path` of S / 2 seconds each (60),
for cells of one size as they come and of half of it, and for some depths. It
prints a table.
"""
import argparse
import json

import bench

DEPTHS = [0.25, 0.5, 1, 2, 4]


def row(name, options, scene, true, *switches):
    drawn = bench.draw(scene, options, [], "depth", "--integrator", "photon",
                       "--photons", str(options.photons), "--spp", "16",
                       *switches)
    with open(drawn["pictures"][0] + ".json") as f:
        photons = json.load(f)["frames"][0]["photons"]
    r = bench.judge(drawn, true)
    print(f"| {scene.name} | {name} | {photons['side']:.3g} "
          f"| {photons['cells']} | {photons['bytes'] / 1e6:.3g} MB "
          f"| {r['photons']:.3g} s | {bench.percent(r['error'])} "
          f"| {bench.percent(r['noise'])} | {bench.off_of(r)} |", flush=True)
    return photons["side"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--data", default=bench.DATA)
    parser.add_argument("--scale", type=float, default=0.1)
    parser.add_argument("--budget", type=float, default=60)
    parser.add_argument("--photons", type=int, default=1000000)
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    options.threads, options.gpu, options.resume = 2, None, False
    bench.make_grids(options.data)
    print("| scene | cells | smallest side | number | bytes | photons "
          "| error | noise | mean off |\n" + "|---" * 9 + "|")
    for scene in bench.SCENES:
        if options.names and scene.name not in options.names:
            continue
        true = bench.references(scene, options)
        side = row("of one size", options, scene, true)
        row("of half of it", options, scene, true, "--field-spacing",
            str(side / 2))
        for depth in DEPTHS:
            row(f"depth {depth:g}", options, scene, true, "--field-depth",
                str(depth))


if __name__ == "__main__":
    main()
