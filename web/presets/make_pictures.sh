#!/usr/bin/env bash
# Renders the pictures of README.md into web/presets/pictures:  bash web/presets/make_pictures.sh
# Needs build/release/awan and oiiotool (package openimageio-tools).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
awan=$here/../../build/release/awan
names=(noon-cumulus silver-lining sunset-stratocumulus cirrus thunderhead fog-shafts sky-of-100 congestus creature)
mkdir -p "$here/pictures"
cd "$here/pictures"
for name in "${names[@]}"; do
    "$awan" render "../$name.json" --width 640 --height 400 -o "$name.png"
done
oiiotool "${names[@]/%/.png}" --mosaic:pad=6 3x3 --resize 1280x0 -o contact-sheet.png
"$awan" render ../mountain-cumulus.json --width 960 --height 540 --rung transport-64 -o mountain-cumulus.png
# The first picture of README.md: one preset, larger, without the ground below it.
"$awan" render ../silver-lining.json --width 1856 --height 928 --rung transport-64 -o cover.png
oiiotool cover.png --cut 1280x720+319+87 -o cover.png
