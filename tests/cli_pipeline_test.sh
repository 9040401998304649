#!/usr/bin/env bash
# What a pipeline takes beside pictures, opened by programs that are not ours: layers. $1: the binary.
set -uo pipefail
. "$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/shell_checks.sh"
awan=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

cat >scene.json <<'END_SCENE'
{"cubes":[{"particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],"density":3,
 "image":{"width":48,"height":32},"accuracy":{"rung":"transport-16"}}
END_SCENE

# --- layers
run 0 render scene.json -o plain.exr --set /image/precision=float
run 0 render scene.json -o layers.exr --layers all --set /image/precision=float
oiiotool --info -v layers.exr >info || fail "oiiotool does not open layers"
for channel in depth.Z transmittance.Y sun.R sky.G multiple.B haze.R background.B; do
    contains "channel $channel" "$channel" "$(cat info)"
done
# OpenImageIO adds them up again.
oiiotool layers.exr --ch R,G,B plain.exr --ch R,G,B --diff >diff || fail "layers change the picture: $(cat diff)"
oiiotool layers.exr --ch sun.R,sun.G,sun.B layers.exr --ch sky.R,sky.G,sky.B --add \
    layers.exr --ch multiple.R,multiple.G,multiple.B --add layers.exr --ch haze.R,haze.G,haze.B --add \
    layers.exr --ch background.R,background.G,background.B \
    layers.exr --ch transmittance.Y,transmittance.Y,transmittance.Y --mul --add \
    layers.exr --ch R,G,B --fail 1e-5 --warn 1e-5 --diff >diff || fail "layers do not add up: $(cat diff)"
run 0 render scene.json -o some.exr --layers depth,sun
oiiotool --info -v some.exr >info
contains "half floats, but for depth" "R (half), G (half), B (half), A (half), depth.Z (float), sun.R (half)" \
    "$(sed 's/sun.B (half), sun.G/sun.G/' info)"
grep -q sky info && fail "a layer that nobody asked for"
run 0 render scene.json -o some.exr -o view.png --layers depth
run 2 render scene.json -o view.png --layers depth
contains "layers are of EXR" "--layers none" "$(cat err)"
run 2 render scene.json -o view.png --set /image/layers=all
run 0 render scene.json -o view.png --set /image/layers=all --layers none
run 3 render scene.json -o some.exr --layers all --rung truth
contains "a rung that cannot" "rung truth cannot" "$(cat err)"
run 3 render scene.json -o some.exr --layers all,none
contains "which there are" "/image/layers" "$(cat err)"

# --- a preview: as the service draws it, without an error
run 0 render scene.json --width 40 --height 30 --rung transport-16 --preview --json -o preview.png
contains "a preview's line" '"error":null' "$(cat out)"
run 0 render scene.json --width 40 --height 30 --rung transport-16 -o whole.png
[ -s preview.png ] || fail "no preview"

# --- the sky
run 0 sky scene.json -o sky.exr --width 256 --set /sun/azimuth=90 --set /sun/elevation=30
oiiotool --info -v sky.exr >info || fail "oiiotool does not open the sky"
contains "twice as wide as high" "256 x  128" "$(cat info)"
contains "a map of all around" "latlong" "$(tr 'L' 'l' <info)"
contains "where the sun is" "awan:sun_direction: 0.866025, 0.5," "$(cat info)"
contains "what it sends" "awan:sun_irradiance" "$(cat info)"
run 0 sky scene.json -o - --format png
contains "a PNG" "PNG" "$(head -c 4 out | tr -d '\0')"
run 0 sky scene.json -o sky.exr --width 64 --json
contains "the sky's line" "$("$awan" digest scene.json | cut -d' ' -f1)\",\"width\":64,\"height\":32,\"times_ms\":{\"draw\":" "$(cat out)"
run 0 sky scene.json -o sky.exr --width 64 --json --skip-existing
contains "the line of a sky that is there" '"skipped":true' "$(cat out)"
run 2 sky scene.json -o - --json
run 2 sky scene.json -o sky.exr --width 255
run 2 sky scene.json -o sky.jpg
run 3 sky scene.json -o sky.exr --set /sun/elevation=1000

# --- light in a volume
if [ -e "$(dirname "$awan")/awan_openvdb.so" ]; then
    run 0 particles scene.json -o plain.vdb --voxels 24
    run 0 particles scene.json -o lit.vdb --voxels 24 --light
    vdb_print -l lit.vdb >info 2>&1 || fail "vdb_print does not open it: $(cat info)"
    contains "matter" "Name: density" "$(cat info)"
    contains "light" "Name: light" "$(cat info)"
    same "two grids of floats" 2 "$(grep -c "Type: Tree_float" info)"
    vdb_print lit.vdb >brief 2>&1
    same "in the same cells" 1 "$(grep -E '^(density|light) ' brief | awk '{print $3, $4, $5, $6, $7}' | sort -u | wc -l)"
fi
run 2 particles scene.json -o lit.ply --light
run 3 particles scene.json -o lit.vdb --light --set /accuracy/rung=single
contains "a rung without a grid" "/accuracy/rung" "$(cat err)"

# --- an impostor
float=(--set /image/precision=float)
run 0 impostor scene.json -o atlas.exr --views 3 --size 24 "${float[@]}"
oiiotool --info -v atlas.exr >info || fail "oiiotool does not open the atlas"
contains "all views" "72 x   72" "$(cat info)"
contains "depth and alpha" "R, G, B, A, depth.Z" "$(cat info)"
# Each view is the picture of its camera.
python3 - "$awan" <<'END_PYTHON' || fail "views of the atlas"
import json, math, subprocess, sys
layout = json.load(open("atlas.json"))
assert layout["image"] == "atlas.exr" and layout["mapping"] == "hemi-octahedral" and layout["depth"], layout
assert len(layout["frames"]) == 9
for number in (0, 4, 5):
    frame = layout["frames"][number]
    assert abs(math.hypot(*frame["direction"]) - 1) < 1e-9
    for axis in range(3):
        there = layout["center"][axis] + layout["distance"] * frame["direction"][axis]
        assert abs(there - frame["eye"][axis]) < 1e-9 * layout["distance"]
    camera = {"eye": frame["eye"], "target": layout["center"], "up": frame["up"], "fov": layout["fov"]}
    scene = json.load(open("scene.json"))
    scene["camera"] = camera
    scene["image"] = {"width": 24, "height": 24, "background": "transparent", "precision": "float", "layers": "depth"}
    json.dump(scene, open("view.json", "w"))
    subprocess.run([sys.argv[1], "render", "view.json", "-o", "view.exr"], check=True, stdout=subprocess.DEVNULL)
    cut = "24x24+%d+%d" % (frame["x"], frame["y"])
    subprocess.run(["oiiotool", "atlas.exr", "--cut", cut, "view.exr", "--fail", "0", "--warn", "0", "--diff"],
                   check=True, stdout=subprocess.DEVNULL)
END_PYTHON
run 0 impostor scene.json -o atlas.png --views 2 --size 8 --full
contains "from below too" '"mapping":"octahedral"' "$(tr -d ' ' <atlas.json)"
run 0 impostor scene.json -o atlas.png --views 2 --size 8 --full --json
contains "the atlas' line" '"outputs":["atlas.png","atlas.json"],"skipped":false,"digest":"' "$(cat out)"
contains "the atlas' line" '"width":16,"height":16,"times_ms":{"draw":' "$(cat out)"
run 2 impostor scene.json -o - --format png
run 2 impostor scene.json -o atlas.png --views 1
run 3 impostor scene.json -o atlas.png --views 32 --size 512

[ "$failures" -eq 0 ] && echo "all well" || exit 1
