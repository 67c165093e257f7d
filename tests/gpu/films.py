"""Films and stills on a GPU that are stopped, killed and taken up again, what
filters of films take there, and what of a film's meshes travels to it; a part
of tests/gpu/run."""
import glob
import json
import os
import random
import signal
import subprocess
import sys
import time

FOG = """#version 3.7;
camera { location <0, 0, -4> look_at 0 }
light_source { <9, 9, -9> rgb 2 }
sphere { <0.2 * clock, 0, 0>, 1 hollow pigment { rgbt 1 }
    interior { media { scattering { 1, rgb 6 } absorption 0.1 } } }
"""
# Half of its triangles stand still, half turn.
MESHES = """#version 3.7;
camera { location <0, 4, -6> look_at 0 }
light_source { <9, 9, -9> rgb 2 }
#declare Land = height_field { function 400, 400 { pattern { bumps } }
    translate -0.5 scale <4, 0.4, 4> }
object { Land pigment { rgb 0.6 } }
object { Land scale 0.3 rotate 90 * clock * y translate y
    pigment { rgb 0.9 } }
"""
# Takes all of a GPU's memory but so many MiB; waits for its input to end.
HOLD = """import ctypes, sys
cuda = ctypes.CDLL("libcuda.so.1")
context, at = ctypes.c_void_p(), ctypes.c_uint64()
free, all = ctypes.c_size_t(), ctypes.c_size_t()
def check(code):
    if code:
        sys.exit(f"the driver failed: {code}")
check(cuda.cuInit(0))
check(cuda.cuDevicePrimaryCtxRetain(ctypes.byref(context), 0))
check(cuda.cuCtxSetCurrent(context))
check(cuda.cuMemGetInfo_v2(ctypes.byref(free), ctypes.byref(all)))
left = int(sys.argv[1]) << 20
check(cuda.cuMemAlloc_v2(ctypes.byref(at),
                         ctypes.c_size_t(max(free.value - left, 1 << 20))))
print("held", flush=True)
sys.stdin.read()
"""
LEFT = (2000, 1600, 1200, 800)     # MiB
FRAMES = 4
DEALT = 12     # frames of films that two GPUs share


class Films:
    """The program, a scratch folder and the folder of grids and scenes."""

    def __init__(self, brume, room, bench):
        self.brume, self.room, self.bench = brume, room, bench

    def path(self, name):
        return os.path.join(self.room, name)

    def command(self, scene, name, words):
        return [self.brume, scene, "+O" + self.path(name + ".exr"), "--backend", "cuda",
                "--resume", "--stats", self.path("films.json"),
                "+L" + self.bench, *words]

    def begin(self, *command):
        return subprocess.Popen(self.command(*command),
                                stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)

    def finish(self, *command):
        """Its seconds and frames; ends the test if it fails."""
        start = time.monotonic()
        run = self.begin(*command)
        said = run.communicate()[1]
        if run.returncode != 0:
            raise SystemExit(f"status {run.returncode}\n{said}")
        seconds = time.monotonic() - start
        with open(self.path("films.json")) as f:
            return seconds, json.load(f)["frames"]

    def stop(self, after, *command):
        """Exit code of a run that is told to end after so many seconds, and
        the milliseconds it takes to."""
        run = self.begin(*command)
        time.sleep(after)
        start = time.monotonic()
        run.send_signal(signal.SIGTERM)
        run.communicate()
        return run.returncode, round(1e3 * (time.monotonic() - start))

    def forget(self, name):
        for path in glob.glob(self.path(name + "*")):
            os.remove(path)

    def pictures(self, name):
        return sorted(p for p in glob.glob(self.path(name + "*.exr")))

    def same(self, name, whole):
        """Pictures of one run that are those of another, and all there are."""
        names = self.pictures(name)
        return sum(read(p) == read(p.replace(name, whole, 1))
                   for p in names), len(names)

    def scene(self, name, text):
        path = self.path(name + ".pov")
        with open(path, "w") as f:
            f.write(text)
        return path


def read(path):
    with open(path, "rb") as f:
        return f.read()


def words_of(integrator, film, spp):
    words = ["+W640", "+H480", "--integrator", integrator, "--transport",
             "full", "--photons", "1000000", "--spp", str(spp)]
    return words + ([f"+KFF{FRAMES}"] if film else [])


def enough_samples(films, scene, integrator, film):
    """So many that a run takes some seconds."""
    spp = {}
    for n in (64, 2048):
        films.forget("tried")
        spp[n], _ = films.finish(scene, "tried", words_of(integrator, film, n))
    each = max((spp[2048] - spp[64]) / 1984, 1e-5)
    return min(max(int((6 - spp[64]) / each) // 2 * 2, 64), 60000)


def stop_row(films, scene, integrator, film):
    """Told to end in the middle, three times, then finished."""
    words = words_of(integrator, film,
                     enough_samples(films, scene, integrator, film))
    films.forget("whole")
    films.forget("part")
    seconds, _ = films.finish(scene, "whole", words)
    codes, worst, kept = [], 0, 0
    for share in (0.35, 0.45, 0.4):
        code, ms = films.stop(share * seconds, scene, "part", words)
        codes.append(code)
        worst = max(worst, ms)
        kept += len(glob.glob(films.path("part*.part")))
    films.finish(scene, "part", words)
    good, count = films.same("part", "whole")
    wanted = FRAMES if film else 1
    return {"what": ("film" if film else "still") + ", SIGTERM",
            "how": integrator, "seconds": round(seconds, 2),
            "codes": " ".join(map(str, codes)), "worst ms": worst,
            "kept": kept, "same": f"{good} of {wanted}",
            "passed": good == count == wanted and codes[0] == 75 and
            set(codes) <= {0, 75} and worst < 5000 and kept > 0}


def trace_row(films, scene):
    """Told to end while photons fly that would take a minute."""
    films.forget("part")
    words = words_of("photon", False, 4)
    words[words.index("1000000")] = "20000000000"
    code, ms = films.stop(3, scene, "part", words)
    left = films.pictures("part")
    return {"what": "photons, SIGTERM", "how": "photon", "codes": str(code),
            "worst ms": ms, "passed": code == 75 and ms < 5000 and not left}


def kill_row(films, scene, integrator):
    """Killed at ten moments: what there is is whole."""
    words = words_of(integrator, True, 256)
    films.forget("whole")
    films.forget("part")
    seconds, _ = films.finish(scene, "whole", words)
    torn, kills, moments = 0, 0, random.Random(1)
    for _ in range(10):
        run = films.begin(scene, "part", words)
        time.sleep((0.3 + 0.6 * moments.random()) * seconds)
        run.kill()
        run.communicate()
        kills += run.returncode != 0
        good, count = films.same("part", "whole")
        torn += count - good
        if run.returncode == 0:
            films.forget("part")
    films.finish(scene, "part", words)
    good, count = films.same("part", "whole")
    return {"what": "film, SIGKILL", "how": integrator,
            "seconds": round(seconds, 2), "kills": kills,
            "same": f"{good} of {FRAMES}", "torn": torn,
            "passed": good == count == FRAMES and torn == 0 and kills > 2}


def smoke(films):
    """An INI file of t4-smoke."""
    path = films.path("smoke.ini")
    with open(path, "w") as f:
        f.write("Input_File_Name = " + os.path.join(
            os.path.dirname(os.path.dirname(os.path.abspath(__file__))),
            "bench", "t4-smoke.pov"))
    return path


def frame_seconds(films, temporal):
    """A frame's seconds in the middle of a film of t4-smoke at its published
    size, by the moments at which pictures were whole, so that neither start nor
    end counts; the filter's own, too."""
    films.forget("whole")
    _, frames = films.finish(
        smoke(films), "whole", ["+KFI1", "+KFF48", "+SF9", "+EF40", "+W640",
                                "+H480", "--integrator", "photon", "--photons",
                                "100000", "--spp", "32", "--temporal", temporal])
    done = [os.stat(path).st_mtime for path in films.pictures("whole")[4:]]
    own = [f["photons"]["seconds_filter"] for f in frames[1:]]
    return (done[-1] - done[0]) / (len(done) - 1), sum(own) / len(own)


def filter_rows(films):
    """What filters add to the time of a frame that has all its neighbours, by the
    clock: the least of five films, one way after the other. `alone`: while one
    runs, in another thread than the one that works with the device."""
    ways = {"1": None, "3": 0.05, "5": 0.05, "adaptive": 0.1}
    runs = {how: [] for how in ways}
    for _ in range(5):
        for how in ways:
            runs[how].append(frame_seconds(films, how))
    least = {how: min(frame for frame, _ in run) for how, run in runs.items()}
    out = []
    for how, aim in ways.items():
        share = 1 - least["1"] / least[how]
        out.append({"what": "filter", "how": how,
                    "ms": round(1e3 * least[how], 2),
                    "most": round(1e3 * max(f for f, _ in runs[how]), 2),
                    "alone": round(1e3 * min(own for _, own in runs[how]), 2),
                    "share %": round(100 * share, 2),
                    "passed": aim is None or share <= aim})
    return out


def upload_row(films):
    """MiB to the device, a frame, when all is there that stands still."""
    films.forget("whole")
    _, frames = films.finish(films.scene("meshes", MESHES), "whole",
                             ["+KFF6", "+W64", "+H48", "--spp", "4",
                              "--integrator", "path"])
    sent = [f["uploaded"] / 2**20 for f in frames]
    later = max(sent[2:])
    return {"what": "meshes, MiB a frame", "how": "path",
            "first": round(sent[0], 1), "later": round(later, 1),
            "passed": later < 0.62 * sent[0]}


def memory_row(films):
    """MiB that frames set aside: no more once two of them had theirs."""
    films.forget("whole")
    _, frames = films.finish(films.scene("fog", FOG), "whole",
                             ["+KFF6", "+W64", "+H48", "--spp", "4",
                              "--integrator", "photon", "--photons", "20000"])
    taken = [f["allocated"] / 2**20 for f in frames]
    return {"what": "memory, MiB a frame", "how": "photon",
            "first": round(taken[0], 1), "later": round(max(taken[2:]), 1),
            "passed": taken[0] > 0 and max(taken[2:]) == 0}


def full_row(films, scene, left, words):
    """A film where others left so many MiB: the same bytes, by launches of fewer
    paths or by the CPU."""
    films.forget("part")
    hold = subprocess.Popen([sys.executable, "-c", HOLD, str(left)], text=True,
                            stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    held = hold.stdout.readline() == "held\n"
    try:
        seconds, frames = films.finish(scene, "part",
                                       ["--backend", "auto", *words])
    except SystemExit as failed:
        print(failed)
        return {"what": f"{left} MiB left", "how": "failed", "passed": False}
    finally:
        hold.communicate()
    good, count = films.same("part", "whole")
    return {"what": f"{left} MiB left", "how": frames[-1]["backend"],
            "seconds": round(seconds, 2), "same": f"{good} of {count}",
            "first": round(frames[0]["allocated"] / 2**20, 1),
            "passed": held and good == count == 2}


def full_rows(films):
    """Meshes that stay on the device from frame to frame, and more paths than a
    launch has; of the rows with less memory one is still the GPU's."""
    words = ["+KFF2", "+W1024", "+H768", "--spp", "8", "--integrator", "path"]
    scene = films.scene("meshes", MESHES)
    films.forget("whole")
    _, frames = films.finish(scene, "whole", words)
    whole = round(frames[0]["allocated"] / 2**20, 1)
    out = [full_row(films, scene, left, words) for left in LEFT]
    fewer = any(row["how"] == "cuda" and row["first"] < 0.7 * whole
                for row in out)
    return out + [{"what": "all memory, then fewer paths at a time",
                   "how": "path", "first": whole, "passed": fewer}]


def devices():
    """GPUs of this machine."""
    said = subprocess.run(["nvidia-smi", "-L"], capture_output=True, text=True)
    return said.stdout.count("GPU ") if said.returncode == 0 else 0


def deal_row(films, what, scene, words):
    """Dealt to two GPUs, beside one: the same bytes."""
    if devices() < 2:
        return {"what": what, "how": "2 GPUs", "passed": "skipped: one GPU"}
    seconds = {}
    for gpus, name in ((1, "whole"), (2, "part")):
        films.forget(name)
        seconds[gpus], frames = films.finish(
            scene, name, ["+W640", "+H480", "--gpus", str(gpus), *words])
        dealt = {frame["device"] for frame in frames}
    good, count = films.same("part", "whole")
    return {"what": what, "how": "2 GPUs", "seconds": round(seconds[2], 2),
            "one": round(seconds[1], 2), "same": f"{good} of {DEALT}",
            "passed": good == count == DEALT and len(dealt) == 2}


def deal_rows(films):
    """With what stays on a device, grids, meshes and trees, and a filter that
    takes fields that the other one made."""
    film = [f"+KFF{DEALT}"]
    photon = film + ["--integrator", "photon", "--transport", "full",
                     "--photons", "1000000", "--spp", "64"]
    out = [deal_row(films, "fog", films.scene("fog", FOG), photon),
           deal_row(films, "meshes", films.scene("meshes", MESHES), film + [
               "--integrator", "path", "--spp", "256"]),
           deal_row(films, "meshes in fog, filtered",
                    films.scene("both", MESHES + FOG[FOG.index("sphere"):]),
                    photon)]
    if os.path.exists(os.path.join(films.bench, "t4-smoke_30.vdb")):
        out.append(deal_row(films, "grids, filtered", smoke(films), photon))
    return out


def rows(brume, room, bench):
    films = Films(brume, room, bench)
    scene = films.scene("fog", FOG)
    out = [stop_row(films, scene, integrator, film)
           for film in (False, True) for integrator in ("path", "photon")]
    out.append(trace_row(films, scene))
    out += [kill_row(films, scene, integrator)
            for integrator in ("path", "photon")]
    if os.path.exists(os.path.join(bench, "t4-smoke_30.vdb")):
        out += filter_rows(films)
    out.append(upload_row(films))
    out.append(memory_row(films))
    out += full_rows(films)
    out += deal_rows(films)
    return [{key: row.get(key, "") for key in
             ("what", "how", "seconds", "one", "codes", "worst ms", "kept", "same",
              "kills", "torn", "ms", "most", "alone", "share %", "first", "later",
              "passed")}
            for row in out]
