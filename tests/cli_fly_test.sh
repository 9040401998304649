#!/usr/bin/env bash
# awan fly: paths, modes, several files, reports, a time after which it stops. $1: the binary.
set -uo pipefail
. "$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/shell_checks.sh"
awan=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
export AWAN_THREADS=1

cat >scene.json <<'END_SCENE'
{"cubes":[{"particles":60,"size":[3,1,2],"center":[0,0,0],"radius":0.6}],"image":{"width":24,"height":16}}
END_SCENE
cat >other.json <<'END_SCENE'
{"clouds":[{"cubes":[{"particles":40,"size":[1,2,1],"center":[3,1,0],"radius":0.5}]}],"density":2}
END_SCENE

# --- an orbit with its report
mkdir frames
run 0 fly scene.json --frames 6 --size 20x12 -o "frames/%04d.png" --report report.json
same "a file a frame" "0000.png 0001.png 0002.png 0003.png 0004.png 0005.png" "$(cd frames && echo *)"
contains "its size" "20 x   12" "$(oiiotool --info frames/0003.png)"
cmp -s frames/0000.png frames/0003.png && fail "the camera moves"
contains "as text" "Billboards used" "$(cat out)"
contains "window" "20 x 12" "$(cat out)"
python3 - <<'END_PYTHON' || fail "the report"
import json
report = json.load(open("report.json"))
assert report["scenes"] == ["scene.json"] and report["path"] == "orbit" and report["mode"] == "as it stands", report
assert report["frames"] == report["frames_asked"] == len(report["each"]) == 6 and not report["timed_out"], report
assert report["rung"] == "transport-16" and report["renderer"] == "processor", report
assert report["particles"] == 60 and report["in_view"] == 60 and report["billboards"] == 0, report
assert report["lights_made"] <= 1, "light is kept from frame to frame"
assert report["fps"] > 0 and report["time_s"] > 0 and report["peak_memory_mib"] > 5, report
assert set(report["stages_ms"]) == {"generate", "survey", "light", "draw", "measure", "encode"}, report
assert report["stages_ms"]["draw"] > 0, report
impostors = report["impostors"]
assert impostors["mode"] == "auto" and impostors["pixels"] == 1 and not impostors["on"] and impostors["reason"], impostors
assert abs(report["fps"] - 6000 / sum(one["ms"] for one in report["each"])) < 0.01, report
END_PYTHON

# --- the flight's document: rendered, it is the flight
run 0 fly scene.json --frames 6 --size 20x12 -o flight.json
run 0 validate flight.json
run 0 render flight.json --frames 3 -o alone.png
cmp -s alone.png frames/0003.png || fail "a frame of the document is one of the flight"

# --- through several, thick, as an animation; billboards where splats are drawn
run 0 fly scene.json other.json --path through --mode thick --frames 3 --rung harris --software \
    -o flight.webp --report report.txt --fps 5
contains "an animation" "RIFF" "$(head -c 4 flight.webp)"
contains "both models" "other.json" "$(cat report.txt)"
contains "mode" "thick" "$(cat report.txt)"
contains "all particles" "100" "$(grep '^Particles  ' report.txt)"
[ "$(grep '^Billboards' report.txt | tr -dc 0-9)" -gt 0 ] || fail "billboards: $(cat report.txt)"
same "what is printed is the report" "$(grep -v -e Time -e FPS -e ms -e memory -e Before report.txt)" \
    "$(grep -v -e Time -e FPS -e ms -e memory -e Before out)"

# --- keys in a file, and in the document
cat >keys.json <<'END_KEYS'
[{"time": 0, "eye": [0, 0, 9], "target": [0, 0, 0]}, {"time": 2, "eye": [9, 0, 0], "target": [0, 0, 0], "fov": 20}]
END_KEYS
run 0 fly scene.json --path keys.json --frames 3 -o "k%d.png" -o keyed.json
contains "the keys come along" '"eye": [9,0,0]' "$(cat keyed.json)"
run 0 render scene.json --set '/camera={"eye":[9,0,0],"target":[0,0,0],"fov":20}' --rung transport-16 -o last.png
cmp -s last.png k2.png || fail "the last frame is seen from the last key"
run 0 fly keyed.json --frames 2 --report own.json
contains "its own keys" '"path":"keys"' "$(cat own.json)"
run 0 convert keyed.json again.json
same "written back" "$(cat keyed.json)" "$(cat again.json)"

# --- impostors: a slow way past clouds far apart shows kept pictures, each frame with every cloud
cat >apart.json <<'END_SCENE'
{"cubes":[{"particles":60,"size":[3,1,2],"center":[-3,0,0],"radius":0.6},
 {"particles":60,"size":[3,1,2],"center":[6,-1,-30],"radius":0.6}],"image":{"width":48,"height":32}}
END_SCENE
cat >slow.json <<'END_KEYS'
[{"time": 0, "eye": [0, 0, 40], "target": [0, 0, 0]}, {"time": 1, "eye": [0.4, 0, 40], "target": [0, 0, 0]}]
END_KEYS
run 0 fly apart.json --path slow.json --frames 4 --impostors on --impostor-pixels 2 --report kept.json -o "i%d.png"
contains "as text" "Impostors            on:" "$(cat out)"
run 0 fly apart.json --path slow.json --frames 4 --impostors off --report whole.json -o "w%d.png"
cmp -s i2.png w2.png && fail "no kept picture is shown"
python3 - <<'END_PYTHON' || fail "the report of impostors"
import json
kept, whole = (json.load(open(name + ".json"))["impostors"] for name in ("kept", "whole"))
assert kept["on"] and kept["mode"] == "on" and kept["pixels"] == 2 and kept["clouds"] == 2, kept
assert kept["drawn"] == 2 and kept["redrawn"] == 0 and kept["frames"] == 4 and kept["kept"] == 6, kept
assert kept["whole"] == 0 and 0 < kept["pictures_share"] < 1 and 0 < kept["eye_share"] < 1, kept
assert not whole["on"] and whole["kept"] == whole["drawn"] == 0, whole
assert [one["impostors"]["drawn"] for one in json.load(open("kept.json"))["each"]] == [2, 0, 0, 0]
END_PYTHON
run 2 fly apart.json --impostor-pixels 0 -o x.webp
run 2 fly apart.json --impostors often -o x.webp

# --- what cannot be
sed 's/"time": 2/"time": 0/' keys.json >bad.json
run 3 fly scene.json --path bad.json -o flight.webp
contains "which key" "bad.json: /1/time" "$(cat err)"
echo '[{"time": 0, "eye": [0, 0, 9]}]' >bad.json
run 3 fly scene.json --path bad.json -o flight.webp
contains "what is missing" 'bad.json: /0: needs "target"' "$(cat err)"
echo '[]' >bad.json
run 3 fly scene.json --path bad.json -o flight.webp
run 3 fly scene.json --path scene.json -o flight.webp
contains "no keys" "scene.json: /cubes" "$(cat err)"
run 5 fly scene.json --path nowhere.json -o flight.webp
run 3 fly scene.json --path keys --frames 2
contains "no keys of its own" "/sequence/camera" "$(cat err)"
run 3 fly scene.json other.json --mode thick --frames 2 --set /cubes=[] --set /medium/g=0.5
contains "one medium" "other.json: /medium" "$(cat err)"
sed 's/"size":\[3/"size":[-3/' scene.json >bad.json
run 3 fly other.json bad.json
contains "which of the scenes" "bad.json: /cubes/0/size/0" "$(cat err)"
run 2 fly scene.json --size 20 -o flight.webp
run 2 fly scene.json --size 20x99999 -o flight.webp
run 2 fly scene.json --mode solid -o flight.webp
run 2 fly scene.json --frames 0 -o flight.webp
run 2 fly scene.json --frames 3 -o flight.png
contains "a place for numbers" "%04d" "$(cat err)"
run 2 fly scene.json --report report.pdf
run 2 fly

# --- a time after which it stops, with what is done
run 0 fly scene.json --frames 10000 --timeout 3 -o "t%05d.png" -o t.webp --report t.json
contains "it says so" "of 10000 frames are done" "$(cat err)"
python3 - <<'END_PYTHON' || fail "what is done in time"
import glob, json
report = json.load(open("t.json"))
assert report["timed_out"] and report["frames_asked"] == 10000, report
assert 0 < report["frames"] == len(glob.glob("t*.png")) < 10000, report["frames"]
END_PYTHON
contains "the animation is whole" "RIFF" "$(head -c 4 t.webp)"
run 4 fly scene.json --frames 3 --timeout 0.000001 --report t.json
contains "none in time" "the deadline passed" "$(cat err)"

# --- completion
run 0 completion bash
same "bash completes" "--timeout" "$(bash -c '
source out
COMP_WORDS=(awan fly --timeo); COMP_CWORD=2; _awan; echo "${COMPREPLY[@]}"')"

[ "$failures" -eq 0 ] && echo "all well" || exit 1
