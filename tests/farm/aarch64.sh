#!/usr/bin/env bash
# Awan for 64-bit ARM, built on this machine and run by qemu: its particles and pictures beside those of this machine's
# own build. All of them have to be the same bytes, and so have 68,000 results of core/base/exact_math.h.
#   bash tests/farm/aarch64.sh build/release/awan [FOLDER]
# By hand, some ten minutes. FOLDER holds a Debian of that architecture, which is made (as root, .5 GB) where there is
# none; otherwise it is build/aarch64-root. Needs qemu-user, mmdebstrap and g++-aarch64-linux-gnu.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/../shell_checks.sh"
awan=$(realpath "$1")
top=$(realpath "$here/../..")
root=$(realpath -m "${2:-$top/build/aarch64-root}")
for program in qemu-aarch64 aarch64-linux-gnu-g++; do
    command -v "$program" >/dev/null || { echo "aarch64.sh: there is no $program" >&2; exit 1; }
done

# --- a Debian of ARM's, unpacked only: nothing of it runs while it is made
if [ ! -e "$root/usr/include/gtest" ]; then
    # The modules for OpenVDB and textures are left out: they would double it.
    packages=$(awk '$1 == "build" && /-dev$/ && !/openvdb|openimageio|tbb|boost/ { printf "%s,", $2 }' \
        "$top/server/packages.txt")
    mmdebstrap --variant=extract --architectures=arm64 --include="${packages}libc6-dev,libstdc++-12-dev,libgtest-dev" \
        bookworm "$root" >/dev/null || exit 1
fi

# --- the program
cd "$top" || exit 1
cmake --preset aarch64 -DAWAN_SYSROOT="$root" >/dev/null && cmake --build build/aarch64 --target awan -j "$(nproc)" ||
    exit 1
emulated=(qemu-aarch64 -L "$root" "$top/build/aarch64/awan")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
aarch64-linux-gnu-g++ --sysroot="$root" -std=c++20 -O2 -ffp-contract=off -fno-math-errno -I. tests/exact_math_test.cpp \
    core/base/exact_*.cpp -lgtest -lgtest_main -o "$work/exact_math_test" || exit 1
qemu-aarch64 -L "$root" "$work/exact_math_test" >"$work/exact.log" || { cat "$work/exact.log"; fail "exact_math_test"; }

# --- the bytes
cd "$work" || exit 1
. "$here/../same_bytes.sh"
# Pictures of all models too, and as PNG: the tone curve.
for scene in models/*.json; do
    python3 - "$scene" >"pictures/of-$(basename "$scene")" <<'END_PYTHON'
import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    scene = json.load(file)
print(json.dumps(scene | {"image": {"width": 6, "height": 4}, "accuracy": {"rung": "transport-16"}}))
END_PYTHON
done
pictures=$(cd pictures && printf '%s\n' *.json | sed 's/\.json$//')
make_all native "$awan"
make_all emulated "${emulated[@]}"
for command in "native $awan" "emulated ${emulated[*]}"; do
    read -r folder line <<<"$command"
    $line render pictures/noon.json -o "$folder/noon.png" --threads 2
    $line particles models/cubes.json -o "$folder/cubes.json" --threads 2
    $line sky pictures/lumps.json -o "$folder/sky.exr" --threads 2
done
same "what this machine made" 18 "$(find native -type f -size +100c | wc -l)"
for made in native/*; do
    cmp "$made" "emulated/$(basename "$made")" || fail "$(basename "$made") has other bytes on ARM"
done
[ "$failures" = 0 ] || tail -n 5 ./*.log >&2
[ "$failures" = 0 ] && echo "aarch64.sh: $(find native -type f | wc -l) files, the same bytes on ARM"
exit "$failures"
