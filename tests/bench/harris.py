#!/usr/bin/env python3
"""What the classic two passes cost beside transport: processor time of whole commands.

    harris.py AWAN [--repeats N] [SCENE ...]        without scenes: the presets, and table-*.awn of tests/data

By scene, least of N (2) in turn: `harris` over what the scene gets unasked (an error of 10%), and over transport-16, the
cheapest grid; then the seconds of the three. 640 x 400 pixels. Ratios of one run: machines are noisy.
"""
import argparse
import glob
import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
SIZE = ["--set", "/image/width=640", "--set", "/image/height=400"]


def run(awan, scene, rung, folder):
    """Processor seconds and the rung; None where the scene has no such rung (a look, a picture with textures)."""
    command = [awan, "render", scene, *SIZE, "--json", "-o", os.path.join(folder, "picture.png")]
    before = os.times()
    done = subprocess.run(command + (["--rung", rung] if rung else []), capture_output=True, text=True)
    after = os.times()
    if done.returncode != 0:
        return None
    seconds = after.children_user - before.children_user + after.children_system - before.children_system
    return seconds, json.loads(done.stdout.splitlines()[-1])["rung"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("awan")
    parser.add_argument("--repeats", type=int, default=2)
    parser.add_argument("scenes", nargs="*")
    asked = parser.parse_intermixed_args()
    scenes = asked.scenes or sorted(glob.glob(os.path.join(ROOT, "web/presets/*.json"))
                                    + glob.glob(os.path.join(ROOT, "tests/data/table-*.awn")))
    print(f"{'scene':34s} {'/unasked':>8s} {'/transport-16':>13s}  harris unasked transport-16 s", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for scene in scenes:
            least = {}
            for _ in range(asked.repeats):
                for rung in ("harris", None, "transport-16"):
                    took = run(asked.awan, scene, rung, folder)
                    if took is None or (rung == "harris" and took[1] != "harris"):
                        break
                    least[rung] = min(least.get(rung, took), took)
            if len(least) < 3:
                continue
            harris, unasked, coarsest = (least[rung] for rung in ("harris", None, "transport-16"))
            print(f"{os.path.basename(scene):34s} {harris[0] / unasked[0]:8.2f} {harris[0] / coarsest[0]:13.2f}  "
                  f"{harris[0]:.2f} {unasked[0]:.2f} ({unasked[1]}) {coarsest[0]:.2f}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
