"""Pictures and walks on a GPU against the tables of METHODS.md, section 13; two
parts of tests/gpu/run."""
import itertools
import json
import os
import re
import subprocess
import time

PROCESSES = 12
SETTINGS = {"truths": {"WALK": "-1", "PIXELS": "256", "SECONDS_A_ROW": "120",
                       "PICTURE_SECONDS": "1.5", "FIRST_SECONDS": "15"},
            "walks": {"WALK": "1", "PIXELS": "64", "SECONDS_A_ROW": "460"}}
TRUTH = re.compile(r"(not )?ok (.*): (\S+), truth (\S+), SE (\S+) of it, "
                   r"z (\S+), of its picture \S+, (\S+) s, (\S+?)"
                   r"(, short|, again)?$")


def row_of(line):
    found = TRUTH.match(line)
    if not found:
        raise SystemExit(f"not a row: {line}")
    bad, name, mean, truth, error, z, seconds, _, end = found.groups()
    return {"row": name, "truth": float(truth), "mean": float(mean),
            "se": float(error), "z": float(z), "seconds": float(seconds),
            "reached": end != ", short", "again": end == ", again", "passed": not bad}


def sums_of(family, rows):
    """A table's rows in one; `fine`: whose error is 1e-4 of the truth at most."""
    zs = [row["z"] for row in rows]
    return {"row": family, "rows": len(rows),
            "fine": sum(row["se"] <= 1e-4 for row in rows),
            "short": sum(not row["reached"] for row in rows),
            "again": sum(row["again"] for row in rows),
            "largest_z": max(zs, key=abs, default=0),
            "rms_z": round((sum(z * z for z in zs) / max(len(zs), 1)) ** 0.5, 2),
            "seconds": round(sum(row["seconds"] for row in rows)),
            "passed": all(row["passed"] and row["reached"] for row in rows)}


def run(programs, room, part, seconds):
    """The rows that processes with a common queue came to, and whether all
    ended well and in little more than that time."""
    queue = os.path.join(room, f"{part}-queue")
    if os.path.exists(queue):
        os.remove(queue)
    said = [f"{queue}-{i}" for i in range(PROCESSES)]
    running = []
    for path in said:
        with open(path, "w") as out:
            running.append(subprocess.Popen(
                [os.path.join(programs, "test_truth_tables"), "all"],
                stdout=out,
                env={**os.environ, "BACKEND": "cuda", "RELATIVE": "1e-4",
                     "SECONDS_ALL": str(seconds), "QUEUE": queue,
                     **SETTINGS[part]}))
    end = time.monotonic() + seconds + 15
    for p in running:
        try:
            p.wait(max(end - time.monotonic(), 0.1))
        except subprocess.TimeoutExpired:
            p.kill()
    good = all(p.wait() in (0, 1) for p in running)
    return [row_of(line) for path in said
            for line in open(path).read().splitlines()], good


def rows(programs, room, out, part):
    """All rows of a part, for eight minutes at most: those that failed or are
    short; each table's sums; whether it came to its end."""
    seconds = float(os.environ.get("TRUTHS_SECONDS", 455))
    found, ended = run(programs, room, part, seconds)
    with open(os.path.join(out, f"{part}_all.json"), "w") as f:
        json.dump(found, f, indent=1)
    families = itertools.groupby(sorted(found, key=lambda row: row["row"]),
                                 key=lambda row: row["row"].split()[0])
    sums = [sums_of(name, list(group)) for name, group in families]
    sums.append(sums_of("all", found))
    sums[-1]["passed"] = sums[-1]["passed"] and ended
    return [row for row in found
            if not row["passed"] or not row["reached"]], sums, ended
