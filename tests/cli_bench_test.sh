#!/usr/bin/env bash
# awan bench: what the sources measured stands beside what this machine does. $1: the binary.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/shell_checks.sh"
awan=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

run 0 bench --sources spheres,automaton -o bench.json -o bench.png
contains "the table" "Ostroushko" "$(cat out)"
contains "the table" "256 x 20 x 256 cells, 100 ellipsoids, a step with its smoothing (chapter V)" "$(cat out)"
python3 - <<'PY' || fail "bench.json"
import json
report = json.load(open("bench.json"))
figures = report["figures"]
assert report["threads"] >= 1 and len(figures) == 11, figures
assert {f["source"] for f in figures} == {"spheres", "automaton"}
for figure in figures:
    assert figure["here"] > 0, figure
    if "there" in figure:
        faster = figure["there"] / figure["here"] if figure["unit"] == "ms" else figure["here"] / figure["there"]
        assert abs(figure["times_as_fast"] - faster) < 1e-9 * faster, figure
    else:
        assert "times_as_fast" not in figure
# As printed: Upchurch's table 1, Ostroushko et al.'s table 1.
there = [f["there"] for f in figures if f["place"] == "table 1"]
assert there == [70, 35, 15, 4750, 9203, 22116], there
PY
size=$(oiiotool --info bench.png 2>&1)
contains "bench.png" "1120 x" "$size"
# Ebert's chapter prints no times: ours stand alone, and a plot of nothing but them is a picture, too.
run 0 bench --sources implicit -o bench.json -o bench.png
contains "the table" "the chapter prints no times" "$(cat out)"
python3 - <<'PY' || fail "bench.json of implicit clouds"
import json
figures = json.load(open("bench.json"))["figures"]
assert len(figures) == 6 and all(f["here"] > 0 and "there" not in f for f in figures), figures
PY
contains "bench.png of implicit clouds" " x " "$(oiiotool --info bench.png 2>&1)"
# Alone on standard output, where a program reads it.
run 0 bench --sources spheres -o -
same "JSON on standard output" "{" "$(head -c 1 out)"
run 2 bench --sources clouds
run 2 bench -o bench.txt

[ "$failures" = 0 ] && echo "awan bench measures, prints and plots"
exit "$failures"
