#!/usr/bin/env python3
"""Writes the presets whose layouts are made by rule, beside this file:  python3 web/presets/make_layouts.py

noon-cumulus, silver-lining, sunset-stratocumulus, cirrus, thunderhead and fog-shafts. The first two take the cubes of
other presets; the others place cubes at random, the same at every run. sky-of-100 has a script of its own.
"""

import json
import math
import pathlib
import random

HERE = pathlib.Path(__file__).resolve().parent


def number(x):
    return round(x, 3)


def cube(center, size, radius, particles, density=None):
    made = {
        "particles": int(particles),
        "size": [number(max(s, 0.01)) for s in size],
        "center": [number(c) for c in center],
        "radius": number(radius),
    }
    if density is not None:
        made["density"] = number(density)
    return made


def layout(name):
    return json.loads((HERE / f"{name}.json").read_text())["cubes"]


def cirrus():
    """Hooks of ice: a tuft each, and the filaments that fall from it and are left behind by the wind."""
    dice = random.Random(4)
    cubes = []
    for _ in range(15):
        x, z = dice.uniform(-20, 12), dice.uniform(-22, 5)
        y = 9 + dice.uniform(-0.5, 0.5)
        length, bend = dice.uniform(6, 13), dice.uniform(-0.1, 0.1)
        heading = 0.25 + dice.uniform(-0.12, 0.12)
        strength = dice.uniform(0.5, 1)
        for _ in range(6):
            fx, fz = x + dice.uniform(-0.8, 0.8), z + dice.uniform(-0.9, 0.9)
            own = length * dice.uniform(0.5, 1)
            turn = heading + dice.uniform(-0.09, 0.09)
            steps = 7
            for i in range(steps):
                t = (i + 0.5) / steps
                along = own * t
                cx = fx + along * math.cos(turn)
                cz = fz + along * math.sin(turn) + bend * along * along / own * 2
                cy = y + 0.25 * math.exp(-10 * t) - 1.1 * t**0.7
                cubes.append(cube((cx, cy, cz), (own / steps * 1.5, 0.08 + 0.12 * t, 0.1 + 0.3 * t), 0.2 + 0.28 * t, 8,
                                  strength * (1.1 - t)))
    return cubes


def thunderhead():
    """A tower with a hard head, an anvil that the wind has drawn out, and a ragged shelf below."""
    dice = random.Random(11)
    cubes = []

    def heap(cx, cy, cz, rx, ry, rz, count, radius, particles, density=1.0):
        for _ in range(count):
            while True:
                p = [dice.uniform(-1, 1) for _ in range(3)]
                if sum(c * c for c in p) <= 1:
                    break
            s = dice.uniform(0.16, 0.34) * min(rx, rz)
            cubes.append(cube((cx + p[0] * rx, cy + p[1] * ry, cz + p[2] * rz), (s * 2, s * 1.5, s * 2),
                              radius * dice.uniform(0.75, 1.15), particles, density))

    heap(0, 1.0, 0, 4.6, 0.9, 3.4, 34, 0.8, 26)
    for level in range(9):
        t = level / 8
        lean = 1.5 * t * t
        wide = 3.9 - 1.2 * t + 0.6 * math.sin(2.2 * level)
        heap(lean, 1.6 + 6.6 * t, 0.3 * math.sin(level), max(wide, 1.5), 0.95, max(0.82 * wide, 1.4), 24, 0.78, 26)
    for _ in range(150):  # the anvil
        t = dice.random() ** 0.8
        angle = dice.uniform(-1, 1) * (0.9 - 0.45 * t) * math.pi
        out = 4.6 * math.sqrt(dice.random())
        cx = 1.2 + 7.2 * t * dice.random() + out * math.cos(angle)
        cz = 0.75 * out * math.sin(angle)
        far = min(1.0, math.hypot(cx - 1.4, cz) / 9)
        cy = 9.3 + 0.5 * far + dice.uniform(-0.15, 0.15)
        cubes.append(cube((cx, cy, cz), (1.8, 0.35 - 0.15 * far, 1.8), 0.75 - 0.2 * far, 24, 1.1 - 0.55 * far))
    heap(1.4, 9.7, 0, 1.5, 0.55, 1.3, 10, 0.6, 24)  # the overshooting top
    for _ in range(16):  # turrets at its feet
        angle = dice.uniform(0, 2 * math.pi)
        out = dice.uniform(3.6, 6.4)
        h = dice.uniform(0.5, 1.7)
        for k in range(3):
            cubes.append(cube((out * math.cos(angle), 0.9 + h * k / 2, 0.7 * out * math.sin(angle)),
                              (0.9 - 0.2 * k, 0.6, 0.9 - 0.2 * k), 0.55 - 0.08 * k, 20))
    return cubes


def broken_deck(seed, count, low, wide, deep, radius, particles, gap):
    """Heaps in rows with holes between them."""
    dice = random.Random(seed)
    cubes = []
    for _ in range(count):
        for _ in range(50):
            x, z = dice.uniform(-wide, wide), dice.uniform(-deep, deep * 0.3)
            cell = math.sin(x * gap + 1.3 * math.sin(z * gap * 0.6)) * math.sin(z * gap * 0.9 + 0.8)
            if cell > 0.12:
                break
        s = dice.uniform(0.8, 1.7)
        cubes.append(cube((x, low + 0.3 * s + dice.uniform(0, 0.15), z), (1.6 * s, 0.35 * s, 1.6 * s), radius * s,
                          particles))
    return cubes


CLEAR = {"model": "physical", "turbidity": 2.6}
PRESETS = {
    "noon-cumulus": lambda: {
        "cubes": layout("cumulus-detailed"),
        "fill": "uniform",
        "density": 7,
        "sun": {"elevation": 42, "azimuth": 98, "color": "auto"},
        "sky": CLEAR,
        "ground": {"height": -11, "albedo": [0.1, 0.11, 0.08]},
        "detail": {"amount": 0.8, "size": 2},
        "camera": {"eye": [5.6, -5.6, 16.2], "target": [-0.4, 0.4, 0], "fov": 38},
        "image": {"width": 960, "height": 600},
    },
    "silver-lining": lambda: {
        "cubes": layout("congestus"),
        "fill": "uniform",
        "density": 4,
        "sun": {"elevation": 21, "azimuth": 172, "color": "auto"},
        "sky": {"model": "physical", "turbidity": 3},
        "ground": {"height": -9, "albedo": [0.14, 0.16, 0.1]},
        "detail": {"amount": 0.9, "size": 1.5},
        "camera": {"eye": [3.2, -1.5, 16.5], "target": [0.6, 3.9, 0], "fov": 44},
        "image": {"width": 960, "height": 720, "exposure": -3.2},
    },
    "sunset-stratocumulus": lambda: {
        "cubes": broken_deck(9, 420, 4, 22, 34, 0.75, 16, 0.62),
        "fill": "uniform",
        "density": 1,
        "sun": {"elevation": 3, "azimuth": 152, "color": "auto", "intensity": 80},
        "sky": {"model": "physical", "turbidity": 3, "intensity": 0.4},
        "ground": {"height": 0, "albedo": [0.05, 0.06, 0.07]},
        "detail": {"amount": 0.8, "size": 1.8},
        "haze": {"extinction": 0.012, "height": 0, "scale_height": 1.5, "g": 0.7},
        "camera": {"eye": [0, 1.6, 20], "target": [1.5, 4.6, 0], "fov": 52},
        "image": {"width": 960, "height": 540, "exposure": -1.9},
    },
    "cirrus": lambda: {
        "cubes": cirrus(),
        "fill": "uniform",
        "density": 2,
        "medium": {"g": 0.8},
        "sun": {"elevation": 48, "azimuth": 60, "color": "auto"},
        "sky": {"model": "physical", "turbidity": 2.2},
        "detail": {"amount": 0.8, "size": 2},
        "camera": {"eye": [0, 0, 12], "target": [0, 8.4, -4], "fov": 58},
        "image": {"width": 960, "height": 600, "exposure": -2},
    },
    "thunderhead": lambda: {
        "cubes": thunderhead(),
        "fill": "uniform",
        "density": 7,
        "sun": {"elevation": 22, "azimuth": 66, "color": "auto"},
        "sky": {"model": "physical", "turbidity": 3},
        "ground": {"height": -1.2, "albedo": [0.12, 0.14, 0.08]},
        "detail": {"amount": 0.8, "size": 1.4},
        "haze": {"extinction": 0.012, "height": -1.2, "scale_height": 2.2},
        "camera": {"eye": [3.5, 0.3, 25], "target": [3.0, 4.9, 0], "fov": 38},
        "image": {"width": 960, "height": 640},
    },
    "fog-shafts": lambda: {
        "cubes": broken_deck(5, 300, 5, 17, 24, 0.85, 22, 0.62),
        "fill": "uniform",
        "density": 3,
        "sun": {"elevation": 27, "azimuth": 176, "color": "auto"},
        "sky": {"model": "physical", "turbidity": 4},
        "ground": {"height": 0, "albedo": [0.1, 0.13, 0.07]},
        "detail": {"amount": 0.8, "size": 1.8},
        "haze": {"extinction": 0.055, "height": 0, "scale_height": 2.6, "g": 0.55},
        "camera": {"eye": [0, 0.9, 17], "target": [0, 3.1, 0], "fov": 56},
        "image": {"width": 960, "height": 540, "exposure": -3},
    },
}


def text_of(scene):
    """One cube a line, one other field a line."""
    lines = []
    for name, value in scene.items():
        if name == "cubes":
            rows = ",\n    ".join(json.dumps(one) for one in value)
            lines.append(f'"cubes": [\n    {rows}\n  ]')
        else:
            lines.append(f"{json.dumps(name)}: {json.dumps(value)}")
    return "{\n  " + ",\n  ".join(lines) + "\n}\n"


for name, scene in PRESETS.items():
    (HERE / f"{name}.json").write_text(text_of(scene()))
