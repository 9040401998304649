"""A server under twice the load it can take, for a while.

  soak.py AWAN [MINUTES [CLIENTS]]     minutes (default 30), clients at once (default: twice lanes and places in line)

Requests are mixed by chance: small and larger renders, plans, particles, presets, jobs, what is invalid, what is cancelled in
the middle, what takes too long. Reported: memory over time and its slope, descriptors, every status, those that nothing
explains, the times of /healthz asked from outside, and whether a scene that is asked for again and again has the same bytes.
"""
import collections
import hashlib
import json
import os
import random
import socket
import sys
import threading
import time

from serving import JSON, SCENE, Server

AWAN = sys.argv[1]
MINUTES = float(sys.argv[2]) if len(sys.argv) > 2 else 30
LANES = max(2, os.cpu_count() or 2)
QUEUE = 8
CLIENTS = int(sys.argv[3]) if len(sys.argv) > 3 else 2 * (LANES + 2 * QUEUE)
# What load, a deadline or an invalid request explains.
EXPLAINED = {200, 202, 204, 304, 400, 404, 409, 410, 413, 415, 422, 429, 504}

lock = threading.Lock()
statuses = collections.Counter()
unexplained, health, broken = [], [], collections.Counter()
digests = collections.Counter()
until = time.monotonic() + 60 * MINUTES


def scene(chance, particles, width, rung):
    return {"cubes": [{"particles": particles, "size": [3, 1, 2], "center": [0, 0, 0], "radius": 0.5}],
            "seed": chance.randrange(1000), "image": {"width": width, "height": width * 3 // 4}, "accuracy": {"rung": rung}}


FIXED = {**SCENE, "seed": 11, "image": {"width": 48, "height": 32}, "accuracy": {"rung": "transport-16"}}


def one(server, chance):
    """A request by chance: (what, answer or None)."""
    kind = chance.choices(["fixed", "small", "splats", "large", "plan", "particles", "reading", "invalid", "cancelled", "hopeless",
                           "job"], [25, 20, 8, 3, 12, 8, 10, 8, 8, 2, 3])[0]
    if kind == "fixed":
        # Kept answers are another path: every other one is drawn.
        document = {**FIXED, "name": str(chance.randrange(2))}
        answer = server.post("/v1/render", document)
        if answer.status == 200:
            with lock:
                digests[hashlib.sha256(answer.body).hexdigest()] += 1
        return kind, answer
    if kind == "small":
        return kind, server.post("/v1/render", scene(chance, 50, 48, "harris"))
    if kind == "splats":
        return kind, server.post("/v1/render", scene(chance, 200, 96, "single"))
    if kind == "large":
        return kind, server.post("/v1/render", scene(chance, 3000, 256, "transport-32"))
    if kind == "plan":
        return kind, server.post("/v1/plan", scene(chance, 500, 64, "harris"))
    if kind == "particles":
        return kind, server.post("/v1/particles?format=csv", scene(chance, 5000, 64, "harris"))
    if kind == "reading":
        return kind, server.ask("GET", chance.choice(["/", "/v1/presets", "/openapi.json", "/metrics", "/version", "/nowhere"]))
    if kind == "invalid":
        return kind, server.ask("POST", "/v1/render", chance.choice(["{", "[]", '{"cubes":3}', '{"x":1}', "", "\0"]), JSON)
    if kind == "hopeless":
        return kind, server.post("/v1/render", scene(chance, 100_000, 2048, "truth"))
    if kind == "cancelled":
        body = json.dumps(scene(chance, 3000, 256, "transport-32")).encode()
        with socket.create_connection(("127.0.0.1", server.port)) as connection:
            connection.sendall(b"POST /v1/render HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
                               b"Content-Length: %d\r\n\r\n" % len(body) + body[:chance.choice([len(body), len(body) // 2])])
            time.sleep(chance.uniform(0, 0.2))
        return kind, None
    made = server.post("/v1/jobs", {"kind": "render", "scene": scene(chance, 100, 64, "transport-16")})
    if made.status == 202:
        place = made.headers["location"]
        if chance.random() < 0.5:
            server.ask("GET", place + "/events")
            return kind, server.ask("GET", place + "/result")
        server.ask("DELETE", place)
    return kind, made


def client(server, number):
    chance = random.Random(number)
    while time.monotonic() < until:
        try:
            kind, answer = one(server, chance)
        except Exception as error:  # a connection that was closed: counted, and looked at in the end
            with lock:
                broken[type(error).__name__] += 1
            continue
        if answer is None:
            continue
        with lock:
            statuses[answer.status] += 1
            if answer.status not in EXPLAINED:
                unexplained.append((kind, answer.status, answer.body[:200]))
        if answer.status == 429:  # as its Retry-After would have it, but sooner
            time.sleep(chance.uniform(0, 0.5))


def watch_health(server):
    while time.monotonic() < until:
        begin = time.monotonic()
        try:
            good = server.ask("GET", "/healthz", timeout=30).status == 200
        except OSError:
            good = False
        health.append((time.monotonic() - begin, good))
        time.sleep(0.05)


def slope(points):
    """Least squares: what a unit of x adds."""
    n = len(points)
    mean_x, mean_y = sum(x for x, _ in points) / n, sum(y for _, y in points) / n
    down = sum((x - mean_x) ** 2 for x, _ in points)
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / down if down else 0


def main():
    with Server(AWAN, "--software", "--queue", str(QUEUE), "--lanes", str(LANES), "--deadline", "10", "--cache", "16") as server:
        first = server.descriptors()
        threads = [threading.Thread(target=client, args=(server, i)) for i in range(CLIENTS)]
        threads.append(threading.Thread(target=watch_health, args=(server,)))
        begin = time.monotonic()
        for thread in threads:
            thread.start()
        memory, most = [], 0
        while time.monotonic() < until:
            time.sleep(2)
            memory.append(((time.monotonic() - begin) / 60, server.resident_kib() / 1024))
            most = max(most, server.descriptors())
        for thread in threads:
            thread.join()
        time.sleep(8)
        last = server.descriptors()
        metrics = server.ask("GET", "/metrics").body.decode()
        ended = server.stop()
    times = sorted(1000 * took for took, _ in health)
    settled = [point for point in memory if point[0] > MINUTES / 3]
    answers = sum(statuses.values())
    print(f"{MINUTES:g} minutes, {CLIENTS} clients, {answers} answers ({answers / MINUTES / 60:.1f} a second)")
    print("statuses:", dict(sorted(statuses.items())), "connections that broke:", dict(broken))
    print(f"memory: {memory[0][1]:.0f} MiB at first, {settled[0][1]:.0f} after a third, {memory[-1][1]:.0f} at last, at most "
          f"{max(m for _, m in memory):.0f}; slope of the last two thirds {slope(settled):+.2f} MiB a minute")
    print(f"descriptors: {first} at first, {most} at most, {last} after it")
    print(f"/healthz: {len(times)} asked, {sum(not good for _, good in health)} not answered, p50 {times[len(times) // 2]:.1f} ms, "
          f"p99 {times[int(0.99 * len(times))]:.1f} ms, longest {times[-1]:.1f} ms")
    print(f"one scene {sum(digests.values())} times: {len(digests)} different answers")
    print("unexplained:", unexplained[:10], len(unexplained))
    wrong = unexplained or len(digests) > 1 or broken or not all(good for _, good in health) or last > first + 2 or ended != 0 \
        or 'status="500"' in metrics
    print("all well" if not wrong else "NOT WELL")
    return bool(wrong)


sys.exit(main())
