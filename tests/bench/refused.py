"""Does the server keep memory of what it refused? A document of 59 MB, refused with 422, again and again.
   python3 tests/bench/refused.py build/release/awan [TIMES]"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../proofs"))
from serving import JSON, Server  # noqa: E402

times = int(sys.argv[2]) if len(sys.argv) > 2 else 100
one = b'{"kind":"sphere","center":[1.25,2.5,-3.75],"radius":1.5,"blend":0.25}'
body = b'{"clouds":[{"model":"implicit","implicit":{"primitives":[' + b",".join([one] * (59_000_000 // (len(one) + 1))) + b"]}}]}"
with Server(sys.argv[1]) as server:
    before, statuses = server.resident_kib(), {}
    for i in range(times):
        status = server.ask("POST", "/v1/plan", body, JSON).status
        statuses[status] = statuses.get(status, 0) + 1
        if i in (0, times // 10, times // 3, times - 1):
            print("%d MB, %d times: %s; %d MiB resident, %d before" % (
                len(body) // 1_000_000, i + 1, statuses, server.resident_kib() >> 10, before >> 10), flush=True)
