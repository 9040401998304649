#!/usr/bin/env bash
# Answers that outlive the server, and sequences as archives and animations: real restarts, and programs of others that
# open what comes. $1: the binary.
set -uo pipefail
awan=$1
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
. "$root/tests/shell_checks.sh"
. "$root/tests/shell_server.sh"

json='Content-Type: application/json'
cloud='"cubes":[{"particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],"image":{"width":64,"height":48}'
scene="{$cloud,\"accuracy\":{\"rung\":\"transport-16\"}}"
# By the default error: a restart must not measure its way to another tag.
plain="{$cloud}"
render() { curl -s -D "$work/head" -o "$1" -H "$json" -d "$2" "$url/v1/render"; tr -d '\r' <"$work/head" | sed -n 's/^Awan-Cache: //p'; }
metric() { curl -s "$url/metrics" | sed -n "s/^$1 //p"; }

# --- answers that outlive the server
kept="$work/kept"
start --cache-dir "$kept" --cache-disk 8
same "first" miss "$(render "$work/a.png" "$scene")"
same "first by error" miss "$(render "$work/b.png" "$plain")"
same "again" hit "$(render "$work/c.png" "$scene")"
stop 0 TERM
same "files" 2 "$(ls "$kept"/*.kept | wc -l)"
printf 'cache-dir = "%s"\ncache = 0\n' "$kept" >"$work/serve.conf"
start --config "$work/serve.conf"
same "after a restart" disk "$(render "$work/c.png" "$scene")"
cmp -s "$work/a.png" "$work/c.png" || fail "the answer of the server before has other bytes"
same "after a restart, by error" disk "$(render "$work/c.png" "$plain")"
cmp -s "$work/b.png" "$work/c.png" || fail "the other answer of the server before has other bytes"
same "from disk again" disk "$(render "$work/c.png" "$scene")"
same "hits" 3 "$(metric awan_cache_disk_hits_total)"
same "entries" 2 "$(metric awan_cache_disk_entries)"

# While it runs: damage is rendered anew and kept again; a folder that goes is no failure.
for file in "$kept"/*.kept; do truncate -s -1 "$file"; done
same "cut short" miss "$(render "$work/c.png" "$scene")"
cmp -s "$work/a.png" "$work/c.png" || fail "what was rendered anew has other bytes"
same "damage" 1 "$(metric awan_cache_disk_damaged_total)"
kill -KILL "$server"; wait "$server" 2>/dev/null; server=
echo half >"$kept/.awan-1-1.tmp"
AWAN_CACHE_DIR="$kept" start
[ -e "$kept/.awan-1-1.tmp" ] && fail "what a killed write left is still there"
same "after SIGKILL" disk "$(render "$work/c.png" "$scene")"
cmp -s "$work/a.png" "$work/c.png" || fail "after SIGKILL it has other bytes"
rm -r "$kept"
same "without its folder" miss "$(render "$work/c.png" "{\"seed\":2,${scene#?}")"
for _ in $(seq 100); do [ "$(metric awan_cache_disk_failed_total)" = 1 ] && break; sleep 0.05; done
same "not written" 1 "$(metric awan_cache_disk_failed_total)"
same "not written again" miss "$(render "$work/c.png" "{\"seed\":3,${scene#?}")"
stop 0 TERM
same "said once" 1 "$(grep -c "cannot be kept" "$work/log")"
"$awan" serve --cache-dir "$work/none/below" 2>"$work/second"
same "a folder that cannot be" 5 "$?"
contains "a folder that cannot be" "--cache-dir $work/none/below: " "$(cat "$work/second")"

# --- sequences
frames=4
moving="{\"clouds\":[{\"velocity\":[1,0,0],${cloud%%,\"image*}}],\"image\":{\"width\":64,\"height\":48},\"sequence\":{\"from\":0,\"to\":3,\"frames\":$frames},\"accuracy\":{\"rung\":\"transport-16\"}}"
start --lanes 2
# job FORMAT SCENE FILE: a sequence as a job, and its result once there is one.
job() {
    local at
    at=$(curl -si -H "$json" -d "{\"kind\":\"sequence\",\"format\":\"$1\",\"scene\":$2}" "$url/v1/jobs" | tr -d '\r' | sed -n 's/^Location: //p')
    curl -sN --max-time 120 "$url$at/events" >/dev/null
    curl -s -D "$work/head" -o "$3" "$url$at/result"
}
job zip "$moving" "$work/a.zip"
contains "type" "Content-Type: application/zip" "$(cat "$work/head")"
unzip -qt "$work/a.zip" >/dev/null || fail "unzip does not open the archive"
mkdir "$work/zip" "$work/cli"
unzip -qd "$work/zip" "$work/a.zip"
echo "$moving" >"$work/moving.json"
"$awan" render "$work/moving.json" --frames all -o "$work/cli/frame.%04d.png" || fail "the command line"
diff -r "$work/zip" "$work/cli" || fail "frames of the archive and of the command line differ"
for i in 0 2; do
    curl -s -o "$work/one.png" -H "$json" -d "{\"time\":$i,${moving#?}" "$url/v1/render"
    cmp -s "$work/one.png" "$work/zip/frame.000$i.png" || fail "frame $i alone has other bytes"
done
job zip "${moving/\"height\":48/\"height\":48,\"format\":\"exr\"}" "$work/b.zip"
python3 - "$work/a.zip" "$work/b.zip" <<'PYTHON' || fail "archives by Python"
import sys, zipfile
for path, ending, magic in ((sys.argv[1], "png", b"\x89PNG"), (sys.argv[2], "exr", b"v/1\x01")):
    archive = zipfile.ZipFile(path)
    assert archive.testzip() is None
    assert archive.namelist() == [f"frame.{i:04}.{ending}" for i in range(4)], archive.namelist()
    for entry in archive.infolist():
        assert entry.compress_type == zipfile.ZIP_STORED and entry.date_time == (1980, 1, 1, 0, 0, 0), entry
        assert entry.external_attr >> 16 == 0o100644, entry
        assert archive.read(entry).startswith(magic)
PYTHON
job zip "$moving" "$work/c.zip"
cmp -s "$work/a.zip" "$work/c.zip" || fail "the same frames make another archive"
job flipbook "$moving" "$work/f.zip"
mkdir "$work/sheet"
unzip -qd "$work/sheet" "$work/f.zip"
"$awan" render "$work/moving.json" --flipbook -o "$work/sheet/own.png" || fail "a flipbook by the command line"
cmp -s "$work/sheet/flipbook.png" "$work/sheet/own.png" || fail "flipbooks of the service and of the command line differ"
python3 - "$work/sheet" <<'PYTHON' || fail "the layout of the flipbook"
import json, sys
sheet, own = (json.load(open(f"{sys.argv[1]}/{name}.json")) for name in ("flipbook", "own"))
assert (sheet["meta"].pop("image"), own["meta"].pop("image")) == ("flipbook.png", "own.png")
assert sheet == own and [f["time"] for f in sheet["frames"]] == [0, 1, 2, 3], sheet
PYTHON
job webp "$moving" "$work/a.webp"
webpinfo "$work/a.webp" >"$work/webp" || fail "webpinfo does not open the animation"
same "pictures of the animation" "$frames" "$(grep -c 'Chunk ANMF' "$work/webp")"
same "its length, ms" "$((frames * 1000 / 12))" "$(awk '/Duration:/ { sum += $2 } END { print sum }' "$work/webp")"
same "its size" "Canvas size 64 x 48" "$(grep -o 'Canvas size 64 x 48' "$work/webp")"
stop 0 TERM

[ "$failures" -eq 0 ] && echo "all well" || exit 1
