#!/usr/bin/env python3
"""Whether reading and writing hide behind rendering: the time that a film
takes over the sum of what its frames' preparing, photons, filter and sampling
take; steps of different frames overlap too, so that these may be more than all
of it. Usage: overlap.py BRUME WORD..."""
import json
import subprocess
import sys
import tempfile
import time

with tempfile.TemporaryDirectory() as folder:
    stats = folder + "/stats.json"
    start = time.monotonic()
    subprocess.run(sys.argv[1:] + ["--stats", stats, "+O" + folder + "/"],
                   check=True, stderr=subprocess.DEVNULL)
    wall = time.monotonic() - start
    with open(stats) as file:
        frames = json.load(file)["frames"]
render = hidden = 0.0
for frame in frames:
    s, p = frame["seconds"], frame.get("photons", {})
    render += s["prepare"] + s["render"]
    render += p.get("seconds", 0.0) + p.get("seconds_filter", 0.0)
    hidden += s["parse"] + s["write"]
print(f"{len(frames)} frames: {wall:.2f} s; rendering {render:.2f} s, "
      f"{100 * render / wall:.1f} %; reading and writing {hidden:.2f} s")
