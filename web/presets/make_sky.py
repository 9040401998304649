#!/usr/bin/env python3
"""Writes sky-of-100.json: a field of a hundred cumuli of 200,000 particles, seen from among their tops.

    web/presets/make_sky.py > web/presets/sky-of-100.json

Bases stand at one height; no two overlap. A cloud is a floor of turrets with
others piled on it, smaller the higher they stand. The same bytes on every run.
"""
import json
import math
import random

CLOUDS = 100
PARTICLES = 200_000
EYE = [0, 3.4, 27]
GROUND = -8


def turrets(dice, radius, height):
    """Cubes of a cloud of this half width and height, its base at y = 0."""
    wide, deep = radius, radius * dice.uniform(0.55, 0.9)
    cubes = []

    def add(x, z, foot, size, tall):
        cubes.append({"size": [size, tall, size], "center": [x, foot + tall / 2, z]})

    ring = 11
    for i in range(ring):
        turn = 2 * math.pi * (i + dice.uniform(-0.3, 0.3)) / ring
        out, size = dice.uniform(0.5, 0.78), radius * dice.uniform(0.32, 0.52)
        add(wide * out * math.cos(turn), deep * out * math.sin(turn), 0, size, 0.5 * size)
    add(0, 0, 0, 0.9 * radius, 0.4 * radius)
    # Piles, the first in the middle and the highest.
    for pile in range(dice.randrange(2, 5)):
        turn, out = dice.uniform(0, 2 * math.pi), dice.uniform(0.3, 0.55) if pile else 0.15
        x, z = wide * out * math.cos(turn), deep * out * math.sin(turn)
        top = height * (dice.uniform(0.35, 0.85) if pile else 1)
        foot, size = 0.0, radius * dice.uniform(0.45, 0.62)
        for _ in range(5):
            if foot + 0.8 * size > top + 0.2 * radius:
                break
            for _ in range(3):
                aside = 0.42 * size
                add(x + aside * dice.uniform(-1, 1), z + aside * dice.uniform(-1, 1), foot + 0.12 * size * dice.random(),
                    size * dice.uniform(0.6, 1), 0.75 * size)
            foot += 0.5 * size
            size *= dice.uniform(0.72, 0.92)
    return cubes


def rounded(cubes, particles):
    """With `particles` shared by volume."""
    volumes = [math.prod(c["size"]) ** 0.8 for c in cubes]
    return [{"particles": max(4, round(particles * volume / sum(volumes))), "size": [round(v, 2) for v in c["size"]],
             "center": [round(v, 2) for v in c["center"]], "radius": round(0.3 * c["size"][1], 3)}
            for c, volume in zip(cubes, volumes)]


def rows(dice):
    """Distance, depth and cells (middle, width) of rows that fill the view: clouds in cells of their own stand apart, so
    each can have light of its own (core/survey/islands.h)."""
    found, near = [], 13
    while near < 130:
        depth = 8.5 + 0.065 * near
        found.append((near + depth / 2, depth))
        near += depth
    wide = [1.36 * far + 6 for far, _ in found]
    counts = [max(1, round(CLOUDS * w / sum(wide))) for w in wide]
    counts[-1] += CLOUDS - sum(counts)
    for (far, depth), width, count in zip(found, wide, counts):
        shares = [dice.uniform(0.55, 1.6) for _ in range(count)]
        left, cells = -width / 2, []
        for share in shares:
            own = width * share / sum(shares)
            cells.append((left + own / 2, own))
            left += own
        yield far, depth, cells


def main():
    dice = random.Random(100)
    clouds = []
    for far, depth, cells in rows(dice):
        for middle, width in cells:
            radius = min(0.4 * width * dice.uniform(0.6, 1), 0.38 * depth, 4.8)
            x = middle + (width / 2 - 1.25 * radius) * dice.uniform(-1, 1)
            z = EYE[2] - far + (depth / 2 - 1.25 * radius) * dice.uniform(-1, 1)
            height = radius * (dice.uniform(1, 1.4) if dice.random() < 0.2 else dice.uniform(0.4, 0.8))
            clouds.append((turrets(dice, radius, height), x, z, radius))
    weight = sum(radius ** 1.2 for *_, radius in clouds)
    document = {"clouds": [], "fill": "uniform", "density": 4, "seed": 100,
                "medium": {"g": 0.8, "albedo": 0.9995},
                "sun": {"elevation": 30, "azimuth": 96, "color": "auto"},
                "sky": {"model": "physical", "turbidity": 2.6},
                "ground": {"height": GROUND, "albedo": [0.06, 0.085, 0.045]},
                "haze": {"extinction": 0.006, "height": GROUND, "scale_height": 14},
                "detail": {"amount": 0.7, "size": 1.6},
                "camera": {"eye": EYE, "target": [0, 3.0, -10], "fov": 36},
                "image": {"width": 1200, "height": 675}}
    for number, (cubes, x, z, radius) in enumerate(clouds):
        document["clouds"].append({
            "model": "cubes", "cubes": rounded(cubes, PARTICLES * radius ** 1.2 / weight),
            "translate": [round(x, 2), 0, round(z, 2)], "rotate_y": dice.randrange(360), "seed": 1000 + number})
    # The rounding of particles goes to the largest cube.
    rest = PARTICLES - sum(c["particles"] for cloud in document["clouds"] for c in cloud["cubes"])
    document["clouds"][0]["cubes"][9]["particles"] += rest
    lines = ",\n".join("  " + json.dumps(c, separators=(",", ":")) for c in document.pop("clouds"))
    others = ",\n".join(f' "{k}": {json.dumps(v)}' for k, v in document.items())
    print(f'{{"clouds": [\n{lines}\n ],\n{others}\n}}')


main()
