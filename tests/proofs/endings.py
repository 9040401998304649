"""Processes that end in the middle, and disks that are full: nothing half is ever taken for whole.

  endings.py AWAN [TRIES [SEED]]     tries a command (default 12)

The command line is killed (SIGKILL) at moments by chance over the whole of its run; then its file is absent or whole, and what
it left beside is gone after the next run. Files are limited (RLIMIT_FSIZE) at sizes from nought to one byte less than
whole: exit code 5, and no file. A server is killed under load: whatever came whole is right, and the next serves.
"""
import json
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time

from serving import JSON, SCENE, Checks, Server

AWAN = sys.argv[1]
TRIES = int(sys.argv[2]) if len(sys.argv) > 2 else 12
chance = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 1)
check = Checks()

MOVING = {"clouds": [{"velocity": [1, 0, 0], "cubes": SCENE["cubes"]}], "sequence": {"from": 0, "to": 2, "frames": 3},
          "image": {"width": 32, "height": 24}, "accuracy": {"rung": "transport-16"}}
STILL = {**SCENE, "image": {"width": 64, "height": 48}, "accuracy": {"rung": "transport-16"}}
MANY = {"cubes": [{**SCENE["cubes"][0], "particles": 20_000}]}
# Name, arguments before the output, output, document.
COMMANDS = [("a picture", ["render"], "a.png", STILL), ("floats", ["render"], "a.exr", STILL),
            ("frames", ["render", "--frames", "0-2"], "f-###.png", MOVING), ("an animation", ["render"], "a.webp", MOVING),
            ("particles", ["particles"], "a.ply", MANY), ("points", ["particles"], "a.glb", MANY)]


def run(folder, arguments, output, limit=None):
    def limited():
        if limit is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    return subprocess.Popen([AWAN, *arguments, "scene.json", "-o", output], cwd=folder, preexec_fn=limited,
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def files(folder):
    found = {}
    for name in os.listdir(folder):
        if name != "scene.json":
            with open(os.path.join(folder, name), "rb") as file:
                found[name] = file.read()
    return found


def empty(folder):
    for name in files(folder):
        os.unlink(os.path.join(folder, name))


def try_command(name, arguments, output, document):
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "scene.json"), "w") as file:
            json.dump(document, file)
        begin = time.monotonic()
        process = run(folder, arguments, output)
        check.that(process.wait() == 0, f"{name} is made", process.stderr.read())
        took = time.monotonic() - begin
        whole = files(folder)
        left = 0
        for i in range(TRIES):
            empty(folder)
            process = run(folder, arguments, output)
            if i % 2:
                time.sleep(chance.uniform(0, 1.1 * took))
            else:  # while it writes
                while process.poll() is None and not any(file.endswith(".tmp") for file in os.listdir(folder)):
                    pass
            process.send_signal(signal.SIGKILL)
            process.wait()
            found = files(folder)
            left += any(file.endswith(".tmp") for file in found)
            check.that(all(whole.get(file) == data for file, data in found.items() if not file.startswith(".awan-")),
                       f"{name}, killed: a file is whole or absent", {file: len(data) for file, data in found.items()})
        process = run(folder, arguments, output)
        check.that(process.wait() == 0, f"{name}, after it was killed", process.stderr.read())
        check.that(files(folder) == whole, f"{name}: what was left is gone", sorted(files(folder)))
        # The disk is full at every length.
        size = max(len(data) for data in whole.values())
        for limit in sorted({0, 1, size - 1, *(chance.randrange(size) for _ in range(4))}):
            empty(folder)
            process = run(folder, arguments, output, limit)
            said = process.stderr.read().decode()
            check.that(process.wait() == 5, f"{name}, a full disk: exit code 5", limit, process.returncode, said)
            check.that(said.count("\n") >= 1, f"{name}, a full disk: it is said", limit)
            check.that(all(whole.get(file) == data for file, data in files(folder).items()),
                       f"{name}, a full disk: no half of a file", limit, sorted(files(folder)))
        print(f"{name}: {took:.2f} s, {left} of {TRIES} kills left a temporary file, {size} bytes")


def try_server():
    """Killed under load, again and again, on one port."""
    with Server(AWAN, "--software", "--queue", "64") as server:
        right = server.post("/v1/render", STILL).body
    for _ in range(max(3, TRIES // 3)):
        with Server(AWAN, "--software", "--queue", "64") as server:
            wrong = []

            def client():
                try:
                    while True:
                        answer = server.ask("POST", "/v1/render", json.dumps(STILL), JSON)
                        if answer.status != 200 or answer.body != right:
                            wrong.append((answer.status, len(answer.body)))
                except Exception:
                    # It is gone; http.client says so of an answer that is not whole, too.
                    pass

            clients = [threading.Thread(target=client) for _ in range(4)]
            for thread in clients:
                thread.start()
            time.sleep(chance.uniform(0, 0.4))
            server.process.send_signal(signal.SIGKILL)
            server.process.wait()
            for thread in clients:
                thread.join()
            check.that(not wrong, "a server that was killed: what came whole is right", wrong[:5])


for command in COMMANDS:
    try_command(*command)
try_server()
print(f"{check.count} checks, {check.failures} failures")
sys.exit(check.failures > 0)
