#!/usr/bin/env python3
"""Brume against POV-Ray on media, picture by picture and second by second.

    make && tests/bench/povray_media.py > tests/bench/povray_media.md
    tests/bench/povray_media.py scene...

Both draw POV-Ray's own media samples (its examples must be installed) and the
scenes of media/. POV-Ray takes point samples, so it draws pictures several
times as wide, which are averaged over the area of each pixel, as Brume's are.
The two halves of these samples tell how far the average is off, but for edges
along the picture's columns or rows, on whose sides both halves count the same:
scenes with such edges are drawn wider. Its sums over
media err in proportion to 1 / steps: two numbers of steps give their limit.
Brume's best picture is compared with that. Errors at less cost are against
the mean of the two best pictures.
"""
import glob
import math
import os
import re
import resource
import struct
import subprocess
import sys
import tempfile
import zlib

BRUME = os.environ.get("BRUME", "build/brume")
WIDTH, HEIGHT = 80, 60
STEPS = re.compile(r"\bsamples\s+\d+")
# POV-Ray's best: how many times as wide, and steps in media.
TIMES, STEPS_BEST = 4, (20, 40)
FEWER_STEPS = {"functions": (10, 20)}
# Floors of large tiles, seen from straight above.
MORE_TIMES = {"media4": 16, "media5": 16}
# Cheaper ones; no steps: as the scene has it.
POVRAY = ((1, None), (3, 20))
# Brume's samples a pixel.
REFERENCE = 256
BRUME_SPP = (1, 2, 4, 8, 16, 32, 64)
EXAMPLES = glob.glob("/usr/share/doc/povray*/examples")
SAMPLES = ("media1", "media2", "media4", "media5", "galaxy")
OWN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "media")


# ---- pictures --------------------------------------------------------------

def unpack(data, size):
    """A block of ZIP compression: bytes as differences, odd ones apart."""
    if len(data) == size:
        return data
    data = bytearray(zlib.decompress(data))
    total = data[0]
    for i in range(1, len(data)):
        total = data[i] = (total + data[i] - 128) & 255
    out = bytearray(len(data))
    half = (len(data) + 1) // 2
    out[0::2], out[1::2] = data[:half], data[half:]
    return bytes(out)


def text_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def exr_header(data):
    at, header = 8, {}
    while data[at]:
        name, at = text_at(data, at)
        _, at = text_at(data, at)
        size, = struct.unpack_from("<i", data, at)
        header[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return header, at + 1


def exr_channels(header):
    at, found = 0, []
    while header["channels"][at]:
        name, at = text_at(header["channels"], at)
        kind, = struct.unpack_from("<i", header["channels"], at)
        found.append((name, *{1: ("e", 2), 2: ("f", 4)}[kind]))
        at += 16
    return found


def exr_load(path):
    """Width, height and the planes R, G, B of a file of scan lines."""
    with open(path, "rb") as file:
        data = file.read()
    header, at = exr_header(data)
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    channels = exr_channels(header)
    row = width * sum(size for _, _, size in channels)
    lines = {0: 1, 2: 1, 3: 16}[header["compression"][0]]
    plane = {name: [0.0] * (width * height) for name, _, _ in channels}
    for i in range((height + lines - 1) // lines):
        start, = struct.unpack_from("<Q", data, at + 8 * i)
        y, size = struct.unpack_from("<ii", data, start)
        y -= y0
        count = min(lines, height - y)
        block = unpack(data[start + 8:start + 8 + size], row * count)
        place = 0
        for k in range(y, y + count):
            for name, code, bytes_each in channels:
                plane[name][k * width:(k + 1) * width] = struct.unpack_from(
                    f"<{width}{code}", block, place)
                place += width * bytes_each
    return width, height, [plane[c] for c in "RGB"]


def shrink(picture, half=None):
    """Averaged over blocks, to WIDTH x HEIGHT: R, G, B one after another; or
    over every second sample of a block, like the fields of a chessboard."""
    width, _, planes = picture
    k = width // WIDTH
    out = []
    for plane in planes:
        for y in range(HEIGHT):
            sums, count = [0.0] * WIDTH, 0
            for line in range(k * y, k * (y + 1)):
                row = plane[line * width:(line + 1) * width]
                for i in range(k):
                    if half is None or (line + i) % 2 == half:
                        sums = [s + v for s, v in zip(sums, row[i::k])]
                        count += 1
            out += [s / count for s in sums]
    return out


def relrmse(picture, reference):
    mean = sum(reference) / len(reference)
    floor = 0.01 * mean * mean
    return math.sqrt(sum((a - b) ** 2 / (b * b + floor)
                         for a, b in zip(picture, reference)) / len(picture))


# ---- data ------------------------------------------------------------------

def smoke(x, y, z):
    """A plume of puffs, 0 at the walls."""
    puffs = ((.5, .2, .5, .16), (.45, .38, .55, .2), (.58, .55, .45, .22),
             (.42, .72, .5, .2), (.6, .8, .6, .14))
    sum_ = 0
    for a, b, c, r in puffs:
        d = ((x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2) / (r * r)
        sum_ += max(0, 1 - d) * (1 + .4 * math.sin(40 * x + 30 * y) *
                                 math.sin(35 * z - 20 * x))
    return min(sum_, 1)


def write_smoke(path, n=64):
    with open(path, "wb") as file:
        file.write(struct.pack(">3H", n, n, n))
        at = [i / (n - 1) for i in range(n)]
        file.write(bytes(int(255 * smoke(x, y, z))
                         for z in at for y in at for x in at))


# ---- the programs ----------------------------------------------------------

def timed(command, folder):
    """CPU seconds of a program, of all its threads; where that is little, the
    median of five."""
    seconds = [cpu_seconds(command, folder)]
    while seconds[0] < 0.2 and len(seconds) < 5:
        seconds.append(cpu_seconds(command, folder))
    return sorted(seconds)[len(seconds) // 2]


def cpu_seconds(command, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise RuntimeError(" ".join(command) + "\n" + done.stderr)
    return (after.ru_utime - before.ru_utime +
            after.ru_stime - before.ru_stime)


class Scene:
    def __init__(self, name, path, folder):
        self.name, self.folder = name, folder
        self.library = os.path.dirname(path)
        with open(path) as file:
            self.text = file.read()

    def write(self, text):
        path = os.path.join(self.folder, self.name + ".pov")
        with open(path, "w") as file:
            file.write(text)
        return path

    def povray(self, times, steps):
        text = self.text
        if steps:
            text = STEPS.sub(f"samples {steps}", text)
        out = os.path.join(self.folder, self.name + "_povray.exr")
        seconds = timed(
            ["povray", "+I" + self.write(text), "+O" + out, "+FE", "-D", "-V",
             "+L" + self.library, "+WT1", "-A", f"+W{WIDTH * times}",
             f"+H{HEIGHT * times}"], self.folder)
        return exr_load(out), seconds

    def brume(self, spp, seed):
        out = os.path.join(self.folder, self.name + "_brume.exr")
        seconds = timed(
            [os.path.abspath(BRUME), "--transport", "pov", "--spp", str(spp),
             "--seed", str(seed), self.write(self.text), "+O" + out,
             "+L" + self.library, "+WL0", "-V", "--threads", "1",
             "+L/usr/share/povray-3.7/include",
             f"+W{WIDTH}", f"+H{HEIGHT}"], self.folder)
        return shrink(exr_load(out)), seconds


# ---- the table -------------------------------------------------------------

HEAD = """# Brume beside POV-Ray on media

`tests/bench/povray_media.py`, %d x %d pixels, relRMSE as in DESIGN.md, CPU
seconds of the whole program on one thread. POV-Ray 3.7 draws with media of
`method 3`; its sums err in proportion to 1 / steps, so *steps* is how far its
picture of the most steps is from the limit of two, *area* how far the averages
of its point samples are off, and *noise* Brume's own. *apart* is the relRMSE of
Brume's best picture against that limit, *light* the ratio of all their light.
The other columns are CPU seconds for one error: of POV-Ray at point samples
as the scene has it (and at 3 x 3 a pixel, 20 steps), of Brume for the same.

| scene | apart | steps | area | noise | light | error | POV-Ray s | Brume s | \
error | POV-Ray s | Brume s |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"""


TAIL = """
## Where they part

POV-Ray's sums go to ours as its steps grow: the red light of Brume's *emission*
is 7.4, 3.2, 0.94, 0.27 % below its at 10, 40, 160, 640 steps, of *absorption*
0.45, 0.14, 0.035, 0.007 %, of *overlap* 2.8, 1.6, 0.8, 0.4 % at 10 to 80. In
*functions* shadow rays are such sums too, and 10 and 20 steps not yet in that
proportion: it is apart by less than they are. At silhouettes (*phases*,
*media2*) it is POV-Ray's average over a pixel that is off.

The floors of *media4* and *media5* have edges along the picture's columns and
rows, of which samples in a square see whole columns only, and *area* nothing:
*media5* is 7.1, 3.3, 2.3 % apart from pictures 4, 12, 16 times as wide. These
two are drawn 16 times as wide. *galaxy*, a flat box that is turned, was 17 %
apart while Brume drew functions from grids over the world's axes.

A third of POV-Ray's time, or less, is what Brume takes for the error of 3 x 3
samples, 4.3 to 25 times less but for *media5*: 3.2 times, and 3.2 to 3.3 in nine
more runs. The edges of its floor lie a few hundredths of a pixel beside the
picture's columns, where points on a grid see none of them. For the error of one
sample a pixel it is 1.7 to 5.0 times as fast: of such pictures half the time is
what programs of this size take to start and to write a file, and scenes of
emission or absorption alone, where POV-Ray takes 5 to 20 samples of a line, are
as fast to draw by it. A single sample lies in its pixel's middle, as POV-Ray's do.

Of several media with unlike types of scattering in one interior POV-Ray takes
the mean of the phase functions, however much each scatters: at right angles
to the light types 1 (rgb <0.1, 0.2, 0.3>) and 5 (0.5, eccentricity 0.6) of a
length of 1, without extinction, under a light of 0.4, show 0.16846, 0.19653,
0.22461, that is the sum of the coefficients times 0.28076, the mean for both.
Brume weighs each by its coefficient: 0.12071, 0.16071, 0.20071.
"""


def limit(few, many, steps):
    """Of pictures whose error is in proportion to 1 / steps."""
    n, m = steps
    return [(m * b - n * a) / (m - n) for a, b in zip(few, many)]


def mean(a, b):
    return [0.5 * (x + y) for x, y in zip(a, b)]


def seconds_for(error, ladder):
    """Between the steps of a ladder of (error, seconds), by their logarithms;
    beyond it as the square of the error."""
    if error >= ladder[0][0]:
        return ladder[0][1]
    for (e0, s0), (e1, s1) in zip(ladder, ladder[1:]):
        if e1 <= error <= e0:
            share = math.log(e0 / error) / math.log(e0 / e1)
            return s0 * (s1 / s0) ** share
    e, s = ladder[-1]
    return s * (e / error) ** 2


def report(scene):
    steps = FEWER_STEPS.get(scene.name, STEPS_BEST)
    times = MORE_TIMES.get(scene.name, TIMES)
    large = [scene.povray(times, n)[0] for n in steps]
    few, many = (shrink(picture) for picture in large)
    area = relrmse(shrink(large[1], 0), shrink(large[1], 1)) / 2
    best = limit(few, many, steps)
    halves = [scene.brume(REFERENCE // 2, seed)[0] for seed in (1, 2)]
    ours = mean(*halves)
    truth = mean(best, ours)
    line = [scene.name, f"{relrmse(ours, best):.2%}",
            f"{relrmse(many, best):.2%}", f"{area:.2%}",
            f"{relrmse(*halves) / 2:.2%}", f"{sum(ours) / sum(best):.4f}"]
    ladder = []
    for spp in BRUME_SPP:
        picture, seconds = scene.brume(spp, 7)
        ladder.append((relrmse(picture, truth), seconds))
    for times, n in POVRAY:
        picture, seconds = scene.povray(times, n)
        error = relrmse(shrink(picture), truth)
        line += [f"{error:.2%}", f"{seconds:.3f}",
                 f"{seconds_for(error, ladder):.3f}"]
    print("| " + " | ".join(line) + " |", flush=True)
    print(scene.name, *(f"{e:.2%} {s:.3f}," for e, s in ladder),
          file=sys.stderr)


def find(name):
    paths = [os.path.join(OWN, name + ".pov")]
    for folder in EXAMPLES:
        paths += glob.glob(f"{folder}/**/{name}.pov", recursive=True)
    return next(path for path in paths if os.path.exists(path))


def main():
    own = sorted(os.path.basename(path)[:-4]
                 for path in glob.glob(OWN + "/*.pov"))
    print(HEAD % (WIDTH, HEIGHT))
    with tempfile.TemporaryDirectory() as folder:
        write_smoke(os.path.join(folder, "smoke.df3"))
        for name in sys.argv[1:] or (*SAMPLES, *own):
            report(Scene(name, find(name), folder))
    if not sys.argv[1:]:
        print(TAIL, end="")


if __name__ == "__main__":
    main()
