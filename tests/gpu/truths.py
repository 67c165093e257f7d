"""Walks and pictures on a GPU against the tables of METHODS.md, section 13; a
part of tests/gpu/run."""
import itertools
import json
import os
import re
import subprocess
import time

PROCESSES = 12
TRUTH = re.compile(r"(not )?ok (.*): (\S+), truth (\S+), SE (\S+) of it, "
                   r"z (\S+), of its picture \S+, (\S+) s, (\S+?)"
                   r"(, short)?$")


def row_of(line):
    found = TRUTH.match(line)
    if not found:
        raise SystemExit(f"not a row: {line}")
    bad, name, mean, truth, error, z, seconds, by, short = found.groups()
    return {"row": name, "truth": float(truth), "mean": float(mean),
            "se": float(error), "z": float(z), "seconds": float(seconds),
            "by": by, "reached": not short, "passed": not bad}


def sums_of(family, rows):
    """A table's rows in one, which may have a walk, pictures or both."""
    walks = [row for row in rows if row["by"] == "walk"]
    pictures = [row for row in rows if row["by"] == "picture"]
    names = {row["row"] for row in rows}
    reached = {row["row"] for row in rows if row["reached"]}
    out = {"row": family, "rows": len(names), "short": len(names - reached)}
    for kind, some in (("walk", walks), ("picture", pictures)):
        zs = [row["z"] for row in some]
        out |= {kind + "s": len(some), kind + "_z": max(zs, key=abs, default=0),
                kind + "_rms": round((sum(z * z for z in zs) /
                                      max(len(zs), 1)) ** 0.5, 2)}
    return out | {"seconds": round(sum(row["seconds"] for row in rows)),
                  "passed": all(row["passed"] for row in rows)}


def run(programs, room, name, until, **settings):
    """The rows that processes with a common queue came to, and whether all
    ended well."""
    queue = os.path.join(room, f"truths-{name}")
    if os.path.exists(queue):
        os.remove(queue)
    said = [f"{queue}-{i}" for i in range(PROCESSES)]
    running = []
    for path in said:
        with open(path, "w") as out:
            running.append(subprocess.Popen(
                [os.path.join(programs, "test_truth_tables"), "all"],
                stdout=out,
                env={**os.environ, "BACKEND": "cuda", "PIXELS": "256",
                     "RELATIVE": "1e-4", "QUEUE": queue, **settings}))
    for p in running:
        try:
            p.wait(max(until - time.monotonic(), 0.1))
        except subprocess.TimeoutExpired:
            p.kill()
    good = all(p.wait() in (0, 1) for p in running)
    return [row_of(line) for path in said
            for line in open(path).read().splitlines()], good


def rows(programs, room, out):
    """All rows, for eight minutes at most: walks, then pictures. Those that
    failed, or whose error is above the aim in both; each table's sums; which of
    the two did not end well."""
    end = time.monotonic() + float(os.environ.get("TRUTHS_SECONDS", 470))
    walks, walked = run(programs, room, "walks", end, WALK="1",
                        SECONDS_A_ROW="150")
    pictures, drawn = run(programs, room, "pictures", end, WALK="-1",
                          SECONDS_A_ROW="120", PICTURE_SECONDS="1.5",
                          FIRST_SECONDS="20")
    found = walks + pictures
    with open(os.path.join(out, "truths_all.json"), "w") as f:
        json.dump(found, f, indent=1)
    reached = {row["row"] for row in found if row["reached"]}
    families = itertools.groupby(sorted(found, key=lambda row: row["row"]),
                                 key=lambda row: row["row"].split()[0])
    sums = [sums_of(name, list(group)) for name, group in families]
    sums.append(sums_of("all", found))
    sums[-1]["passed"] = sums[-1]["passed"] and walked and drawn
    late = [what for good, what in ((walked, "walks"), (drawn, "pictures"))
            if not good]
    return [row for row in found if not row["passed"] or
            row["row"] not in reached], sums, late
