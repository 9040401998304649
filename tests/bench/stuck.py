"""stuck.py HOST:PORT CONNECTIONS SECONDS: keeps so many connections stuck in bodies, and asks for /healthz on connections
of its own meanwhile, one after the other. Fails unless every one is answered, 99% of them within a second."""

import selectors
import socket
import sys
import threading
import time

host, port = sys.argv[1].rsplit(":", 1)
address = (host, int(port))
most, seconds = int(sys.argv[2]), float(sys.argv[3])
HEAD = (b"POST /v1/render HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
        b"Content-Length: 100000\r\n\r\n{")

stop = threading.Event()
opened = closed = 0


def hold():
    """Opens connections until there are `most`, drips a byte now and then, and replaces those that were closed."""
    global opened, closed
    selector = selectors.DefaultSelector()
    stuck = {}

    def begin():
        global opened
        client = socket.socket()
        client.setblocking(False)
        client.connect_ex(address)
        selector.register(client, selectors.EVENT_READ)
        stuck[client] = 0.0
        opened += 1

    while not stop.is_set():
        for _ in range(min(50, most - len(stuck))):
            begin()
        now = time.monotonic()
        for client, last in list(stuck.items()):
            if now - last > 1:
                try:
                    client.send(HEAD if last == 0 else b" ")
                    stuck[client] = now
                except BlockingIOError:
                    pass
                except OSError:
                    pass
        for key, _ in selector.select(0.02):
            try:
                gone = not key.fileobj.recv(4096)
            except OSError:
                gone = True
            if gone:
                selector.unregister(key.fileobj)
                key.fileobj.close()
                del stuck[key.fileobj]
                closed += 1
    for client in stuck:
        client.close()


def healthy():
    start = time.monotonic()
    with socket.create_connection(address, timeout=40) as client:
        client.sendall(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
        answer = b""
        while piece := client.recv(4096):
            answer += piece
    assert answer.startswith(b"HTTP/1.1 200"), answer[:200]
    return time.monotonic() - start


quiet = sorted(healthy() for _ in range(50))
holder = threading.Thread(target=hold)
holder.start()
time.sleep(3)
times = []
until = time.monotonic() + seconds
while time.monotonic() < until:
    times.append(healthy())
    time.sleep(0.01)
stop.set()
holder.join()
times.sort()


def at(share):
    return 1000 * times[min(len(times) - 1, int(share * len(times)))]


print(f"{most} connections stuck in bodies ({opened} opened, {closed} closed by the server), {len(times)} times /healthz: "
      f"median {at(.5):.1f} ms, 99% {at(.99):.1f} ms, most {at(1):.1f} ms (alone: median {1000 * quiet[25]:.1f} ms)")
sys.exit(at(.99) > 1000)
