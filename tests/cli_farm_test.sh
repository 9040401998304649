#!/usr/bin/env bash
# The command line as renderers' users and farms know it: values by flag, several outputs, frames, files that are there
# already, what make reads, lines that programs read. $1: the binary.
set -uo pipefail
. "$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/shell_checks.sh"
awan=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

cat >scene.json <<'END_SCENE'
{"name":"puff","cubes":[{"_":"left","particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],
 "image":{"width":32,"height":24},"accuracy":{"rung":"transport-16"}}
END_SCENE
cat >moving.json <<'END_SCENE'
{"clouds":[{"velocity":[1,0,0],"cubes":[{"particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}]}],
 "sequence":{"from":0,"to":2,"frames":12},"image":{"width":16,"height":12},"accuracy":{"rung":"transport-16"}}
END_SCENE

# --- validate, presets, digest
run 0 validate scene.json moving.json
same "a line each" 2 "$(wc -l <out)"
sed 's/"radius":0.5/"radius":-1/' scene.json >bad.json
run 3 validate scene.json bad.json moving.json
contains "which" "bad.json: /cubes/0/radius" "$(cat err)"
same "the others are looked at" 2 "$(wc -l <out)"
printf '// my cloud\n{"cubes":[]}' >comment.json
run 3 validate comment.json
contains "line and column" "line 1, column 1" "$(cat err)"
run 0 presets
contains "presets" "cumulus" "$(cat out)"
run 0 presets noon-cumulus
mv out preset.json
run 0 validate preset.json
run 0 presets congestus
mv out congestus.json
run 0 presets "Cumulus congestus"
cmp -s out congestus.json || fail "a genus is a name of its preset"
run 2 presets nothing
contains "which there are" "noon-cumulus" "$(cat err)"
run 0 digest scene.json
digest=$(cut -d' ' -f1 out)
same "a digest" 32 "${#digest}"
run 0 digest scene.json --set /sun/elevation=12
[ "$digest" = "$(cut -d' ' -f1 out)" ] && fail "another sun is another scene"

# --- values by flag
run 0 validate scene.json moving.json --set /sun/elevation=12 --seed 4
run 3 validate scene.json moving.json --set /sun/elevation=95
same "each with the value" 2 "$(grep -c "/sun/elevation" err)"
run 3 accuracy scene.json -o a.json --set /sun/elevation=95
run 0 convert scene.json out.json --set /sun/elevation=12 --set /fill=gardner --set '/cubes/0/size=[1,2,3]' --seed 9
contains "elevation" '"elevation":12' "$(tr -d ' \n' <out.json)"
contains "a word" '"fill":"gardner"' "$(tr -d ' \n' <out.json)"
contains "a list" '"size":[1,2,3]' "$(tr -d ' \n' <out.json)"
contains "seed" '"seed":9' "$(tr -d ' \n' <out.json)"
run 3 convert scene.json out.json --set /sun/hight=12
contains "place" "/sun/hight" "$(cat err)"
run 3 convert scene.json out.json --set sun=12
printf 'x;y;z;Mass\n0,5;0;0;7\n' >places.csv
run 3 particles places.csv -o -
contains "what is missing" "--radius" "$(cat err)"
run 0 particles places.csv -o - --format csv --radius .25
contains "radius" "0.5,0,0,0.25" "$(cat out)"
contains "what is not used" 'places.csv: not used: "Mass"' "$(cat err)"
contains "decimal commas" "decimal commas" "$(cat err)"
gzip -k places.csv
run 0 particles places.csv.gz -o - --format csv --radius .25
contains "packed" "0.5,0,0,0.25" "$(cat out)"
run 0 particles scene.json -o answer.json
run 0 particles answer.json -o again.json
same "an answer comes back" "$(tail -n +2 answer.json)" "$(tail -n +2 again.json)"

# --- several outputs of one render
run 0 render scene.json -o a.png -o a.exr --bits 16
contains "16 bits" "uint16" "$(oiiotool --info a.png)"
contains "EXR beside it" "32 x   24" "$(oiiotool --info a.exr)"
run 0 render scene.json -o b.png
oiiotool --fail 0.006 --warn 0.006 a.png b.png --diff >diff 2>&1 || fail "16 bits show another picture: $(cat diff)"
run 0 render scene.json -o c.exr
cmp -s a.exr c.exr || fail "an output among others is another"
run 2 render scene.json -o a.png -o a.png
contains "twice" "twice" "$(cat err)"
run 2 render scene.json -o a.png --bits 12

# --- lines for programs
run 0 render scene.json -o a.png -o a.exr --json
python3 - <<'END_PYTHON' || fail "a line of JSON"
import json
lines = open("out").read().splitlines()
assert len(lines) == 1, lines
line = json.loads(lines[0])
assert line["outputs"] == ["a.png", "a.exr"] and line["scene"] == "scene.json", line
assert line["rung"] == "transport-16" and 0 < line["error"] < 1 and not line["skipped"], line
assert len(line["digest"]) == 32 and line["width"] == 32 and line["particles"] == 60, line
assert line["times_ms"]["draw"] > 0, line
END_PYTHON
run 0 digest scene.json --set /image/format=exr
same "its digest" "$(cut -d' ' -f1 out)" "$("$awan" render scene.json -o c.exr --json 2>err |
    python3 -c 'import json, sys; print(json.load(sys.stdin)["digest"])')"
run 2 render scene.json -o - --json

# --- files that are there
before=$(stat -c %y a.png)
run 0 render scene.json -o a.png -o a.exr --skip-existing
same "not made again" "$before" "$(stat -c %y a.png)"
run 0 render scene.json -o a.png -o new.exr --skip-existing
[ -s new.exr ] || fail "one that is missing is made"
: >empty.png
run 0 render scene.json -o empty.png --skip-existing
[ -s empty.png ] || fail "an empty file is no picture"

# --- frames
run 0 render moving.json --frames 1-9x4 -o "m.###.png"
same "every fourth" "m.001.png m.005.png m.009.png" "$(echo m.*.png)"
rm m.005.png
before=$(stat -c %y m.009.png)
run 0 render moving.json --frames 1-9x4 -o "m.%03d.png" --skip-existing --json
same "the missing one" "False True True" "$(python3 -c '
import json
lines = [json.loads(line) for line in open("out")]
print(*[line["skipped"] for line in sorted(lines, key=lambda line: (line["skipped"], line["frame"]))])')"
same "the others stay" "$before" "$(stat -c %y m.009.png)"
run 0 render moving.json --frames 5 -o alone.png
cmp -s alone.png m.005.png || fail "a frame alone is another"
run 0 render moving.json --frames 0,11 -o "two.##.png" -o two.webp -o "two.%d.exr"
same "files and an animation at once" "two.0.exr two.00.png two.11.exr two.11.png two.webp" "$(LC_ALL=C; echo two.*)"
for frames in 9-1 1-5x0 1-5x x2 1x2 0-99; do
    run 2 render moving.json --frames "$frames" -o "bad.%d.png"
done
for name in "bad.%04d" "bad.####"; do
    run 2 render scene.json -o "$name.png"
    contains "needs frames" "--frames" "$(cat err)"
    run 2 render moving.json -o "$name.webp"
    run 2 particles scene.json -o "$name.csv"
    run 2 plan scene.json -o "$name.json"
    run 2 convert scene.json "$name.json"
    run 2 accuracy scene.json -o "$name.json"
    run 2 state scene.json -o "$name.state"
    run 2 sky scene.json -o "$name.exr"
    run 2 impostor scene.json -o "$name.png"
    run 2 fly scene.json -o "$name.webp"
    run 2 fly scene.json --report "$name.json"
    run 2 plan scene.json --depfile "$name.d"
done
# As other renderers write the place, which is none here.
for name in 'bad.%4d' 'bad.%i' 'bad.$F4' 'bad.@@@@'; do
    run 2 render scene.json -o "$name.png"
    run 2 render moving.json --frames 0,1 -o "$name.png"
    contains "what to write" "####" "$(cat err)"
done
run 0 convert scene.json '100%_$Free.json'
run 2 render scene.json -o c.exr --bits 16
same "no literal names" "" "$(ls | grep 'bad\.[%#$@]')"
run 0 particles moving.json --frames 0-11x11 -o "p.%02d.csv"
run 0 particles moving.json --time 2 -o late.csv
cmp -s late.csv p.11.csv || fail "particles of a frame are those of its time"
cmp -s p.00.csv p.11.csv && fail "nothing moved"
run 2 particles moving.json --frames all -o p.csv
run 2 particles scene.json --frames all -o "p.%d.csv"

# --- many at once in one folder: nobody takes another's file for one that was left half-written
mkdir crowd
for writer in 1 2 3 4; do
    for i in $(seq 40); do "$awan" convert scene.json "crowd/$writer-$i.json" 2>>crowd.log; done &
done
wait
same "files of a crowd" 160 "$(ls -A crowd | wc -l)"
same "what a crowd complains of" "" "$(cat crowd.log)"

# --- what make and ninja read
cp scene.json "my scene.json"
run 0 render "my scene.json" -o a.png -o a.exr --depfile a.d
same "depfile" 'a.png a.exr: my\ scene.json' "$(cat a.d)"
run 0 particles moving.json --frames 0,1 -o "p.%d.csv" --depfile p.d
same "depfile of frames" "p.0.csv p.1.csv: moving.json" "$(cat p.d)"
for command in plan convert sky "impostor --views 2 --size 8"; do
    result=made.json
    case $command in sky) result=made.exr ;; impostor*) result=made.png ;; esac
    output=(-o "$result")
    [ "$command" = convert ] && output=("$result")
    rm -f made.*
    run 0 $command scene.json "${output[@]}" --depfile made.d
    contains "depfile of $command" "$result" "$(cat made.d)"
    contains "depfile of $command" ": scene.json" "$(cat made.d)"
    before=$(stat -c %y "$result")
    run 0 $command scene.json "${output[@]}" --skip-existing
    same "$command is not run again" "$before" "$(stat -c %y "$result")"
done
if command -v make >/dev/null; then
    printf -- '-include q.d\nq.png:\n\t@%s render scene.json -o q.png --depfile q.d >/dev/null && echo made\n' "$awan" >Makefile
    same "made once" "made" "$(make -s q.png)"
    contains "and not again" "up to date" "$(make q.png)"
    sleep 0.01 && touch scene.json
    same "and when the scene changes" "made" "$(make -s q.png)"
fi

# --- points and volumes for other programs
run 0 particles scene.json -o cloud.glb
assimp info cloud.glb >info 2>&1 || fail "assimp does not open the GLB: $(cat info)"
contains "points" "Vertices:           60" "$(cat info)"
python3 - <<'END_PYTHON' || fail "GLB"
import json, struct
data = open("cloud.glb", "rb").read()
magic, version, length, size, kind = struct.unpack("<4sIII4s", data[:20])
assert magic == b"glTF" and version == 2 and length == len(data) and kind == b"JSON", data[:20]
scene = json.loads(data[20:20 + size])
names = scene["meshes"][0]["primitives"][0]["attributes"]
start = 28 + size
def floats(name, per):
    view = scene["bufferViews"][scene["accessors"][names[name]]["bufferView"]]
    return struct.unpack("<%df" % (60 * per), data[start + view["byteOffset"]:start + view["byteOffset"] + 240 * per])
middle = scene["nodes"][0]["translation"]
answer = json.load(open("answer.json"))["particles"]
for i, particle in enumerate(answer):
    for k in range(3):
        assert abs(floats("POSITION", 3)[3 * i + k] + middle[k] - particle["center"][k]) < 1e-6
    assert abs(floats("_RADIUS", 1)[i] - particle["radius"]) < 1e-6
END_PYTHON
# FlightGear's clouds; SimGear reads them in farm/flightgear.sh.
run 0 particles scene.json -o cloud.xml --unit 50
python3 - <<'END_PYTHON' || fail "FlightGear's clouds"
import xml.etree.ElementTree
root = xml.etree.ElementTree.parse("cloud.xml").getroot()
assert root.tag == "PropertyList" and [part.tag for part in root] == ["clouds", "boxes", "layers", "placed"]
def numbers(node):
    return {child.tag: float(child.text) for child in node if child.tag not in ("texture", "height-map-texture")}
kinds = {kind.tag: numbers(kind) for kind in root.find("clouds")}
boxes = root.find("boxes")
for layer in root.find("layers"):
    for box in boxes.find(layer.find("cloud/name").text):
        assert box.find("type").text in kinds and float(box.find("count").text) >= 2
placed = [numbers(cloud) for cloud in root.find("placed")]
assert placed and {cloud["index"] for cloud in placed} == set(range(1, len(placed) + 1))
for cloud in placed + list(kinds.values()):
    for name in ("cloud-width-m", "cloud-height-m", "sprite-width-m", "sprite-height-m"):
        assert 0 < cloud["min-" + name] <= cloud["max-" + name], cloud
    assert cloud["min-sprite-height-m"] <= cloud["min-sprite-width-m"] <= cloud["min-cloud-width-m"], cloud
    assert 4 <= cloud["num-sprites"] <= 30 and 0 < cloud["alpha-factor"] <= 1, cloud
END_PYTHON
run 2 particles scene.json -o cloud.xml --unit 0
if [ -e "$(dirname "$awan")/awan_openvdb.so" ]; then
    run 0 particles scene.json -o cloud.vdb --voxels 48
    vdb_print -l cloud.vdb >info 2>&1 || fail "vdb_print does not open it: $(cat info)"
    contains "a grid of floats" "density" "$(cat info)"
    contains "a fog volume" "fog volume" "$(cat info)"
    run 0 particles scene.json -o - --format vdb --voxels 48
    [ "$(stat -c %s out)" = "$(stat -c %s cloud.vdb)" ] || fail "a volume on standard output is another"
fi

# --- completion
for shell in bash zsh fish; do
    run 0 completion "$shell"
    contains "completion for $shell" "skip-existing" "$(cat out)"
done
run 0 completion bash
same "bash completes" "--skip-existing" "$(bash -c '
source out
COMP_WORDS=(awan render --skip); COMP_CWORD=2; _awan; echo "${COMPREPLY[@]}"')"
for command in fly sky impostor validate; do
    contains "bash knows $command" "        $command) flags=" "$(cat out)"
done
contains "textures" "--texture" "$(cat out)"
same "and commands" "validate" "$(bash -c '
source out
COMP_WORDS=(awan val); COMP_CWORD=1; _awan; echo "${COMPREPLY[@]}"')"
run 2 completion tcsh

# --- a start costs little
python3 - "$awan" <<'END_PYTHON' || fail "a start costs too much"
import os, resource, subprocess, sys
awan = sys.argv[1]
libraries = subprocess.run(["ldd", awan], capture_output=True, text=True).stdout
assert "OpenImageIO" not in libraries, libraries
def usage(*arguments):
    """Processor seconds (the least of 5) and MB of memory."""
    best = 1e9
    for _ in range(5):
        pid = os.posix_spawn(awan, [awan, *arguments], os.environ, file_actions=[
            (os.POSIX_SPAWN_OPEN, 1, "/dev/null", os.O_WRONLY, 0)])
        _, status, used = os.wait4(pid, 0)
        assert status == 0
        best = min(best, used.ru_utime + used.ru_stime)
    return best, used.ru_maxrss / 1024
version, render = usage("--version"), usage("render", "scene.json", "-o", "-", "--width", "64", "--height", "48", "--threads", "1")
print("--version: %.0f ms, %.0f MB; 64x48: %.0f ms, %.0f MB" % (1000 * version[0], version[1], 1000 * render[0], render[1]))
# Sanitizers keep books in memory.
if "libasan" not in libraries and "libtsan" not in libraries:
    assert render[1] < 60, render
END_PYTHON

[ "$failures" -eq 0 ] && echo "all well" || exit 1
