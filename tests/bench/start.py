#!/usr/bin/env python3
"""What a start costs: processor time (median of 20 runs) and the most memory of small commands.
   python3 tests/bench/start.py build/release/awan"""
import os
import statistics
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
awan = os.path.abspath(sys.argv[1])
plain = ('{"cubes":[{"particles":200,"size":[7.4,1.07,2.9],"center":[-3.4,-3.3,-0.6],"radius":2.1}],'
         '"image":{"width":64,"height":48}}')
small = ["--width", "64", "--height", "48", "-o", "/dev/null", "--format", "png"]
table = os.path.join(here, "..", "data", "table-4.4.awn")
preset = os.path.join(here, "..", "..", "web", "presets", "cumulus.json")


def cost(*arguments):
    """Milliseconds of processor, MiB of memory."""
    times, most = [], 0
    for _ in range(20):
        pid = os.posix_spawn(awan, [awan, *arguments], os.environ, file_actions=[
            (os.POSIX_SPAWN_OPEN, fd, "/dev/null", os.O_WRONLY, 0) for fd in (1, 2)])
        _, status, used = os.wait4(pid, 0)
        if status != 0:
            sys.exit("failed: " + " ".join(arguments))
        times.append(1000 * (used.ru_utime + used.ru_stime))
        most = max(most, used.ru_maxrss / 1024)
    return "%7.1f ms %6.1f MiB" % (statistics.median(times), most)


with tempfile.TemporaryDirectory() as folder:
    scene = os.path.join(folder, "plain.json")
    with open(scene, "w") as file:
        file.write(plain)
    for name, arguments in [
            ("--version", ["--version"]),
            ("validate", ["validate", scene]),
            ("one cube, 64x48", ["render", scene, *small]),
            ("  without detail", ["render", scene, *small, "--set", "/detail=none"]),
            ("  and a sky by two colours", ["render", scene, *small, "--set", "/detail=none", "--set",
                                           '/sky={"zenith":[0.3,0.5,0.9],"horizon":[0.7,0.8,0.9]}']),
            ("table 4.4, 64x48", ["render", table, *small]),
            ("preset cumulus, 64x48", ["render", preset, *small])]:
        print("%-32s %s" % (name, cost(*arguments)), flush=True)
