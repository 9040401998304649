#!/usr/bin/env bash
# Clouds for FlightGear, read by SimGear, FlightGear's own library.
#   bash tests/farm/flightgear.sh build/release/awan
# By hand and as root: installs libsimgear-dev where it is missing.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/../shell_checks.sh"
awan=$(realpath "$1")
[ -e /usr/include/simgear/props/props_io.hxx ] ||
    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends libsimgear-dev; } \
    >/dev/null || exit 1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
g++ -std=c++17 -w -O1 "$here/flightgear_reader.cpp" -o reader -lSimGearCore -lexpat -lz -llzma -lpthread || exit 1

# Two cubes, the first three times as long as wide: a heap each third or half, and one 2 units above and 4 to the east.
cat >layout.json <<'END_SCENE'
{"cubes":[{"particles":300,"size":[3,1,1],"center":[0,0.5,0],"radius":0.1},
          {"particles":100,"size":[1,1,1],"center":[4,2.5,-2],"radius":0.1}],"fill":"uniform"}
END_SCENE
run 0 particles layout.json -o layout.xml --unit 200
./reader layout.xml >read || fail "SimGear does not read layout.xml"
same "layers" "st sc cu ac ns cb" "$(awk '$1 == "layer" { print $2 }' read | xargs)"
[ "$(grep -c ^placed read)" -ge 3 ] || fail "the long cube was not cut"
# The last is the second cube: it is 200 m wide, stands 400 m over the others, and the farthest to the east and the north.
python3 - read <<'END_PYTHON' || fail "a heap is not where its cube is"
import sys

placed = [[float(x) for x in line.split()[1:]] for line in open(sys.argv[1]) if line.startswith("placed")]
x, y, height, width, tall = placed[-1]
assert 170 < width < 260 and 170 < tall < 260, placed[-1]
assert 370 < height < 430, placed[-1]
assert all(other[0] < x - 400 and other[1] < y - 300 for other in placed[:-1]), placed
END_PYTHON
for preset in cumulus implicit-cumulus spheres-cumulus; do
    run 0 particles "$here/../../web/presets/$preset.json" -o "$preset.xml"
    ./reader "$preset.xml" >read || fail "SimGear does not read $preset.xml"
    [ "$(grep -c ^placed read)" -ge 3 ] || fail "$preset has no heaps"
done
exit "$failures"
