"""A server of the built program on a free port, for the proofs."""
import http.client
import json
import re
import subprocess
import tempfile
import time

JSON = {"Content-Type": "application/json"}
SCENE = {"cubes": [{"particles": 20, "size": [2, 1, 2], "center": [0, 0, 0], "radius": 0.5}],
         "density": 0.2, "detail": "none", "image": {"width": 16, "height": 8}, "accuracy": {"rung": "harris"}}


class Answer:
    def __init__(self, status, headers, body):
        self.status, self.body = status, body
        self.headers = {name.lower(): value for name, value in headers}

    @property
    def type(self):
        return self.headers.get("content-type", "").split(";")[0]

    def json(self):
        return json.loads(self.body)


class Server:
    """Starts `awan serve` and waits until it is ready; ends it as a `with` block ends."""

    def __init__(self, awan, *flags):
        self.log = tempfile.TemporaryFile()
        self.process = subprocess.Popen([awan, "serve", "--listen", "127.0.0.1:0", *flags], stderr=self.log)
        until = time.monotonic() + 60
        self.port = 0
        while not self.ready():
            if self.process.poll() is not None or time.monotonic() > until:
                self.process.kill()
                raise SystemExit("the server did not start: " + self.said())
            time.sleep(0.05)

    def said(self):
        self.log.seek(0)
        return self.log.read().decode(errors="replace")

    def ready(self):
        found = re.search(r"listening on http://[^:]*:(\d+)/", self.said())
        if not found:
            return False
        self.port = int(found.group(1))
        try:
            return self.ask("GET", "/readyz").status == 200
        except OSError:
            return False

    def ask(self, method, path, body=None, headers=None, timeout=120):
        """One request on a connection of its own."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        try:
            connection.request(method, path, body, headers or {})
            answer = connection.getresponse()
            return Answer(answer.status, answer.getheaders(), answer.read())
        finally:
            connection.close()

    def post(self, path, document, headers=None):
        return self.ask("POST", path, json.dumps(document).encode(), {**JSON, **(headers or {})})

    def descriptors(self):
        import os
        return len(os.listdir(f"/proc/{self.process.pid}/fd"))

    def resident_kib(self):
        with open(f"/proc/{self.process.pid}/status") as status:
            return int(re.search(r"VmRSS:\s+(\d+)", status.read()).group(1))

    def stop(self):
        self.process.terminate()
        return self.process.wait(60)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()


class Checks:
    """Counts what was looked at, and says what failed, each thing a few times only."""

    def __init__(self):
        self.count, self.failures, self.said = 0, 0, {}

    def that(self, holds, what, *details):
        self.count += 1
        if holds:
            return True
        self.failures += 1
        self.said[what] = self.said.get(what, 0) + 1
        if self.said[what] <= 5:
            print("FAILED:", what, *details)
        return False
