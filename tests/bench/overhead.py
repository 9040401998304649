import http.client, json, re, statistics, sys, time

ALLOWED_MS = 2

address, requests = sys.argv[1], int(sys.argv[2])
connection = http.client.HTTPConnection(address)

STAGES = ("queue", "generate", "survey", "light", "draw", "encode")


def call(method, path, body=None):
    start = time.perf_counter()
    connection.request(method, path, body, {"Content-Type": "application/json"} if body else {})
    response = connection.getresponse()
    response.read()
    wall = 1000 * (time.perf_counter() - start)
    assert response.status == 200, response.status
    timing = dict(re.findall(r"(\w+);dur=([\d.]+)", response.getheader("Server-Timing") or ""))
    return wall, {name: float(timing.get(name, 0)) for name in STAGES}  # effects are parts of them


def report(name, values):
    values = sorted(values)
    print(f"{name:28} median {statistics.median(values):7.3f} ms   99% {values[int(0.99 * len(values))]:7.3f} ms")
    return statistics.median(values)


scene = json.dumps({"cubes": [{"particles": 200, "size": [7.4, 1.07, 2.9], "center": [0, 0, 0], "radius": 1}],
                    "image": {"width": 64, "height": 48}})
for _ in range(5):
    call("POST", "/v1/render", scene)
renders = [call("POST", "/v1/render", scene) for _ in range(requests)]
report("GET /healthz", [call("GET", "/healthz")[0] for _ in range(requests)])
report("POST /v1/render", [wall for wall, _ in renders])
report("  of it in queue", [stages["queue"] for _, stages in renders])
# Waiting for the render thread to wake is overhead too when nobody else waits.
overhead = report("  overhead", [wall - sum(stages.values()) + stages["queue"] for wall, stages in renders])
sys.exit(overhead > ALLOWED_MS)
