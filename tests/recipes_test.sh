#!/usr/bin/env bash
# The recipes of docker/farm that need no farm: make and ninja by what a picture is made of, and a frame by the line that
# Slurm, OpenCue and Deadline run. (proxy_test.sh has nginx and HAProxy, farm/slurm.sh a real Slurm.) $1: the binary.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/shell_checks.sh"
awan=$1
recipes=$here/../docker/farm
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

echo '{"cubes":[{"particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],
    "image":{"width":16,"height":12},"accuracy":{"rung":"transport-16"}}' >cumulus.json
"$awan" convert cumulus.json layout.awn 2>/dev/null || fail "a layout"
# A layout has no picture size of its own.
export AWAN_WIDTH=16 AWAN_HEIGHT=12 AWAN_RUNG=transport-16

# --- make and ninja: all, nothing, and what has changed
sed "s|^awan = .*|awan = $awan|" "$recipes/build.ninja" >build.ninja
cp "$recipes/Makefile" .
for tool in "make -s AWAN=$awan" "ninja --quiet"; do
    name=${tool%% *}
    rm -f cumulus.exr layout.png ./*.d
    $tool >log 2>&1 || fail "$name: $(cat log)"
    same "$name makes both" "cumulus.exr layout.png" "$(echo *.exr *.png)"
    touch -d '1 hour ago' cumulus.json layout.awn
    first=$(stat -c %y cumulus.exr layout.png)
    $tool >log 2>&1 || fail "$name again: $(cat log)"
    same "$name makes nothing again" "$first" "$(stat -c %y cumulus.exr layout.png)"
    sleep 0.02
    touch cumulus.json
    $tool >log 2>&1 || fail "$name anew: $(cat log)"
    [ "$(stat -c %y cumulus.exr)" != "$(head -1 <<<"$first")" ] || fail "$name does not see that the scene changed"
    same "$name leaves the other" "$(tail -1 <<<"$first")" "$(stat -c %y layout.png)"
done

# --- a frame as a farm asks for it, the same bytes as among all
echo '{"clouds":[{"velocity":[1,0,0],"cubes":[{"particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}]}],
    "sequence":{"from":0,"to":2,"frames":6}}' >growth.json
mkdir all some
"$awan" render growth.json --frames all -o 'all/frame.####.exr' >/dev/null 2>&1 || fail "all frames"
SLURM_ARRAY_TASK_ID=3 AWAN=$awan SCENE=growth.json FRAMES=some bash "$recipes/frames.sbatch" >/dev/null 2>&1 ||
    fail "frames.sbatch"
"$awan" render growth.json --frames 5-5 -o 'some/frame.####.exr' >/dev/null 2>&1 || fail "from and to the same frame"
same "these frames" "frame.0003.exr frame.0005.exr" "$(cd some && echo *)"
for frame in some/*; do
    cmp "$frame" "all/$(basename "$frame")" || fail "$frame is another by itself"
done
# Once more makes nothing: the file keeps its time.
first=$(stat -c %y some/frame.0003.exr)
SLURM_ARRAY_TASK_ID=3 AWAN=$awan SCENE=growth.json FRAMES=some bash "$recipes/frames.sbatch" >/dev/null 2>&1
same "what is there stays" "$first" "$(stat -c %y some/frame.0003.exr)"
exit "$failures"
