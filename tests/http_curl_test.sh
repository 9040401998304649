#!/usr/bin/env bash
# The built program as a stranger uses it: real curl against a real server. $1: the binary.
set -uo pipefail
awan=$1
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
. "$root/tests/shell_checks.sh"
. "$root/tests/shell_server.sh"

json='Content-Type: application/json'
scene='{"cubes":[{"particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],"image":{"width":64,"height":48},"accuracy":{"rung":"harris"}}'

start --software

# --- reading
same "health" "ok" "$(curl -s "$url/healthz")"
same "health by HEAD" 200 "$(code -I "$url/healthz")"
contains "version" '"name":"awan"' "$(curl -s "$url/version")"
contains "metrics" 'awan_ready 1' "$(curl -s "$url/metrics")"
contains "page" '<html' "$(curl -s "$url/")"
same "unknown path" 404 "$(code "$url/v1/nowhere")"
same "wrong method" 405 "$(code -X DELETE "$url/healthz")"
same "wrong method without a body" 405 "$(code -X PATCH "$url/v1/render")"
same "a method that has a body, without its length" 411 "$(code -X PUT "$url/v1/render")"
contains "Allow" 'Allow: POST, OPTIONS' "$(curl -si "$url/v1/render")"
same "path as it is" 404 "$(code --path-as-is "$url/../../etc/passwd")"
contains "echoed id" 'X-Request-Id: curl-7' "$(curl -si -H 'X-Request-Id: curl-7' "$url/healthz")"

# The contract: valid references, and every path in it is there.
curl -s "$url/openapi.json" >"$work/openapi.json"
python3 - "$work/openapi.json" "$url" <<'PYTHON' || fail "the contract"
import json, sys, urllib.request, urllib.error
document = json.load(open(sys.argv[1]))
def refs(node):
    if isinstance(node, dict):
        if "$ref" in node: yield node["$ref"]
        for value in node.values(): yield from refs(value)
    elif isinstance(node, list):
        for value in node: yield from refs(value)
for ref in refs(document):
    node = document
    for part in ref.removeprefix("#/").split("/"): node = node[part]
def job():
    scene = b'{"kind": "render", "scene": {"cubes": [], "image": {"width": 8, "height": 8}}}'
    made = json.load(urllib.request.urlopen(urllib.request.Request(sys.argv[2] + "/v1/jobs", data=scene,
        headers={"Content-Type": "application/json"})))
    with urllib.request.urlopen(sys.argv[2] + made["events"]) as events: events.read()
    return made["id"]
bodies = {"post": b"{}", "put": b"P5 2 2 255\n" + bytes([0, 80, 160, 255])}
for path, methods in document["paths"].items():
    name = "mine" if "textures" in path else "cumulus"
    for method in sorted(set(methods) - {"parameters"}, key=["put", "get", "post", "delete"].index):
        named = path.replace("{name}", name).replace("{id}", job() if "{id}" in path else "")
        request = urllib.request.Request(sys.argv[2] + named, method=method.upper(),
            data=bodies.get(method), headers={"Content-Type": "application/json"})
        try: status = urllib.request.urlopen(request).status
        except urllib.error.HTTPError as error: status = error.code
        assert status == {"post": 422, "put": 201, "delete": 204}.get(method, 200), (path, method, status)
        assert str(status) in methods[method]["responses"], (path, method, status)
PYTHON

# --- posting
for preset in $(curl -s "$url/v1/presets" | grep -o '/v1/presets/[a-z0-9-]*'); do
    curl -s "$url$preset" >"$work/preset.json"
    same "plan of $preset" 200 "$(code -H "$json" --data-binary @"$work/preset.json" "$url/v1/plan")"
done
curl -s -D "$work/head" -H "$json" -d "$scene" "$url/v1/render" -o "$work/a.png"
same "PNG" "$(printf '\211PNG')" "$(head -c 4 "$work/a.png")"
contains "timing" 'Server-Timing: queue;dur=' "$(cat "$work/head")"
tag=$(tr -d '\r' <"$work/head" | sed -n 's/^ETag: //p')
same "not modified" 304 "$(code -H "$json" -H "If-None-Match: $tag" -d "$scene" "$url/v1/render")"
curl -s -H "$json" -H 'Accept: image/x-exr' -d "$scene" "$url/v1/render" -o "$work/a.exr"
same "EXR" "762f3101" "$(head -c 4 "$work/a.exr" | od -An -tx1 | tr -d ' ')"
contains "EXR channels" "R, G, B, A" "$(oiiotool --info -v "$work/a.exr" 2>&1)"
curl -s -H "$json" -d "$scene" "$url/v1/particles" | python3 -c '
import json, sys
answer = json.load(sys.stdin)
assert answer["count"] == 60 == len(answer["particles"])' || fail "particles as JSON"
same "lines of CSV" 61 "$(curl -s -H "$json" -H 'Accept: text/csv' -d "$scene" "$url/v1/particles" | wc -l)"
curl -s -H "$json" -H 'Accept: text/x-awn' -d "$scene" "$url/v1/particles" >"$work/a.awn"
same "a layout" 200 "$(code -H 'Content-Type: text/x-awn' --data-binary @"$work/a.awn" "$url/v1/plan")"
contains "what is stated" 'Awan-Error: ' "$(cat "$work/head")"
contains "what was expected" 'Awan-Error-Forecast: ' "$(cat "$work/head")"
curl -s -D "$work/head" -H "$json" -d "$scene" "$url/v1/accuracy?samples=16&size=16&runs=2" | python3 -c '
import json, sys
answer = json.load(sys.stdin)
assert answer["reference"]["width"] == 16, answer
times = [rung["time_ms"] for rung in answer["rungs"]]
left_out = answer["left_out"]  # on a busy machine, for want of time
assert times and times == sorted(times) and len(times) + len(left_out) == 8, answer
assert all("were left" in rung["reason"] for rung in left_out), answer' || fail "accuracy as JSON"
contains "accuracy is not kept" 'Cache-Control: no-store' "$(cat "$work/head")"
curl -s -H "$json" -H 'Accept: image/png' -d "$scene" \
    "$url/v1/accuracy?theme=dark&rungs=harris,transport-16&samples=16&size=16&runs=2" -o "$work/plot.png"
contains "plot" "1120 x" "$(oiiotool --info "$work/plot.png")"
same "no such query" 400 "$(code -H "$json" -d "$scene" "$url/v1/accuracy?colour=red")"
same "a form" 415 "$(code -d "$scene" "$url/v1/plan")"
same "no JSON" 400 "$(code -H "$json" -d '{' "$url/v1/plan")"
contains "pointer" '"pointer":"/cubes/0/size/1"' "$(curl -s -H "$json" \
    -d '{"cubes":[{"particles":1,"size":[1,0,1],"center":[0,0,0],"radius":1}]}' "$url/v1/plan")"
same "no acceptable type" 406 "$(code -H "$json" -H 'Accept: text/html' -d "$scene" "$url/v1/render")"
same "chunked" 411 "$(code -H "$json" -H 'Transfer-Encoding: chunked' -d "$scene" "$url/v1/plan")"
same "compressed otherwise" 415 "$(code -H "$json" -H 'Content-Encoding: br' -d "$scene" "$url/v1/plan")"
printf '%s' "$scene" | gzip >"$work/packed.gz"
same "compressed" 200 "$(code -H "$json" -H 'Content-Encoding: gzip' --data-binary @"$work/packed.gz" "$url/v1/plan")"
same "answers are unpacked" "$(curl -s -H "$json" -d "$scene" "$url/v1/particles" | md5sum)" "$(curl -s --compressed -H "$json" -d "$scene" "$url/v1/particles" | md5sum)"
same "a form with a file" 200 "$(printf 'x;y;z\n0;0;0\n' | curl -s -o /dev/null -w '%{http_code}' -F 'scene=@-;filename=a.csv' -F radius=0.5 "$url/v1/particles")"
same "a slash too many" 200 "$(curl -s -L -o /dev/null -w '%{http_code}' "$url/v1/presets/")"
same "a query that is not known" 400 "$(code -H "$json" -d "$scene" "$url/v1/plan?hight=3")"
same "foreign Host" 421 "$(code -H 'Host: evil.example' "$url/healthz")"
same "foreign Origin" 403 "$(code -H "$json" -H 'Origin: http://evil.example' -d "$scene" "$url/v1/plan")"
same "own Origin" 200 "$(code -H "$json" -H "Origin: $url" -d "$scene" "$url/v1/plan")"

# A million bytes make curl ask first (Expect: 100-continue); the answer must come all the same.
head -c 2000000 /dev/zero | tr '\0' ' ' >"$work/long.json"
echo "$scene" >>"$work/long.json"
same "long body" 200 "$(code -H "$json" --data-binary @"$work/long.json" "$url/v1/plan")"
same "long body nobody wants" 404 "$(code -H "$json" --data-binary @"$work/long.json" "$url/nowhere")"
head -c 110000000 /dev/zero >"$work/huge"
same "body over the limit" 413 "$(code -H "$json" --data-binary @"$work/huge" "$url/v1/plan")"
same "and without asking" 413 "$(code -H "$json" -H 'Expect:' --data-binary @"$work/huge" "$url/v1/plan")"
rm "$work/huge"

# --- jobs: asked for now, fetched later, the same bytes
curl -s -o "$work/now.png" -H "$json" -d "$scene" "$url/v1/render"
curl -s -D "$work/head" -o /dev/null -H "$json" -d "{\"kind\":\"render\",\"scene\":$scene}" "$url/v1/jobs"
job=$url$(tr -d '\r' <"$work/head" | sed -n 's/^Location: //p')
contains "the last event" '"state":"done","progress":1' "$(curl -sN --max-time 20 "$job/events")"
contains "a job's state" '"state":"done"' "$(curl -s "$job")"
same "a job's result" 200 "$(curl -s -o "$work/later.png" -w '%{http_code}' "$job/result")"
cmp -s "$work/now.png" "$work/later.png" || fail "a job's picture has other bytes"
same "a result is dropped" "204 404" "$(code -X DELETE "$job") $(code "$job")"
moving='{"clouds":[{"velocity":[1,0,0],"cubes":[{"particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}]}],
    "sequence":{"from":0,"to":2,"frames":3},"image":{"width":64,"height":48},"accuracy":{"rung":"harris"}}'
curl -s -D "$work/head" -o /dev/null -H "$json" -d "{\"kind\":\"sequence\",\"scene\":$moving,\"format\":\"apng\"}" "$url/v1/jobs"
job=$url$(tr -d '\r' <"$work/head" | sed -n 's/^Location: //p')
contains "a sequence" '"state":"done"' "$(curl -sN --max-time 60 "$job/events" | tail -3)"
echo "$moving" >"$work/moving.json"
"$awan" render "$work/moving.json" -o "$work/moving.apng" --software >/dev/null
curl -s -o "$work/job.apng" "$job/result"
cmp -s "$work/moving.apng" "$work/job.apng" || fail "a sequence has other bytes than the command line's"

# Two requests on one connection.
contains "keep-alive" 'Re-using existing connection' \
    "$(curl -sv -o /dev/null -o /dev/null "$url/healthz" "$url/version" 2>&1)"

# --- a second server on the same port
"$awan" serve --listen "${url#http://}" 2>"$work/second"
same "port taken" 5 "$?"
contains "port taken" "taken" "$(cat "$work/second")"

# --- stopping with work in flight
curl -s -o "$work/last" -w '%{http_code}' -H "$json" \
    -d '{"cubes":[{"particles":200000,"size":[9,9,9],"center":[0,0,0],"radius":0.5}]}' \
    -H 'Accept: text/csv' --limit-rate 20M "$url/v1/particles" >"$work/status" &
client=$!
for _ in $(seq 100); do [ -s "$work/last" ] && break; sleep 0.02; done
stop 0 TERM
wait "$client"
same "what was in flight" "200 200001" "$(cat "$work/status") $(wc -l <"$work/last")"

# --- settings: flags, then the environment, then the file
printf '[serve]\nsoftware = true\nqueue = 3\nallow-host = ["file.example", "other.example"]\n' >"$work/awan.conf"
AWAN_CONFIG="$work/awan.conf" start
same "host of the file" 200 "$(code -H 'Host: other.example' "$url/healthz")"
stop 0 INT
same "the file is for serve only" 0 "$(AWAN_CONFIG="$work/awan.conf" "$awan" plan "$work/long.json" >/dev/null; echo $?)"
AWAN_ALLOW_HOST=env.example start --software --config "$work/awan.conf"
same "host of the environment" 200 "$(code -H 'Host: env.example:80' "$url/healthz")"
same "host of the file, overruled" 421 "$(code -H 'Host: file.example' "$url/healthz")"
stop 0 TERM

# --- beyond this machine only with a token, or where something else guards it
"$awan" serve --listen 0.0.0.0:0 2>"$work/second"
same "open by mistake" 2 "$?"
contains "open by mistake" "--token-file" "$(cat "$work/second")"
echo short >"$work/token"
"$awan" serve --listen 0.0.0.0:0 --token-file "$work/token" 2>"$work/second"
same "a token that can be guessed" 5 "$?"
echo 0123456789abcdef >"$work/token"
deadline=4.5
[ -z "${AWAN_SANITIZED:-}" ] || deadline=15 # nothing else would fit
listen=0.0.0.0:0 start --software --token-file "$work/token" --log json --deadline "$deadline" --max-body 1 --queue 3
url=${url/0.0.0.0/127.0.0.1}
same "health without a token" 200 "$(code "$url/healthz")"
same "without a token" 401 "$(code -H "$json" -d "$scene" "$url/v1/plan")"
contains "what is wanted" 'WWW-Authenticate: Bearer' "$(curl -si "$url/metrics")"
for open in / /start.js /openapi.json; do same "$open without a token" 200 "$(code "$url$open")"; done
for closed in /v1/presets /version /start.jsx //start.js; do same "$closed without a token" 401 "$(code --path-as-is "$url$closed")"; done
same "a page that is posted to" 401 "$(code -d x "$url/")"
same "with another" 401 "$(code -H 'Authorization: Bearer 0123456789abcdee' "$url/metrics")"
token='Authorization: bearer 0123456789abcdef'
same "with the token" 200 "$(code -H "$token" -H "$json" -d "$scene" "$url/v1/plan")"
same "body over --max-body" 413 "$(code -H "$token" -H "$json" --data-binary @"$work/long.json" "$url/v1/plan")"
truth='{"cubes":[{"particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],"image":{"width":2048,"height":2048},"accuracy":{"rung":"truth"}}'
contains "what would fit" '\"time_ms\"' "$(curl -s -H "$token" -H "$json" -d "$truth" "$url/v1/render")"
curl -s -o "$work/kept1" -H "$token" -H "$json" -d "$scene" "$url/v1/render"
contains "kept" 'Awan-Cache: hit' "$(curl -s -D - -o "$work/kept2" -H "$token" -H "$json" -d "$scene" "$url/v1/render")"
cmp -s "$work/kept1" "$work/kept2" || fail "what is kept has other bytes"
contains "kept, counted" 'awan_cache_hits_total 1' "$(curl -s -H "$token" "$url/metrics")"
same "an id in the log" 200 "$(code -H 'X-Request-Id: log-1' "$url/healthz")"
stop 0 TERM
python3 - "$work/log" <<'PYTHON' || fail "the log"
import json, sys
lines = [json.loads(line) for line in open(sys.argv[1]) if line.startswith("{")]
names = ["time", "client", "id", "method", "target", "route", "status", "bytes_in", "bytes_out", "seconds", "stages", "reason"]
assert all(list(line) == names for line in lines), lines[0]
assert any(line["id"] == "log-1" and line["route"] == "/healthz" and line["status"] == 200 for line in lines)
assert any(line["reason"] == "hopeless" and line["status"] == 504 for line in lines), lines
assert any(line["reason"] == "cache hit" for line in lines)
assert any(line["status"] == 401 and line["reason"] == "access" for line in lines)
assert any("encode" in line["stages"] for line in lines)
PYTHON

"$awan" serve --config "$work/none.conf" 2>"$work/second"
same "file that is not there" 5 "$?"
printf 'queeu = 3\n' >"$work/wrong.conf"
AWAN_CONFIG="$work/wrong.conf" "$awan" serve 2>"$work/second"
same "unknown setting" 2 "$?"
contains "unknown setting" "queeu" "$(cat "$work/second")"

[ "$failures" -eq 0 ] && echo "all well" || exit 1
