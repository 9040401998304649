"""Attacks as bytes: name, bytes, what a server may answer, and what one behind a proxy may.

Statuses: of all answers that come, in their order; a set is a choice for one answer; None stands for the connection's end
without an answer. `OK` is for what is no attack but looks like one. HIDDEN is a request that hides behind another: it
must never be answered, and never reach the server.
"""
import gzip
import json
import zlib

HOST = b"Host: localhost\r\n"
HIDDEN = b"GET /hidden HTTP/1.1\r\nHost: localhost\r\n\r\n"
SMALL = b'{"cubes":[{"particles":5,"size":[1,1,1],"center":[0,0,0],"radius":0.5}]}'
# A proxy may refuse by itself, or make it harmless: then the server answers what is left of it.
PROXY = {200, 400, 403, 404, 405, 408, 411, 413, 414, 415, 421, 422, 431, 494, 501, 505, None}


def get(target, more=b"", version=b"HTTP/1.1"):
    return b"GET " + target + b" " + version + b"\r\n" + HOST + more + b"\r\n"


def raw(more, body=b"", host=HOST):
    return b"POST /v1/plan HTTP/1.1\r\n" + host + b"Content-Type: application/json\r\n" + more + b"\r\n" + body


def post(body, kind=b"application/json", more=b"", path=b"/v1/plan"):
    return (b"POST " + path + b" HTTP/1.1\r\n" + HOST + b"Content-Type: " + kind + b"\r\nContent-Length: " +
            str(len(body)).encode() + b"\r\n" + more + b"\r\n" + body)


def put(name, body):
    return b"PUT /v1/textures/" + name + b" HTTP/1.1\r\n" + HOST + b"Content-Length: %d\r\n\r\n" % len(body) + body


def length(value, body=b"{}"):
    return raw(b"Content-Length: " + value + b"\r\n", body + HIDDEN)


def chunked(body, name=b"Transfer-Encoding: chunked\r\n"):
    return raw(name, body)


def bomb(megabytes):
    packer, out = zlib.compressobj(9, zlib.DEFLATED, 31), b""
    for _ in range(megabytes):
        out += packer.compress(bytes(1 << 20))
    return out + packer.flush()


def part(name, value, more=b""):
    return b'--b\r\nContent-Disposition: form-data; name="' + name + b'"\r\n' + more + b"\r\n" + value + b"\r\n"


FORM = b"multipart/form-data; boundary=b"
PACKED = b"Content-Encoding: gzip\r\n"
WHOLE = b"%x\r\n" % len(SMALL) + SMALL + b"\r\n0\r\n\r\n"
END = b"0\r\n\r\n"

FRAMING = [
    # Two lengths that two parsers may read differently.
    ("CL.TE", raw(b"Content-Length: 6\r\nTransfer-Encoding: chunked\r\n", END + HIDDEN), 400),
    ("TE.CL", raw(b"Transfer-Encoding: chunked\r\nContent-Length: 4\r\n", b"5c\r\n" + HIDDEN + END), 400),
    ("TE.TE", raw(b"Transfer-Encoding: chunked\r\nTransfer-Encoding: x\r\n", END + HIDDEN), 400),
    ("TE chunked, identity", chunked(END + HIDDEN, b"Transfer-Encoding: chunked, identity\r\n"), 400),
    ("TE identity", raw(b"Transfer-Encoding: identity\r\nContent-Length: 2\r\n", b"{}" + HIDDEN), 400),
    ("TE gzip, chunked", chunked(END + HIDDEN, b"Transfer-Encoding: gzip, chunked\r\n"), 400),
    ("TE xchunked", chunked(END + HIDDEN, b"Transfer-Encoding: xchunked\r\n"), 400),
    ("TE in quotes", chunked(END + HIDDEN, b'Transfer-Encoding: "chunked"\r\n'), 400),
    ("TE behind a vertical tab", chunked(END + HIDDEN, b"Transfer-Encoding: \x0bchunked\r\n"), 400),
    ("TE with a blank before its colon", chunked(END + HIDDEN, b"Transfer-Encoding : chunked\r\n"), 400),
    ("TE folded", chunked(END + HIDDEN, b"Transfer-Encoding:\r\n chunked\r\n"), 400),
    ("TE behind a folded line", chunked(END + HIDDEN, b"X: y\r\n Transfer-Encoding: chunked\r\n"), 400),
    ("TE behind a bare CR", chunked(END + HIDDEN, b"X: y\rTransfer-Encoding: chunked\r\n"), 400),
    ("TE behind a bare LF", chunked(END + HIDDEN, b"X: y\nTransfer-Encoding: chunked\r\n"), 400),
    ("TE behind a NUL", chunked(END + HIDDEN, b"X: \0\r\nTransfer-Encoding: chunked\r\n"), 400),
    ("TE with an underscore", raw(b"Transfer_Encoding: chunked\r\nContent-Length: 2\r\n", b"{}"), 422),
    ("TE in HTTP/1.0", b"POST /v1/plan HTTP/1.0\r\nTransfer-Encoding: chunked\r\n\r\n" + END + HIDDEN, 400),
    ("two lengths", raw(b"Content-Length: 2\r\nContent-Length: 40\r\n", b"{}" + HIDDEN), 400),
    ("the same length twice", raw(b"Content-Length: 2\r\nContent-Length: 2\r\n", b"{}" + HIDDEN), 400),
    ("a length with an underscore", raw(b"Content_Length: 40\r\nContent-Length: 2\r\n", b"{}"), 422),
    ("a list of lengths", length(b"2, 2"), 400),
    ("a length with a plus", length(b"+2"), 400),
    ("a negative length", length(b"-2"), 400),
    ("a hexadecimal length", length(b"0x2"), 400),
    ("a length with an exponent", length(b"2e0"), 400),
    ("a fractional length", length(b"2.0"), 400),
    ("a length with a blank in it", length(b"2 0"), 400),
    ("a length in other digits", length("٢".encode()), 400),
    ("no length's value", length(b""), 400),
    ("a length in quotes", length(b'"2"'), 400),
    ("a length over 2^64", length(b"18446744073709551618"), 413),
    ("a length over 2^63", length(b"9223372036854775809"), 413),
    ("a length over all limits", length(b"100663297"), 413),
    ("a length with a NUL", length(b"2\x00"), 400),
    ("leading noughts", raw(b"Content-Length: 0002\r\n", b"{}"), 422),
    ("no length", raw(b"", HIDDEN), 411),
    ("a PUT of no length", b"PUT /v1/textures/a HTTP/1.1\r\n" + HOST + b"\r\n" + HIDDEN, 411),
    ("a body of GET", get(b"/healthz", b"Content-Length: %d\r\n" % len(HIDDEN)) + HIDDEN, 400),
    ("a chunked GET", get(b"/healthz", b"Transfer-Encoding: chunked\r\n") + END + HIDDEN, {400, 411}),
    ("a body of HEAD", b"HEAD /healthz HTTP/1.1\r\n" + HOST + b"Content-Length: 2\r\n\r\n{}" + HIDDEN, 400),
    ("a body of OPTIONS", b"OPTIONS /v1/plan HTTP/1.1\r\n" + HOST + b"Content-Length: 2\r\n\r\n{}" + HIDDEN, 400),
    # Lines.
    ("LF for CRLF", (get(b"/healthz") + HIDDEN).replace(b"\r\n", b"\n"), 400),
    ("CR for CRLF", (get(b"/healthz")).replace(b"\r\n", b"\r"), 400),
    ("CR CR LF", get(b"/healthz", b"X: y\r\r\n") + HIDDEN, 400),
    ("LF CR", b"GET /healthz HTTP/1.1\r\n" + HOST + b"\n\r" + HIDDEN, 400),
    ("an empty line first", b"\r\n" + get(b"/healthz") + HIDDEN, 400),
    ("a blank before the first header", b"GET /healthz HTTP/1.1\r\n X: y\r\n" + HOST + b"\r\n" + HIDDEN, 400),
    ("a header without a colon", get(b"/healthz", b"nonsense\r\n") + HIDDEN, 400),
    ("a header without a name", get(b"/healthz", b": x\r\n") + HIDDEN, 400),
    ("a blank in a name", get(b"/healthz", b"X Y: z\r\n") + HIDDEN, 400),
    ("a tab behind a name", get(b"/healthz", b"X\t: z\r\n") + HIDDEN, 400),
    ("a NUL in a name", get(b"/healthz", b"X\0: z\r\n") + HIDDEN, 400),
    ("a byte over 127 in a name", get(b"/healthz", b"X\xff: z\r\n") + HIDDEN, 400),
    ("a bell in a value", get(b"/healthz", b"X: \x07\r\n") + HIDDEN, 400),
]

CHUNKS = [
    # Not taken by the server; a proxy puts them together, or refuses what is wrong.
    ("chunks", chunked(WHOLE), 411, {200}),
    ("chunks with extensions", chunked(WHOLE.replace(b"\r\n", b";a=b\r\n", 1)), 411, {200, 400}),
    ("chunks with trailers", chunked(WHOLE[:-2] + b"Content-Length: 9\r\nX: y\r\n\r\n"), 411, {200, 400}),
    ("a chunk of 0x", chunked(b"0x2\r\n{}\r\n" + END + HIDDEN), 411, {400}),
    ("a negative chunk", chunked(b"-2\r\n{}\r\n" + END + HIDDEN), 411, {400}),
    ("a chunk over 2^64", chunked(b"10000000000000002\r\n{}\r\n" + END + HIDDEN), 411, {400, 413}),
    ("a chunk without its end", chunked(b"2\r\n{}" + END + HIDDEN), 411, {400}),
    ("chunks with LF", chunked(b"2\n{}\n0\n\n"), 411, {200, 400, 422}),
    ("a chunk that is short", chunked(b"9\r\n{}\r\n" + END), 411, {400, 408, None}),
    ("no last chunk", chunked(b"2\r\n{}\r\n"), 411, {400, 408, None}),
    ("a blank before a chunk", chunked(b" 2\r\n{}\r\n" + END + HIDDEN), 411, {400}),
    ("words for a chunk", chunked(b"two\r\n{}\r\n" + END + HIDDEN), 411, {400}),
]

LINES = [
    ("HTTP/0.9", b"GET /healthz\r\n\r\n", 400),
    ("HTTP/1.2", get(b"/healthz", version=b"HTTP/1.2"), 400, {200, 400, 505}),
    ("HTTP/2.0", get(b"/healthz", version=b"HTTP/2.0"), 400),
    ("HTTP/1.10", get(b"/healthz", version=b"HTTP/1.10"), 400),
    ("HTTP/11", get(b"/healthz", version=b"HTTP/11"), 400),
    ("http/1.1", get(b"/healthz", version=b"http/1.1"), 400),
    ("no version", get(b"/healthz", version=b""), 400),
    ("the preface of HTTP/2", b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", 400),
    ("TLS", b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 400),
    ("a line of SMTP", b"EHLO example.org\r\n\r\n", 400),
    ("noise", bytes(range(128, 256)) * 8, 400),
    ("NULs", bytes(4096), 400),
    ("a tab for a blank", b"GET\t/healthz\tHTTP/1.1\r\n" + HOST + b"\r\n", 400),
    ("two blanks", get(b" /healthz"), 400),
    ("a blank in the target", get(b"/heal thz"), 400),
    ("a method of no kind", b"BREW /healthz HTTP/1.1\r\n" + HOST + b"\r\n", 501, {501, 400, 405}),
    ("a method in small letters", b"get /healthz HTTP/1.1\r\n" + HOST + b"\r\n", 501, {501, 400, 405}),
    ("a method with a NUL", b"GE\0T /healthz HTTP/1.1\r\n" + HOST + b"\r\n", 400),
    ("a method of 10,000 letters", b"G" * 10_000 + b" / HTTP/1.1\r\n" + HOST + b"\r\n", {400, 501}),
    ("TRACE", b"TRACE /healthz HTTP/1.1\r\n" + HOST + b"Authorization: Bearer secret\r\n\r\n", 405),
    ("CONNECT", b"CONNECT example.org:443 HTTP/1.1\r\nHost: example.org:443\r\n\r\n", 501, {400, 405, 501}),
    ("an absolute target", get(b"http://localhost/healthz"), 200),
    ("an absolute target elsewhere", get(b"http://evil.example/healthz"), 400, {200, 400, 421}),
    ("an absolute target without a host", get(b"http:///healthz"), 400),
    ("an absolute target with a user", get(b"http://localhost@evil.example/healthz"), 400),
    ("another scheme", get(b"ftp://localhost/healthz"), 400),
    ("a target of *", get(b"*"), 400),
    ("a target without /", get(b"healthz"), 400),
    ("a fragment", get(b"/healthz#x"), 400, {200, 400}),
    ("a raw byte", get(b"/\xff"), 400, {400, 404}),
    ("a NUL in the target", get(b"/healthz\0"), 400),
    ("a control in the target", get(b"/\x1b[2J"), 400, {400, 404}),
    ("an encoded NUL", get(b"/healthz%00"), 404, {400, 404}),
    ("an encoded line break", get(b"/%0d%0aX:%20y"), 404),
    ("a line break in the query", get(b"/healthz?%0d%0aX:%20y"), {200, 400}),
    ("half a percent", get(b"/healthz%"), {400, 404}),
    ("percent of no hexadecimal", get(b"/%zz"), {400, 404}),
    ("up", get(b"/../../etc/passwd"), 404, {400, 404}),
    ("up, encoded", get(b"/%2e%2e/%2e%2e/etc/passwd"), 404, {400, 404}),
    ("up, encoded twice", get(b"/%252e%252e/etc/passwd"), 404, {400, 404}),
    ("up, a slash encoded", get(b"/..%2f..%2fetc%2fpasswd"), 404, {400, 404}),
    ("up, with backslashes", get(b"/..\\..\\etc\\passwd"), 404, {400, 404}),
    ("up, too long an encoding", get(b"/%c0%ae%c0%ae/etc/passwd"), 404, {400, 404}),
    ("up below a route", get(b"/v1/presets/../../etc/passwd"), 404, {400, 404}),
    ("up below a preset", get(b"/v1/presets/..%2f..%2fopenapi.json"), 404, {400, 404}),
    ("a file's scheme", get(b"/file:///etc/passwd"), 404, {400, 404}),
    ("two slashes", get(b"//healthz"), 404, {200, 404}),
    ("parameters of a path", get(b"/healthz;x=y"), 404),
    ("a long target", get(b"/" + b"a" * 3000), 414, {404, 414}),
    ("an endless target", b"GET /" + b"a" * 70_000, 414),
    ("10,000 parameters", get(b"/healthz?" + b"a&" * 1000), {200, 400}),
]

HEADERS = [
    ("no Host", b"GET /healthz HTTP/1.1\r\n\r\n", 400),
    ("two Hosts", get(b"/healthz", b"Host: localhost\r\n"), 400),
    ("an empty Host", b"GET /healthz HTTP/1.1\r\nHost:\r\n\r\n", {400, 421}),
    ("another Host", b"GET /healthz HTTP/1.1\r\nHost: evil.example\r\n\r\n", 421),
    ("a Host that begins as ours", b"GET /healthz HTTP/1.1\r\nHost: localhost.evil.example\r\n\r\n", 421),
    ("a Host with a path", b"GET /healthz HTTP/1.1\r\nHost: localhost/x\r\n\r\n", 400, {400, 421}),
    ("a Host with a user", b"GET /healthz HTTP/1.1\r\nHost: localhost@evil.example\r\n\r\n", 400, {400, 421}),
    ("a Host with a blank", b"GET /healthz HTTP/1.1\r\nHost: localhost evil\r\n\r\n", 400),
    ("a Host with half a bracket", b"GET /healthz HTTP/1.1\r\nHost: [::1\r\n\r\n", {400, 421}),
    ("a port of words", b"GET /healthz HTTP/1.1\r\nHost: localhost:eighty\r\n\r\n", {200, 400, 421}),
    ("X-Forwarded-Host", get(b"/healthz", b"X-Forwarded-Host: evil.example\r\n"), 200),
    ("another page's Origin", post(b"{}", more=b"Origin: http://evil.example\r\n"), 403),
    ("no page's Origin", post(b"{}", more=b"Origin: null\r\n"), 403),
    ("102 headers", get(b"/healthz", b"".join(b"X-%d: y\r\n" % i for i in range(102))), 431, {200, 400, 431, 494}),
    ("a long header", get(b"/healthz", b"X: " + b"y" * 20_000 + b"\r\n"), 431, {400, 431, 494}),
    ("a long name", get(b"/healthz", b"X" * 20_000 + b": y\r\n"), 431, {400, 431, 494}),
    ("endless headers", b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 20_000, 431, {400, 431, 494}),
    ("cookies", get(b"/healthz", b"Cookie: " + b"a=b; " * 2000 + b"\r\n"), 200),
    ("Range", get(b"/v1/presets", b"Range: bytes=0-0,2-2,-1\r\n"), 200),
    ("Range, a thousand", get(b"/v1/presets", b"Range: bytes=" + b"0-1," * 1000 + b"2-3\r\n"), 200, {200, 416}),
    ("Range of no unit", get(b"/v1/presets", b"Range: parsecs=12-\r\n"), 200),
    ("Expect of no kind", post(b"{}", more=b"Expect: 100-miracles\r\n"), 417, {417, 422}),
    ("Expect", post(SMALL, more=b"Expect: 100-continue\r\n"), {100, 200}, {100, 200}),
    ("Expect of what is not wanted", b"POST /no HTTP/1.1\r\n" + HOST +
     b"Expect: 100-continue\r\nContent-Length: 99999999\r\n\r\n", 404, {100, 404, None}),
    ("Upgrade to HTTP/2", get(b"/healthz", b"Connection: Upgrade, HTTP2-Settings\r\nUpgrade: h2c\r\n"
                              b"HTTP2-Settings: AAMAAABkAARAAAAAAAIAAAAA\r\n"), 200),
    ("Upgrade to a web socket", get(b"/healthz", b"Connection: Upgrade\r\nUpgrade: websocket\r\n"), 200),
    ("Connection names the length", raw(b"Connection: Content-Length\r\nContent-Length: 2\r\n", b"{}"), 422, {422, 411}),
    ("Connection names the host", get(b"/healthz", b"Connection: close, Host\r\n"), 200),
    ("TE: trailers", get(b"/healthz", b"TE: trailers, deflate\r\n"), 200),
    ("a request id that breaks lines", get(b"/healthz", b"X-Request-Id: a%0d%0aX: y\r\n"), 200),
    ("a request id of script", get(b"/healthz", b"X-Request-Id: <script>\r\n"), 200),
    ("tags, a thousand", get(b"/v1/presets", b'If-None-Match: ' + b'"a", ' * 1000 + b'"b"\r\n'), 200),
    ("a tag without its end", get(b"/v1/presets", b'If-None-Match: "abc\r\n'), 200),
    ("types, a thousand", post(SMALL, more=b"Accept: " + b"a/b;q=.1," * 1000 + b"*/*\r\n"), 200),
    ("a quality of no number", post(SMALL, more=b"Accept: application/json;q=nan\r\n"), {200, 406}),
    ("packed twice", post(b"{}", more=b"Content-Encoding: gzip\r\nContent-Encoding: gzip\r\n"), 415),
    ("packed by others", post(b"{}", more=b"Content-Encoding: zstd\r\n"), 415),
]

BODIES = [
    ("deep lists", post(b"[" * 1_000_000), {400, 422}),
    ("deep objects that nobody reads", post(b'{"_":' * 100_000 + b"1" + b"}" * 100_000), {400, 422}),
    ("a number without end", post(b'{"seed":' + b"9" * 1_000_000 + b"}"), {400, 422}),
    ("1e999999999", post(b'{"time":1e999999999,"cubes":[]}'), {400, 422}),
    ("nought with a million digits", post(b'{"time":0.' + b"0" * 1_000_000 + b'1,"cubes":[]}'), {200, 422}),
    ("NaN", post(b'{"time":NaN,"cubes":[]}'), 400),
    ("a million keys", post(b"{" + b'"_":1,' * 300_000 + b'"cubes":[]}'), {200, 422}),
    ("a key twice", post(b'{"cubes":[],"cubes":[]}'), 422),
    ("a long key", post(b'{"' + b"k" * 1_000_000 + b'":1}'), {400, 422}),
    ("__proto__", post(b'{"__proto__":{"x":1},"cubes":[]}'), {200, 422}),
    ("a key's line break", post(b'{"a\\r\\nX: y":1}'), 422),
    ("half a letter", post(b'{"cubes":[],"_":"\xc3"}'), {200, 400}),
    ("half a pair", post(b'{"cubes":[],"_":"\\ud800"}'), {200, 400}),
    ("a NUL behind it", post(SMALL + b"\0" + HIDDEN), 400),
    ("another behind it", post(SMALL + SMALL), 400),
    ("nothing", post(b""), 400),
    ("blanks", post(b" " * 1_000_000), 400),
    ("a gzip bomb", post(bomb(200), more=PACKED), 413),
    ("gzip in gzip", post(gzip.compress(gzip.compress(SMALL)), more=PACKED), 400),
    ("gzip without its end", post(gzip.compress(SMALL)[:-6], more=PACKED), 400),
    ("no gzip", post(SMALL, more=PACKED), 400),
    ("no gzip at all", post(b"", more=PACKED), 400),
    ("gzip with a wrong sum", post(gzip.compress(SMALL)[:-8] + bytes(8), more=PACKED), 400),
    ("gzip of 10,000 members", post(gzip.compress(b" ") * 10_000 + gzip.compress(SMALL), more=PACKED), 200),
    ("a form of 100,000 parts", post(part(b"width", b"1") * 100_000 + b"--b--", FORM), 400),
    ("a form without its end", post(part(b"scene", SMALL), FORM), 400),
    ("a form without a boundary", post(b"--b--", b"multipart/form-data"), 400),
    ("a boundary of 1,000 letters", post(b"--b--", b"multipart/form-data; boundary=" + b"b" * 1000), 400),
    ("a part of headers", post(part(b"scene", SMALL, b"X: y\r\n" * 100_000) + b"--b--", FORM), {200, 400}),
    ("a part without a name", post(b"--b\r\n\r\n" + SMALL + b"\r\n--b--", FORM), 400),
    ("a form in a form", post(part(b"scene", part(b"scene", SMALL) + b"--b--") + b"--b--", FORM), 400),
    ("two scenes in a form", post(part(b"scene", SMALL) * 2 + b"--b--", FORM), 400),
    ("a file's name that goes up", post(part(b"scene", SMALL, b"").replace(b'"scene"', b'"scene"; filename="../../x"')
                                        + b"--b--", FORM), 200),
    ("100,000 fields", post(b"width=1&" * 100_000, b"application/x-www-form-urlencoded"), 400),
    ("fields of percents", post(b"scene=" + b"%" * 100_000, b"application/x-www-form-urlencoded"), {400, 422}),
    ("an XML bomb", post(b'<!DOCTYPE x [<!ENTITY a "b">]><x>&a;</x>', b"application/xml"), 415),
    ("YAML", post(b"a: &a [*a]", b"application/yaml"), 415),
    ("JSON in UTF-7", post(b"{}", b"application/json; charset=utf-7"), 415),
    ("one long line of CSV", post(b"x,y,z,radius" + b",a" * 500_000 + b"\n", b"text/csv"), {200, 400, 422}),
    ("a quote of CSV without its end", post(b'x,y,z,radius\n"' + b"1\n" * 100_000, b"text/csv"), 400),
    ("a formula of CSV", post(b"x,y,z,radius\n=cmd|'/c calc'!A1,1,1,1\n", b"text/csv"), 400),
    ("PLY of 4,000,000,000", post(b"ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
                                  b"property float y\nproperty float z\nproperty float radius\nend_header\n" + bytes(64),
                                  b"application/x-ply"), {400, 413}),
    ("a list of PLY without end", post(b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty list uint double x\n"
                                       b"end_header\n\xff\xff\xff\xff", b"application/x-ply"), 400),
    ("a header of PLY without end", post(b"ply\nformat ascii 1.0\n" + b"comment x\n" * 100_000, b"application/x-ply"), 400),
    ("a layout of 10^18", post(b"1000000000000000000\n1\n1000000000000000000 1 1 1 0 0 0 1\n", b"text/x-awn"), {400, 413, 422}),
    ("a layout of as many lines", post(b"1\n1000000000\n", b"text/x-awn"), {400, 413, 422}),
    ("a picture of 16 GiB in 42 bytes", put(b"bomb", b"GIF89a\xff\xff\xff\xff\x80\0\0\0\0\0\xff\xff\xff"
                                            b",\0\0\0\0\1\0\1\0\0\2\2\x44\1\0;"), {413, 422}),
    ("a texture that goes up", put(b"..%2f..%2fx", b"x"), {400, 404, 422}, {400, 404, 422}),
    ("more work than a day's", post(json.dumps({
        "cubes": [{"particles": 4_000_000, "size": [9, 9, 9], "center": [0, 0, 0], "radius": 0.1}],
        "image": {"width": 8192, "height": 4096}, "accuracy": {"rung": "truth"}}).encode(), path=b"/v1/render"),
     {422, 429, 503, 504}, {422, 429, 503, 504}),
]

# Answered, each in its turn.
PIPELINED = [
    ("a hundred in one packet", get(b"/healthz") * 100, [200] * 100),
    ("a wrong one in the middle", get(b"/healthz") * 3 + get(b"healthz") + HIDDEN, [200, 200, 200, 400]),
    ("reading behind computing", post(SMALL) + get(b"/healthz"), [200, 200]),
    ("one that closes", get(b"/healthz", b"Connection: close\r\n") + HIDDEN, [200]),
    ("HTTP/1.0 closes", get(b"/healthz", version=b"HTTP/1.0") + HIDDEN, [200]),
    ("HEAD has no body", b"HEAD /v1/presets HTTP/1.1\r\n" + HOST + b"\r\n" + get(b"/healthz"), [200, 200]),
    ("an error is read over", post(b"{") + get(b"/healthz"), [400, 200]),
]
