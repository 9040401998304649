"""What it costs that many fetch one large result and do not read it: python3 tests/bench/shared.py build/release/awan [CLIENTS]"""
import os
import socket
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../proofs"))
from serving import SCENE, Server  # noqa: E402

clients = int(sys.argv[2]) if len(sys.argv) > 2 else 40
scene = {**SCENE, "image": {"width": 4096, "height": 2048, "format": "exr", "precision": "float"},
         "accuracy": {"rung": "single"}, "sky": "physical"}
with Server(sys.argv[1]) as server:
    job = server.post("/v1/jobs", {"kind": "render", "scene": scene}).json()
    while server.ask("GET", job["self"]).json()["state"] in ("queued", "running"):
        time.sleep(0.2)
    size = len(server.ask("GET", job["result"]).body)
    before = server.resident_kib()
    crowd = [socket.create_connection(("127.0.0.1", server.port)) for _ in range(clients)]
    for client in crowd:
        client.sendall(f"GET {job['result']} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
    begun = time.monotonic()
    server.ask("GET", "/healthz")
    health = time.monotonic() - begun
    time.sleep(2)
    print(f"{size >> 20} MiB for {clients}: {before >> 10} MiB resident before, {server.resident_kib() >> 10} beside them; "
          f"/healthz after {health:.2f} s")
