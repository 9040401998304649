"""large_exr.py HOST:PORT DEADLINE SCENE: asks for a picture; fails when the answer comes over a second after the deadline,
or is neither 200 nor 504."""

import http.client
import json
import sys
import time

deadline = float(sys.argv[2])
client = http.client.HTTPConnection(sys.argv[1], timeout=deadline + 120)
start = time.monotonic()
client.request("POST", "/v1/render", sys.argv[3], {"Content-Type": "application/json"})
answer = client.getresponse()
took = time.monotonic() - start
body = answer.read()
said = f"{len(body) >> 20} MiB, {answer.getheader('Server-Timing')}" if answer.status == 200 else json.loads(body)["detail"]
print(f"deadline {deadline:g} s: {answer.status} after {took:.1f} s; {said}")
sys.exit(not (answer.status in (200, 504) and took < deadline + 1))
