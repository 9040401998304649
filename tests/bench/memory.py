import http.client, json, sys

ALLOWED_MB = 8  # arenas of the allocator, one a thread, that fill up over time

address, renders = sys.argv[1], int(sys.argv[2])
connection = http.client.HTTPConnection(address)


def resident_mb():
    connection.request("GET", "/metrics")
    for line in connection.getresponse().read().decode().splitlines():
        if line.startswith("process_resident_memory_bytes "):
            return int(line.split()[1]) / 2**20


def render(seed):
    scene = {"seed": seed, "image": {"width": 64, "height": 48},
             "cubes": [{"particles": 200, "size": [7.4, 1.07, 2.9], "center": [0, 0, 0], "radius": 1}]}
    connection.request("POST", "/v1/render", json.dumps(scene), {"Content-Type": "application/json"})
    response = connection.getresponse()
    response.read()
    assert response.status == 200, response.status
    if response.getheader("Connection") == "close":
        connection.close()


first = None
for i in range(renders):
    render(i)
    if i + 1 in (10, 100) or (i + 1) % 250 == 0:
        now = resident_mb()
        first = first or now
        print(f"after {i + 1:5} renders: {now:.1f} MB")
growth = now - first
print(f"growth {growth:.1f} MB, allowed {ALLOWED_MB}")
sys.exit(growth > ALLOWED_MB)
