#!/usr/bin/env python3
"""What can be counted of how pictures look: beauty.py build/release/awan

Renders plain layouts and presets and prints a figure beside what it should be. An eye must still look at them. Needs
oiiotool. Takes a minute.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

AWAN, HERE = os.path.abspath(sys.argv[1]), os.path.dirname(os.path.abspath(__file__))
PRESETS = os.path.join(HERE, "../../web/presets")
SCRATCH = tempfile.mkdtemp()
ONE_CUBE = {"cubes": [{"particles": 2000, "size": [4, 3, 4], "center": [0, 0, 0], "radius": 0.3}]}
TABLE_44 = {"preset": "cumulus"}


def preset(name):
    with open(os.path.join(PRESETS, name + ".json")) as file:
        return json.load(file)


def run(*words, text=None):
    return subprocess.run(words, input=text, capture_output=True, text=True, check=True).stdout


def picture(scene, *flags):
    """Rows of (r, g, b, alpha), 0..255."""
    path = os.path.join(SCRATCH, "picture")
    with open(path + ".json", "w") as file:
        json.dump(scene, file)
    run(AWAN, "render", path + ".json", "--width", "800", "--height", "600", "-o", path + ".png", *flags)
    # One PPM of the colours and one of alpha.
    run("oiiotool", path + ".png", "--ch", "R,G,B", "-d", "uint8", "-o", path + ".ppm")
    colours = plain(path + ".ppm")
    if "transparent" not in flags:
        return [[(*p, 255) for p in row] for row in colours]
    run("oiiotool", path + ".png", "--ch", "A,A,A", "-d", "uint8", "-o", path + ".ppm")
    return [[(*p, a[0]) for p, a in zip(row, alphas)] for row, alphas in zip(colours, plain(path + ".ppm"))]


def plain(path):
    with open(path, "rb") as file:
        kind, size, most, data = file.read().split(b"\n", 3)
    width, height = map(int, size.split())
    assert kind == b"P6" and most == b"255"
    return [[tuple(data[3 * (y * width + x):3 * (y * width + x) + 3]) for x in range(width)] for y in range(height)]


def linear(code):
    v = code / 255
    return v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4


def luma(p):
    return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]


def share(values, at):
    ordered = sorted(values)
    return ordered[min(int(at * len(ordered)), len(ordered) - 1)]


def say(what, figure, wanted, fine):
    print(f"{what:62s} {figure:10.3g}   {wanted:16s} {'' if fine else '<- not'}")


def top_of(rows, x, level):
    return next((y for y in range(len(rows)) if rows[y][x][3] >= level), None)


def edge_at(rows, x, middle):
    """Pixels from a tenth to nine tenths of cover, up and down from a half; at most 60."""
    outer = inner = middle
    while outer > 0 and rows[outer][x][3] >= 26 and middle - outer < 30:
        outer -= 1
    while inner + 1 < len(rows) and rows[inner][x][3] < 230 and inner - middle < 30:
        inner += 1
    return inner - outer


def silhouette(name, scene):
    rows = picture(scene, "--background", "transparent")
    width = len(rows[0])
    edges, tops = [], []
    for x in range(width):
        tops.append(top_of(rows, x, 128))
        if tops[-1] is not None:
            edges.append(edge_at(rows, x, tops[-1]))
    seen = [x for x in range(width) if tops[x] is not None]
    longest = run_length = 0
    for x in seen[2:]:
        a, b, c = tops[x - 2], tops[x - 1], tops[x]
        straight = None not in (a, b, c) and abs((c - b) - (b - a)) == 0
        run_length = run_length + 1 if straight else 0
        longest = max(longest, run_length)
    say(f"{name}: straight run of its upper outline, share of its width", longest / len(seen), "<= .25",
        longest <= 0.25 * len(seen))
    say(f"{name}: width of its upper edge, pixels, median", share(edges, 0.5), "<= 4 sharp", share(edges, 0.5) <= 4)


def body(name, scene):
    """Codes between the 5% and the 95% of what is wholly cloud, and how far the base is below the lit side."""
    rows = picture(scene)
    cover = picture(scene, "--background", "transparent")
    codes, places = [], []
    for y, (row, alphas) in enumerate(zip(rows, cover)):
        for p, a in zip(row, alphas):
            if a[3] >= 250:
                codes.append(luma(p))
                places.append(y)
    spread = share(codes, 0.95) - share(codes, 0.05)
    base_from = share(places, 0.95)
    base = share([c for c, y in zip(codes, places) if y >= base_from], 0.5)
    stops = math.log2(linear(share(codes, 0.95)) / linear(base))
    say(f"{name}: codes from 5% to 95% of its body", spread, ">= 60", spread >= 60)
    say(f"{name}: stops of its base below its lit side", stops, ">= 1.5", stops >= 1.5)
    white = sum(c >= 254 for c in codes) / len(codes)
    say(f"{name}: share of it that is plain white", white, "<= .01", white <= 0.01)


def clear_sky(elevation):
    scene = {"cubes": [{"particles": 1, "size": [1e-3] * 3, "center": [0, -1e4, 0], "radius": 1e-3}],
             "density": 1e-9, "sun": {"elevation": elevation, "azimuth": 110}, "accuracy": {"rung": "single"},
             "camera": {"eye": [0, 0, 0], "target": [0, 0.5, -1], "fov": 60}}
    rows = picture(scene)
    longest = 0
    for row in rows[:300]:
        same = 1
        for before, here in zip(row, row[1:]):
            same = same + 1 if before == here else 1
            longest = max(longest, same)
    say(f"clear sky, sun at {elevation}: longest run of one colour", longest, "<= 8", longest <= 8)
    horizon = [sum(linear(p[c]) for p in rows[530]) / len(rows[530]) for c in range(3)]
    mauve = min(horizon[0], horizon[2]) / horizon[1]
    say(f"clear sky, sun at {elevation}: lesser of red and blue over green, low", mauve, "<= 1.02", mauve <= 1.02)


def main():
    path = os.path.join(SCRATCH, "cube.json")
    with open(path, "w") as file:
        json.dump(ONE_CUBE, file)
    depth = json.loads(run(AWAN, "plan", path))["survey"]["optical_depth"]["eye"]
    say("one cube: optical depth", depth, "20 to 80", 20 < depth < 80)
    silhouette("one cube", ONE_CUBE)
    silhouette("table 4.4", TABLE_44)
    for name in ("noon-cumulus", "congestus", "thunderhead"):
        body(name, preset(name))
    for elevation in (15, 40, 70):
        clear_sky(elevation)


if __name__ == "__main__":
    main()
