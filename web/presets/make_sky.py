#!/usr/bin/env python3
"""Writes sky-of-100.json: a hundred clouds of 200,000 particles, from the layouts of humilis-field and congestus.

    web/presets/make_sky.py > web/presets/sky-of-100.json

Bases stand at one height; many clouds are small and few are large; no two overlap much. The same bytes on every run.
"""
import json
import math
import pathlib
import random

CLOUDS = 100
PARTICLES = 200_000
HERE = pathlib.Path(__file__).parent


def layouts(name):
    scene = json.loads((HERE / f"{name}.json").read_text())
    return [cloud["cubes"] for cloud in scene.get("clouds", [scene])]


def grown(cube):
    """Few turrets stand for many: larger, and lower to meet what the smaller ones would have joined them to."""
    x, y, z = cube["center"]
    return {"size": [1.4 * v for v in cube["size"]], "center": [x, 0.85 * y, z]}


def touch(a, b):
    return all(abs(p - q) < 0.6 * (s + t) for p, q, s, t in zip(a["center"], b["center"], a["size"], b["size"]))


def within(a, b):
    return math.dist(a["center"], b["center"]) < 0.3 * max(max(a["size"]), b["size"][1])


def spread_out(cubes, count):
    """The largest cubes that stand neither within each other nor apart, once each is grown."""
    flat = min(cubes[:1], key=lambda c: c["center"][1])
    rest = [grown(c) for c in sorted(cubes, key=lambda c: -math.prod(c["size"]))[:12 * count] if c is not flat]
    kept = [flat]
    while len(kept) < count:
        free = [c for c in rest if any(touch(c, k) for k in kept) and all(not within(c, k) for k in kept)]
        if not free:
            break
        kept.append(free[0])
    return kept


def wide(cubes):
    return max(max(abs(c["center"][a]) + c["size"][a] / 2 for c in cubes) for a in (0, 2))


def rounded(cubes, particles):
    """With `particles` shared by volume."""
    volumes = [math.prod(c["size"]) ** 0.8 for c in cubes]
    return [{"particles": max(4, round(particles * volume / sum(volumes))), "size": [round(v, 2) for v in c["size"]],
             "center": [round(v, 2) for v in c["center"]],
             "radius": round(0.5 * min(c["size"]) if c is not cubes[0] else 0.9 * c["size"][1], 2)}
            for c, volume in zip(cubes, volumes)]


def main():
    dice = random.Random(100)
    humilis = sorted({json.dumps(c) for c in layouts("humilis-field")})
    small = [spread_out(json.loads(c), 5) for c in humilis]
    towers = spread_out(layouts("congestus")[0], 20)
    clouds, places = [], []
    sizes = sorted((dice.paretovariate(1.6) for _ in range(CLOUDS)), reverse=True)
    for index, size in enumerate(sizes):
        tower = index % 14 == 4
        cubes = towers if tower else small[dice.randrange(len(small))]
        # Half the width of the cloud in the scene.
        radius = (1.7 if tower else 1.3) * min(size, 4.5) ** 0.7
        for _ in range(10_000):
            z = dice.uniform(-110, 6)
            x = dice.uniform(-1, 1) * (16 + 0.8 * (14 - z))
            if all(math.hypot(x - u, z - v) > 1.2 * (radius + r) for u, v, r in places):
                break
        places.append((x, z, radius))
        clouds.append((cubes, radius / wide(cubes), x, z, radius))
    weight = sum(radius ** 1.5 for *_, radius in clouds)
    document = {"clouds": [], "density": 0.3, "seed": 100,
                "medium": {"g": 0.6, "albedo": 0.999},
                "sky": {"zenith": [0.09, 0.25, 0.72], "horizon": [0.44, 0.67, 0.95], "intensity": 1.7},
                "sun": {"elevation": 34, "azimuth": 110, "intensity": 40},
                "camera": {"eye": [0, -2.2, 22], "target": [0, 5, -14], "fov": 40},
                "image": {"width": 1200, "height": 675, "exposure": -1.2}}
    for number, (cubes, scale, x, z, radius) in enumerate(clouds):
        document["clouds"].append({
            "model": "cubes", "cubes": rounded(cubes, PARTICLES * radius ** 1.5 / weight),
            "translate": [round(x, 2), 0, round(z, 2)], "scale": round(scale, 3),
            "rotate_y": dice.randrange(360), "seed": 1000 + number})
    # The rounding of particles goes to the largest cube.
    rest = PARTICLES - sum(c["particles"] for cloud in document["clouds"] for c in cloud["cubes"])
    document["clouds"][0]["cubes"][0]["particles"] += rest
    lines = ",\n".join("  " + json.dumps(c, separators=(",", ":")) for c in document.pop("clouds"))
    others = ",\n".join(f' "{k}": {json.dumps(v)}' for k, v in document.items())
    print(f'{{"clouds": [\n{lines}\n ],\n{others}\n}}')


main()
