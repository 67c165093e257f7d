#!/usr/bin/env python3
"""Table 4 of Cha, Yi and Ihm 2010 with the errors that it lacks: what the
filters of films do to flicker, to detail and to time, in two films at 10,000,
100,000 and 1,000,000 photons; `brume measure --temporal` does it.

    flicker.py [--scene NAME] [--brume PROGRAM] [--grids PROGRAM|FOLDER]
               [--campfire FOLDER] [--frames N] [--size WxH] [--photons N,...]
               [--out FOLDER] [WORD...]

By default of both scenes, t4-smoke and t4-campfire. The grids of t4-smoke are
made by PROGRAM (tests/bench/grids), or lie in its FOLDER; the other FOLDER holds
campfire_01.vdb and so on, as many as the film has frames, by default
scenes/campfire. WORDs go to brume: --backend cuda, --spp 16. One command makes
a scene's table and SCENE.flicker.csv in the folder --out; tests/bench/temporal.md
tells those that made its own."""
import argparse
import glob
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))


def measure(args, scene, frames, library, words):
    command = [args.brume, "measure", "--temporal",
               os.path.join(HERE, scene + ".pov"), f"+L{library}", "+KFI1",
               f"+KFF{frames}", "+O" + os.path.join(args.out, scene),
               "--photons", args.photons]
    width, height = args.size.split("x")
    done = subprocess.run(command + [f"+W{width}", f"+H{height}"] + words,
                          stdout=subprocess.PIPE, text=True, check=True)
    print(f"## {scene}, {width} x {height}\n\n```\n{done.stdout}```\n",
          flush=True)


def smoke(args, words):
    if os.path.isdir(args.grids):
        measure(args, "t4-smoke", args.frames, args.grids, words)
        return
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([args.grids, folder, "t4-smoke"], check=True,
                       stdout=subprocess.DEVNULL)
        measure(args, "t4-smoke", args.frames, folder, words)


def campfire(args, words):
    fires = len(glob.glob(os.path.join(args.campfire, "campfire_*.vdb")))
    if fires == 0:
        sys.exit("no campfire_*.vdb in " + args.campfire)
    measure(args, "t4-campfire", min(fires, args.frames), args.campfire, words)


SCENES = {"t4-smoke": smoke, "t4-campfire": campfire}
parser = argparse.ArgumentParser()
parser.add_argument("--scene", choices=SCENES)
parser.add_argument("--brume", default=os.path.join(ROOT, "build/brume"))
parser.add_argument("--grids",
                    default=os.path.join(ROOT, "build/tests/bench/grids"))
parser.add_argument("--campfire",
                    default=os.path.join(ROOT, "scenes/campfire"))
parser.add_argument("--frames", type=int, default=48)
parser.add_argument("--size", default="640x480")
parser.add_argument("--photons", default="10000,100000,1000000")
parser.add_argument("--out", default=".")
args, words = parser.parse_known_args()
os.makedirs(args.out, exist_ok=True)
for name, run in SCENES.items():
    if args.scene in (None, name):
        run(args, words)
