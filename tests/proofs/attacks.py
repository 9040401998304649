"""The attack table against the real program, directly and behind nginx.

  attacks.py AWAN [direct | nginx]     direct: only the server; nginx: only behind Debian's nginx (nginx.conf); else both

Of every row: only answers that it allows, what hides in it is never answered nor reaches the server (its log says what did),
none takes long, no answer is 500, and the server is well after it.
"""
import json
import os
import re
import socket
import subprocess
import sys
import tempfile
import threading
import time

import attack_table as table
from serving import SCENE, Checks, Server

AWAN = sys.argv[1]
WAYS = sys.argv[2:] or ["direct", "nginx"]
# Seconds from the last byte sent to the last answer: slow heads are cut after 5.
PATIENCE = 60
# Seconds in which another answer would come, behind a proxy.
SILENCE = 0.3

check = Checks()


def connect(port):
    return socket.create_connection(("127.0.0.1", port), timeout=PATIENCE)


def read_all(connection, silence=None):
    """Everything until the other side closes, or is silent for long; `silence`: so many seconds, once there is an answer."""
    received = b""
    try:
        while True:
            if silence and final_statuses(received):
                connection.settimeout(silence)
            more = connection.recv(1 << 16)
            if not more:
                break
            received += more
    except (ConnectionError, socket.timeout):
        pass
    return received


def statuses(received, bodiless=0):
    """Of the answers in a stream of bytes; the first `bodiless` are to HEAD."""
    found = []
    while received:
        head, blank, rest = received.partition(b"\r\n\r\n")
        match = re.match(rb"HTTP/1\.[01] (\d{3})", head)
        if not match or not blank:
            # What came before is an answer of HTTP/0.9, as nginx gives it to what is no HTTP.
            found.append(int(match.group(1)) if match else 400)
            break
        status = int(match.group(1))
        found.append(status)
        length = re.search(rb"\r\nContent-Length: *(\d+)", head, re.I)
        if status < 200 or status in (204, 304) or len(found) <= bodiless:
            received = rest
        elif length:
            received = rest[int(length.group(1)):]
        elif re.search(rb"\r\nTransfer-Encoding: *chunked", head, re.I):
            while True:
                size, _, rest = rest.partition(b"\r\n")
                count = int(size or b"0", 16)
                rest = rest[count + 2:]
                if count == 0:
                    break
            received = rest
        else:
            break
    return found


def final_statuses(received, bodiless=0):
    """Without interim answers, which clients pass over."""
    return [status for status in statuses(received, bodiless) if status >= 200]


def send(port, data, half_closes=True):
    """What comes back. Who does not close its sending side (a proxy takes that for the end) waits a little for more."""
    with connect(port) as connection:
        failed = threading.Event()

        def write():
            try:
                connection.sendall(data)
                if half_closes:
                    connection.shutdown(socket.SHUT_WR)
            except OSError:
                failed.set()

        # Beside the reading: a refusal may come while there is more to send.
        writer = threading.Thread(target=write)
        writer.start()
        received = read_all(connection, None if half_closes else SILENCE)
        writer.join()
        return received


def allowed(row, way):
    direct = row[2] if isinstance(row[2], set) else {row[2]}
    if way == "direct":
        return direct
    return direct | row[3] if len(row) > 3 else direct | table.PROXY


class Front:
    """Where the attacks go: a server, or nginx in front of it."""

    def __init__(self, way, server):
        self.way, self.server = way, server
        self.port, self.nginx = server.port, None
        if way == "nginx":
            self.folder = tempfile.TemporaryDirectory()
            with socket.socket() as free:
                free.bind(("127.0.0.1", 0))
                self.port = free.getsockname()[1]
            with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "nginx.conf")) as file:
                text = file.read().replace(":8080", f":{server.port}").replace(":8081", f":{self.port}")
            place = os.path.join(self.folder.name, "nginx.conf")
            with open(place, "w") as file:
                file.write(text)
            self.said = tempfile.TemporaryFile()
            program = "/usr/sbin/nginx" if os.path.exists("/usr/sbin/nginx") else "nginx"
            self.nginx = subprocess.Popen([program, "-p", self.folder.name, "-c", place, "-g",
                                           "daemon off; master_process off;"], stderr=self.said)
            until = time.monotonic() + 30
            while not self.well():
                if time.monotonic() > until or self.nginx.poll() is not None:
                    self.said.seek(0)
                    raise SystemExit("nginx did not start: " + self.said.read().decode())
                time.sleep(0.05)

    def send(self, data):
        return send(self.port, data, self.way == "direct")

    def well(self):
        try:
            return self.send(table.get(b"/healthz", b"Connection: close\r\n")).endswith(b"ok\n")
        except OSError:
            return False

    def stop(self):
        if self.nginx:
            self.nginx.terminate()
            self.nginx.wait()


def try_rows(front):
    for row in table.FRAMING + table.CHUNKS + table.LINES + table.HEADERS + table.BODIES:
        name, data = row[:2]
        begin = time.monotonic()
        received = front.send(data)
        took = time.monotonic() - begin
        # A HEAD's refusal has a body where its head was not understood.
        found = statuses(received)
        final = final_statuses(received) or [None]
        fits = allowed(row, front.way)
        # A proxy may take what hides for a request of its own, of the same client: then that is answered too.
        alone = len(final) == 1 or front.way == "nginx" and set(final[1:]) <= {400, 404}
        check.that(alone and final[0] in fits, f"{front.way}: {name}", found, "allowed:", fits, received[:150])
        check.that(500 not in found, f"{front.way}: 500", name)
        check.that(took < PATIENCE / 2, f"{front.way}: takes long", name, f"{took:.1f} s")
        check.that(front.well(), f"{front.way}: the next client is answered", name)


def try_pipelines(front):
    for name, data, expected in table.PIPELINED:
        bodiless = 1 if data.startswith(b"HEAD") else 0
        found = final_statuses(front.send(data), bodiless)
        check.that(found == expected, f"{front.way}: {name}", found)


def try_connections(front):
    """What is not in the bytes but in when they come."""
    way = front.way
    # The head drips: cut after 5 s.
    with connect(front.port) as slow, connect(front.port) as silent:
        begin = time.monotonic()
        slow.settimeout(0.25)
        received, ended = b"", False
        slow.sendall(b"GET /healthz HTTP/1.1\r\n")
        while not ended and time.monotonic() < begin + PATIENCE:
            try:
                slow.sendall(b"X: y\r\n")
                more = slow.recv(4096)
                received, ended = received + more, not more
            except socket.timeout:
                pass
            except ConnectionError:
                ended = True
        took = time.monotonic() - begin
        check.that(ended and took < 20, f"{way}: a head that drips is cut", f"{took:.1f} s")
        check.that(not received or statuses(received)[0] in (408, 400), f"{way}: a head that drips", received[:100])
        silent.settimeout(PATIENCE)
        check.that(statuses(read_all(silent)) in ([], [408]), f"{way}: a silent client is cut")
    # Half closed after a whole request: answered. In the middle of one: not.
    for data, expected in ((table.post(table.SMALL), [[200]] if way == "direct" else [[200], []]),
                           (table.post(table.SMALL)[:-9], [[], [400], [408]]),
                           (table.get(b"/healthz")[:-9], [[], [400], [408]])):
        found = final_statuses(send(front.port, data))
        check.that(found in expected, f"{way}: half closed", found, data[-40:])
    # Reset within a body, and connections that only come and go.
    import struct
    for _ in range(100):
        with connect(front.port) as client:
            client.sendall(table.raw(b"Content-Length: 100000\r\n", b"{" * 1000))
            client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    for _ in range(200):
        connect(front.port).close()
    check.that(front.well(), f"{way}: well after resets")
    # Many that say nothing, many stuck in bodies.
    crowd = [connect(front.port) for _ in range(150)]
    stuck = [connect(front.port) for _ in range(150)]
    for client in stuck:
        client.sendall(table.raw(b"Content-Length: 1000\r\n", b"{"))
    begin = time.monotonic()
    check.that(front.well(), f"{way}: well in a crowd")
    check.that(time.monotonic() - begin < 5, f"{way}: quick in a crowd")
    for client in crowd + stuck:
        client.close()
    # A client that does not read what it asked for.
    with connect(front.port) as client:
        client.sendall(table.get(b"/openapi.json") * 50)
        check.that(front.well(), f"{way}: well beside one that does not read")


def try_results(server):
    """One large result of a job, which a crowd asks for and nobody reads: it stands in memory once."""
    scene = {**SCENE, "image": {"width": 2048, "height": 1024, "format": "exr", "precision": "float"},
             "accuracy": {"rung": "single"}, "sky": "physical"}
    job = server.post("/v1/jobs", {"kind": "render", "scene": scene}).json()
    until = time.monotonic() + 60
    while server.ask("GET", job["self"]).json()["state"] in ("queued", "running") and time.monotonic() < until:
        time.sleep(0.2)
    whole = server.ask("GET", job["self"] + "/result")
    check.that(whole.status == 200 and len(whole.body) > 4 << 20, "a large result", whole.status, len(whole.body))
    before = server.resident_kib()
    crowd = [connect(server.port) for _ in range(40)]
    for client in crowd:
        client.sendall(table.get(job["self"].encode() + b"/result"))
    time.sleep(2)
    grown = server.resident_kib() - before
    check.that(grown < 48 << 10, "a result that many fetch stands in memory once", grown)
    begun = time.monotonic()
    check.that(server.ask("GET", "/healthz").status == 200 and time.monotonic() - begun < 1, "well beside them")
    # Whoever does read it gets it whole.
    crowd[7].settimeout(30)
    got = b""
    while not got.endswith(whole.body[-1000:]):
        more = crowd[7].recv(1 << 20)
        if not more:
            break
        got += more
    check.that(got.partition(b"\r\n\r\n")[2] == whole.body, "a result that is read late is whole", len(got))
    for client in crowd:
        client.close()


def main():
    rows = len(table.FRAMING + table.CHUNKS + table.LINES + table.HEADERS + table.BODIES + table.PIPELINED)
    for way in WAYS:
        with Server(AWAN, "--software", "--log", "json", "--deadline", "6") as server:
            before = server.descriptors()
            front = Front(way, server)
            try:
                try_rows(front)
                try_pipelines(front)
                try_connections(front)
                if way == "direct":
                    try_results(server)
            finally:
                front.stop()
            until = time.monotonic() + 20
            while server.descriptors() > before + 2 and time.monotonic() < until:
                time.sleep(0.2)
            check.that(server.descriptors() <= before + 2, f"{way}: no descriptor is left", before, server.descriptors())
            metrics = server.ask("GET", "/metrics").body.decode()
            check.that('status="500"' not in metrics, f"{way}: no answer was 500")
            check.that(server.stop() == 0, f"{way}: the server stops")
            lines = [json.loads(line) for line in server.said().splitlines() if line.startswith("{")]
            check.that(len(lines) > rows // 2, f"{way}: the log says what came", len(lines))
            # nginx gives every request that it passes on an id of 32 digits: what it took for a part of another has none.
            hidden = [line for line in lines if "hidden" in line["target"] and
                      not (way == "nginx" and re.fullmatch("[0-9a-f]{32}", line["id"]))]
            check.that(not hidden, f"{way}: nothing that hid came through", hidden)
    print(f"{rows} rows, {check.count} checks, {check.failures} failures")
    return check.failures > 0


sys.exit(main())
