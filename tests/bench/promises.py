"""What a server's answers promise under load, and whether it holds: the Retry-After of a refusal, the time_ms that a
504 offers, and previews beside truths that take half a minute.
   python3 tests/bench/promises.py build/release/awan [truths] [retry] [offers]"""
import os
import re
import statistics
import sys
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../proofs"))
from serving import Server  # noqa: E402

awan = sys.argv[1]
CUBE = {"particles": 300, "size": [3, 1, 2], "center": [0, 0, 0], "radius": 0.5}


def picture(width, height, rung, seed=1):
    return {"cubes": [CUBE], "seed": seed, "detail": "none", "image": {"width": width, "height": height},
            "accuracy": {"rung": rung}}


def timed(server, scene):
    begun = time.monotonic()
    answer = server.post("/v1/render", scene)
    return answer, time.monotonic() - begun


def previews(count, server, seed):
    answers = [timed(server, picture(64, 48, "transport-16", seed + i)) for i in range(count)]
    times = sorted(1000 * seconds for _, seconds in answers)
    return "%d of %d answered, median %.0f ms, worst %.0f ms" % (
        sum(answer.status == 200 for answer, _ in answers), count, statistics.median(times), times[-1])


def beside_truths():
    with Server(awan, "--deadline", "120") as server:
        print("previews alone: " + previews(20, server, 0), flush=True)
        truths = []

        def truth(seed):
            answer, seconds = timed(server, picture(160, 120, "truth", seed))
            truths.append("%d after %.1f s" % (answer.status, seconds))

        crowd = [threading.Thread(target=truth, args=(i,)) for i in range(3)]
        for one in crowd:
            one.start()
        time.sleep(1)
        print("previews beside three truths: " + previews(40, server, 100), flush=True)
        still = sum(one.is_alive() for one in crowd)
        for one in crowd:
            one.join()
        print("  %d truths still ran; they were %s" % (still, ", ".join(truths)), flush=True)


def retry_after():
    """Clients keep the lines full. Whoever is refused asks again when it was told to: how often, until it is let in?"""
    with Server(awan, "--deadline", "60", "--queue", "4") as server:
        over = time.monotonic() + 60
        tries = []

        def client(number):
            seed = 1000 * number
            while time.monotonic() < over:
                seed += 1
                answer = server.post("/v1/render", picture(1200, 900, "transport-48", seed))
                told = []
                while answer.status in (429, 503) and len(told) < 50:
                    told.append(int(answer.headers["retry-after"]))
                    time.sleep(told[-1])
                    answer = server.post("/v1/render", picture(1200, 900, "transport-48", seed))
                tries.append((answer.status, told))

        crowd = [threading.Thread(target=client, args=(i,)) for i in range(12)]
        for one in crowd:
            one.start()
        for one in crowd:
            one.join()
        at_once = sum(not told for _, told in tries)
        print("%d requests of 12 clients: %s; %d let in at once, the others after Retry-After (s): %s" % (
            len(tries), {status: sum(s == status for s, _ in tries) for status, _ in tries}, at_once,
            "; ".join(" ".join(map(str, told)) for _, told in tries if told)), flush=True)


def offers():
    with Server(awan, "--deadline", "3") as server:
        for scene in (
                {"cubes": [{**CUBE, "particles": 20000, "size": [8, 4, 8]}],
                 "image": {"width": 1600, "height": 1200}, "accuracy": {"rung": "transport-64"}},
                {"preset": "noon-cumulus", "image": {"width": 1920, "height": 1080}, "accuracy": {"error": 0.02}},
                {"preset": "cumulus", "image": {"width": 1920, "height": 1080}, "accuracy": {"error": 0.01}},
                {"preset": "sky-of-100", "accuracy": {"rung": "transport-64"}}):
            answer, seconds = timed(server, scene)
            name = scene.get("preset", "cubes")
            offered = re.search(r'time_ms[^0-9]*([0-9]+)', answer.body.decode()) if answer.status == 504 else None
            print("%s: %d after %.2f s, offers %s ms" % (
                name, answer.status, seconds, offered.group(1) if offered else "nothing of"), flush=True)
            for seed in range(1, 4 if offered else 1):
                taken, seconds = timed(server, {**scene, "seed": seed,
                                                "accuracy": {"time_ms": int(offered.group(1))}})
                print("  taken up: %d after %.2f s, %s, error %s" % (
                    taken.status, seconds, taken.headers.get("awan-rung"), taken.headers.get("awan-error")),
                    flush=True)


if len(sys.argv) < 3 or "truths" in sys.argv: beside_truths()
if len(sys.argv) < 3 or "retry" in sys.argv: retry_after()
if len(sys.argv) < 3 or "offers" in sys.argv: offers()
