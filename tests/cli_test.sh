#!/usr/bin/env bash
# The command line: exit codes, messages, files that appear whole or not at all. $1: the binary.
set -uo pipefail
. "$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/shell_checks.sh"
awan=$1
work=$(mktemp -d)
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
cd "$work" || exit 1

cat >scene.json <<'END'
{"cubes":[{"particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],"image":{"width":64,"height":48},"accuracy":{"rung":"harris"}}
END
printf '60\n1\n60, 2, 1, 2, 0, 0, 0, 0.5\n' >layout.awn
printf '{"cubes":[{"particles":60,"size":[2,-1,2],"center":[0,0,0],"radius":0.5}]}' >impossible.json
printf 'nonsense' >broken.json

cat >moving.json <<'END'
{"clouds":[{"velocity":[1,0,0],"cubes":[{"particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}]}],
 "sequence":{"from":0,"to":2,"frames":4},"image":{"width":64,"height":48},"accuracy":{"rung":"harris"}}
END

# --- sequences
run 2 render scene.json --frames 0 -o a.png
contains "no sequence" "sequence" "$(cat err)"
run 2 render scene.json -o a.webp
run 2 render moving.json --frames 0-4 -o "m.%d.png"
contains "frames that there are" "0 to 3" "$(cat err)"
run 2 render moving.json --frames all -o m.png
contains "a place for the number" "%04d" "$(cat err)"
run 0 render moving.json --frames all -o "m.%03d.png"
same "numbered files" "m.000.png m.001.png m.002.png m.003.png" "$(echo m.*.png)"
run 0 render moving.json --frames 2 -o alone.png
cmp -s alone.png m.002.png || fail "a frame alone is not the frame among others"
cmp -s m.001.png m.002.png && fail "nothing moved"
run 0 render moving.json --time 1.3333333333333333 -o at.png
cmp -s at.png m.002.png || fail "the scene at a frame's time is not that frame"
run 0 render moving.json -o m.webp
same "animated WebP" "RIFF WEBP" "$(head -c 4 m.webp) $(head -c 12 m.webp | tail -c 4)"
run 0 render moving.json --fps 4 -o m.apng
oiiotool --info m.apng >info 2>&1 || fail "oiiotool does not read the APNG: $(cat info)"
contains "APNG's size" "64 x   48" "$(cat info)"
run 5 render moving.json -o nowhere/m.webp
# A sheet holds the frames' own pixels, where its layout says.
run 0 render moving.json --flipbook --columns 3 -o m.png
same "places of a flipbook" "m.png 192 96, 0 0 0 64 48, 1 64 0 64 48, 2 128 0 64 48, 3 0 48 64 48" "$(python3 -c '
import json
sheet = json.load(open("m.json"))
meta, size = sheet["meta"], sheet["meta"]["size"]
places = [(i, *(f["frame"][k] for k in "xywh")) for i, f in enumerate(sheet["frames"])]
print(", ".join(" ".join(map(str, row)) for row in [(meta["image"], size["w"], size["h"])] + places))')"
# Dithered by their places: two codes either way.
for place in 0:64x48+0+0 2:64x48+128+0 3:64x48+0+48; do
    oiiotool m.png --cut "${place#*:}" --ch R,G,B "m.00${place%%:*}.png" --fail 0.009 --warn 0.009 --diff >info 2>&1 || fail "frame $place of the flipbook: $(cat info)"
done
run 0 render moving.json --flipbook --frames 1-2 -o m.exr
contains "EXR flipbook" "128 x   48" "$(oiiotool --info m.exr)"
run 2 render scene.json --flipbook -o f.png
contains "a flipbook of what?" "sequence" "$(cat err)"
run 2 render moving.json --flipbook -o f.webp
run 2 render moving.json --columns 2 -o f.webp
run 3 render moving.json --flipbook --columns 5 -o f.png
contains "more columns than frames" "/sequence/frames" "$(cat err)"
rm -f m.* alone.png at.png info

# --- usage
run 0 --version
contains "version" "awan " "$(cat out)"
run 0 --help
run 0 render --help
contains "environment variables are named" "AWAN_WIDTH" "$(cat out)"
run 2
run 2 paint scene.json
run 2 render scene.json
run 2 render -o a.png
run 2 render scene.json -o a.png --colour red
run 2 render scene.json -o a.png --width 0
contains "bad value" "width" "$(cat err)"
run 2 render scene.json -o a.png --size 64
contains "bad value" "64 is not WIDTHxHEIGHT" "$(cat err)"
run 2 render scene.json -o a.png --size 64x48 --width 64
contains "one of them" "excludes" "$(cat err)"
run 2 render scene.json -o a.png --width many
contains "bad value" "width" "$(cat err)"
run 2 render scene.json -o a.png --format jpeg
contains "bad value" "format" "$(cat err)"
run 2 render scene.json -o a.jpeg
contains "unknown extension" "a.jpeg" "$(cat err)"
run 2 render scene.json -o a.png --format exr
run 2 particles scene.json -o a.txt
run 2 convert scene.json a.png
run 2 render scene.json -o a.png --rung perfect
contains "rungs are named" "transport-32" "$(cat err)"
run 2 render scene.json -o a.png --rung harris --error 0.1
run 2 render scene.json -o a.png --time-ms 10 --error 0.1
run 2 render scene.json -o a.png --error 0
run 2 accuracy scene.json
run 2 accuracy scene.json -o a.jpeg
contains "formats are named" ".json, .csv, .png" "$(cat err)"
run 2 accuracy scene.json -o a.png --theme blue
run 2 accuracy scene.json -o a.png --rungs harris,perfect
run 2 accuracy scene.json -o a.png -o a.png
run 2 accuracy - - -o a.png
run 2 serve --listen nowhere:port
contains "bad address" "nowhere:port" "$(cat err)"
run 2 serve --queue -1
AWAN_WIDTH=wide run 2 render scene.json -o a.png
contains "bad variable" "wide" "$(cat err)"
same "nothing was written" "" "$(ls -- *.png *.exr *.txt 2>/dev/null)"

# --- files that are not whole are not left: not by a limit on files, not by who was killed before
touch .awan-0123456789abcdef.tmp
(ulimit -f 1; "$awan" particles scene.json -o limited.csv 2>err); same "over a limit on files" 5 "$?"
contains "a limit on files" "limited.csv" "$(cat err)"
same "what was left is removed" "" "$(find . -name '.awan-*' -o -name limited.csv)"
"$awan" --version >/dev/full 2>err; same "a version that nobody got" 5 "$?"
for words in presets "presets cumulus" "digest scene.json" "validate scene.json" "completion bash" \
    "render scene.json --json -o unsaid.png"; do
    "$awan" $words >/dev/full 2>err; same "$words, which nobody got" 5 "$?"
    contains "$words, which nobody got" "standard output" "$(cat err)"
done
rm -f unsaid.png
# A file that another still writes is not removed.
mkfifo held
(flock -x 9; cat held >/dev/null) 9>.awan-writing.tmp &
until ! flock -n .awan-writing.tmp true; do sleep 0.02; done
run 0 particles scene.json -o whole.csv
same "another's file" ".awan-writing.tmp" "$(ls -A | grep '^.awan-')"
: >held; wait; rm held
run 0 particles scene.json -o whole.csv
same "its file, when it has ended" "" "$(ls -A | grep '^.awan-')"

# --- too little memory is an exit code, not a crash; a program with AddressSanitizer needs 20 TB of addresses to begin
if [ -z "${AWAN_SANITIZED:-}" ]; then
    (ulimit -v 300000; "$awan" render scene.json -o small.png 2>err); same "splats in little memory" 4 "$?"
    contains "little memory" "memory" "$(cat err)"
    for kib in 100000 450000 500000 550000 800000; do
        (ulimit -v $kib; "$awan" render scene.json -o small.png 2>err)
        case $? in 0 | 4) ;; *) fail "splats in $kib KiB: $? $(cat err)" ;; esac
    done
fi

# --- scenes that cannot be
run 3 plan impossible.json
contains "place" "awan: impossible.json: /cubes/0/size/1: must be" "$(cat err)"
run 3 plan broken.json
contains "not JSON" "awan: broken.json: not JSON at line 1, column 2: " "$(cat err)"
printf '1\n2\n' >short.awn
run 3 plan short.awn
contains "line" "awan: short.awn: line " "$(cat err)"
run 3 render impossible.json -o a.png
run 3 particles impossible.json
run 3 convert impossible.json a.awn
same "one line of message" 1 "$(wc -l <err)"

# --- files that cannot be read or written
run 5 plan nowhere.json
contains "missing" "nowhere.json: No such file" "$(cat err)"
run 5 plan .
run 5 particles scene.json -o nowhere/a.csv
run 5 accuracy scene.json -o nowhere/a.json
run 3 accuracy scene.json impossible.json -o a.json
contains "which of them" "awan: impossible.json: /cubes/0/size/1" "$(cat err)"
same "nothing was written" "" "$(ls a.json 2>/dev/null)"
run 5 particles scene.json -o /dev/full --format csv
contains "full" "No space left" "$(cat err)"
run 0 particles scene.json -o /dev/null --format csv
same "a device stays one" "character special file" "$(stat -c %F /dev/null)"
"$awan" particles scene.json -o - --format csv 2>err | head -c 1 >/dev/null
run 0 particles scene.json -o -
if [ "$(id -u)" -ne 0 ]; then
    mkdir sealed && chmod a-w sealed
    run 5 particles scene.json -o sealed/a.csv
fi
(ulimit -f 1; trap '' XFSZ; "$awan" particles scene.json -o big.json 2>err) # a disk that is full half-way
same "exit code on a full disk" 5 "$?"
same "no trace of the half" "" "$(ls -A | grep -e big -e tmp)"

# --- results
run 0 plan scene.json
same "plan" "harris" "$(python3 -c 'import json; print(json.load(open("out"))["rung"])')"
run 0 particles scene.json
mv out a.json
same "count" 60 "$(python3 -c 'import json; print(len(json.load(open("a.json"))["particles"]))')"
run 0 particles scene.json -o b.json
cmp -s a.json b.json || fail "standard output and a file differ"
run 0 particles scene.json -o b.json --threads 3
cmp -s a.json b.json || fail "particles depend on the number of threads"
run 0 particles scene.json -o a.csv
same "lines of CSV" 61 "$(wc -l <a.csv)"
run 0 particles scene.json -o a.ply
same "PLY" "ply" "$(head -n 1 a.ply)"
run 0 particles a.ply -o again.csv
cmp -s a.csv again.csv || fail "PLY does not bring the same particles back"
run 0 particles a.csv -o again.ply
cmp -s a.ply again.ply || fail "CSV does not bring the same particles back"
run 0 convert layout.awn b.json
run 0 convert b.json b.awn
run 0 convert b.awn c.json
cmp -s b.json c.json || fail "a layout does not come back"
run 0 convert a.csv ready.json
run 0 plan ready.json
run 3 convert a.csv ready.awn

# --- textures
printf 'awa 1\n40\n1\n40, 2, 1, 2, 0, 0, 0, 0.5, puff\n' >painted.awa
run 0 convert painted.awa painted.json
contains "an .awa as a document" '"texture":"puff"' "$(tr -d ' \n' <painted.json)"
run 0 convert painted.json painted2.awa
cmp -s painted.awa painted2.awa || fail "a layout of textures does not come back"
run 0 particles painted.awa -o painted3.awa
cmp -s painted.awa painted3.awa || fail "a layout of textures is not written"
run 3 convert painted.awa painted.awn
sed 's/awa 1/awa 7/' painted.awa >newer.awa
run 3 validate newer.awa
contains "a version that is not there" "line 1" "$(cat err)"
run 0 render painted.awa --json -o painted.png
contains "textures are drawn by splats" '"harris"' "$(cat out)"
run 3 plan scene.json --set /texture=mine
contains "a texture that is not there" "/texture" "$(cat err)"
run 2 render painted.awa --set /display=solid -o display.png --nonsense
run 3 render painted.awa --set /display=solid -o display.png
for display in cubes quads billboards bounding_boxes show_texture; do
    run 0 render painted.awa --set "/display=$display" -o display.png -o display.exr
    cmp -s display.png painted.png && fail "$display is drawn as if it were lit"
done
if [ -e "$(dirname "$awan")/awan_pictures" ]; then
    run 0 render scene.json --texture mine=painted.png --set /texture=mine -o mine.png
    run 3 render scene.json --texture mine=scene.json --set /texture=mine -o mine.png
    contains "no picture" "mine" "$(cat err)"
    run 3 render scene.json --texture ../mine=painted.png -o mine.png
    run 3 render scene.json --texture mine -o mine.png
    run 5 render scene.json --texture mine=absent.png -o mine.png
fi
for file in scene.json layout.awn a.ply a.csv; do
    "$awan" particles - -o - --format csv <"$file" >out || fail "$file from standard input"
    [ "$file" = layout.awn ] || cmp -s a.csv out || fail "$file from standard input is another"
done

# --- a file is replaced whole, keeps its permissions, and a link stays a link
echo old >target.csv
chmod 640 target.csv
ln -s target.csv link.csv
run 0 particles scene.json -o link.csv
cmp -s a.csv target.csv || fail "the file behind the link was not written"
same "permissions" 640 "$(stat -c %a target.csv)"
[ -L link.csv ] || fail "the link was replaced"
run 3 particles impossible.json -o target.csv
cmp -s a.csv target.csv || fail "an error touched the file"
mkfifo pipe
"$awan" particles scene.json -o pipe --format csv & cat pipe >out; wait $!
cmp -s a.csv out || fail "a pipe"
same "no temporary files" "" "$(ls -A | grep tmp)"

# --- images
run 0 render scene.json -o a.png
same "one line" 1 "$(cat out err | wc -l)"
contains "rung and errors" "a.png: harris, error " "$(cat out)"
contains "what was expected" "% (expected " "$(cat out)"
same "PNG" "$(printf '\211PNG')" "$(head -c 4 a.png)"
run 0 render scene.json -o b.PNG --threads 1 --software
cmp -s a.png b.PNG || fail "a picture depends on the number of threads"
run 0 render scene.json -o a.exr --width 20 --height 10
run 0 render scene.json -o sized.exr --size 20x10
cmp -s a.exr sized.exr || fail "--size is not --width with --height"
contains "size" "20 x   10" "$(oiiotool --info a.exr)"
for note in 'awan:rung: "harris"' "awan:error: 0." "awan:error_forecast: "; do
    contains "note in the EXR" "$note" "$(oiiotool --info -v a.exr)"
done
AWAN_WIDTH=30 AWAN_HEIGHT=12 run 0 render scene.json -o b.exr
contains "size of the environment" "30 x   12" "$(oiiotool --info b.exr)"
run 0 render scene.json -o - --format exr
same "EXR on standard output" 762f3101 "$(head -c 4 out | od -An -tx1 | tr -d ' ')"
run 0 render scene.json -o c.png --background transparent
contains "alpha" "4 channel" "$(oiiotool --info c.png)"
run 0 render layout.awn -o d.png --width 64 --height 48
__EGL_VENDOR_LIBRARY_FILENAMES=/nowhere run 4 render scene.json -o e.png
same "no file without a renderer" "" "$(ls e.png 2>/dev/null)"

# --- states of automata
printf '{"clouds":[{"model":"automaton","automaton":{"cells":[40,12,40],"steps_per_second":2}}],"time":3}' >automaton.json
sed 's/"time":3/"time":5.2/' automaton.json >afterwards.json
run 2 state automaton.json
run 0 state automaton.json -o at3.state
same "silence" "" "$(cat out err)"
run 0 particles afterwards.json -o from0.csv
run 0 particles afterwards.json -o from3.csv --state at3.state --threads 1
cmp -s from0.csv from3.csv || fail "a resumed automaton is another"
[ "$(wc -l <from0.csv)" -gt 500 ] || fail "an automaton has a cloud"
run 0 state afterwards.json -o at5.state
run 0 particles automaton.json -o a3.csv
run 0 particles automaton.json -o b3.csv --state at5.state
cmp -s a3.csv b3.csv || fail "a state that is too late changes something"
run 0 plan afterwards.json --state at3.state
run 0 render afterwards.json -o state.png --width 16 --height 12 --rung harris --state at3.state
sed 's/"time":3/"time":3,"seed":7/' automaton.json >other.json
run 3 particles other.json --state at3.state
contains "another seed" "seed" "$(cat err)"
# At intervals: any frame goes on from the one before it.
run 2 state afterwards.json -o one.state --every 2
mkdir kept
run 0 state automaton.json -o kept/%06d.state --every 2
[ -s kept/000000.state ] && [ -s kept/000002.state ] || fail "states at intervals are missing: $(ls kept)"
run 0 particles afterwards.json -o kept3.csv --state kept
cmp -s from3.csv kept3.csv || fail "from states at intervals other particles are made"
run 0 particles afterwards.json -o both3.csv --state at3.state --state kept/000002.state
cmp -s from3.csv both3.csv || fail "from two states other particles are made"
mkdir empty
run 3 particles afterwards.json --state empty
contains "a folder without states" "no files are in it" "$(cat err)"
sed 's/40,12,40/40,13,40/' automaton.json >other.json
run 3 plan other.json --state at3.state
contains "another grid" "parameters" "$(cat err)"
run 3 particles scene.json --state at3.state
run 3 state scene.json -o none.state
contains "no automaton" "/clouds" "$(cat err)"
head -c 3000 at3.state >half.state
run 3 plan automaton.json --state half.state
contains "half a state" "half.state" "$(cat err)"
run 5 plan automaton.json --state nothing.state
printf '{"clouds":[{"model":"automaton","automaton":{}},{"model":"automaton","automaton":{"cells":[20,8,20]}}]}' >two.json
run 3 state two.json -o two.state
contains "which of two" "--cloud" "$(cat err)"
run 3 state two.json -o two.state --cloud 2
run 0 state two.json -o two.state --cloud 1
run 0 plan two.json --state two.state

# --- what accuracy costs
run 0 accuracy scene.json -o acc.json -o acc.csv -o acc.png --samples 16 --size 16 --runs 2
same "silence" "" "$(cat out err)"
python3 - <<'END' || fail "accuracy"
import csv, json
answer = json.load(open("acc.json"))
names = [rung["rung"] for rung in answer["rungs"]]
assert "harris" in names and "transport-64" in names and "truth" not in names, names
rows = list(csv.DictReader(open("acc.csv")))
assert [row["rung"] for row in rows] == names
assert float(rows[0]["time_ms"]) == answer["rungs"][0]["time_ms"]
END
contains "plot" "1120 x" "$(oiiotool --info acc.png)"
run 0 accuracy scene.json layout.awn -o two.csv -o two.png --rungs harris --samples 16 --size 16 --theme dark
same "scenes in CSV" "scene scene layout" "$(cut -d, -f1 two.csv | tr '\n' ' ' | sed 's/ $//')"
run 0 accuracy - -o - --format csv --rungs harris --samples 16 --size 16 <scene.json
same "standard output" 2 "$(wc -l <out)"
"$awan" accuracy layout.awn -o late.json --samples 100000 2>err &
sweep=$!
sleep 0.5
kill -TERM "$sweep"  # SIGINT is ignored by what a script runs in the background
wait "$sweep"
same "interrupted" "" "$(ls -A | grep -e late -e tmp)"

# --- rungs by flag; those that need no renderer do without
run 0 render scene.json -o f.png --rung transport-16 --width 32 --height 24
__EGL_VENDOR_LIBRARY_FILENAMES=/nowhere run 0 render scene.json -o f.png --rung transport-16 --width 32 --height 24
run 0 render scene.json -o f.png --error 0.5
run 0 render scene.json -o f.png --time-ms 1000

[ "$failures" -eq 0 ] && echo "all well" || exit 1
