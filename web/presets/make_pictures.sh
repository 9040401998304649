#!/usr/bin/env bash
# Renders the pictures of README.md into web/presets/pictures:  bash web/presets/make_pictures.sh
# Needs build/release/awan and oiiotool (package openimageio-tools).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
awan=$here/../../build/release/awan
names=(congestus cumulus-detailed humilis-field stratus creature cumulus)
mkdir -p "$here/pictures"
cd "$here/pictures"
for name in "${names[@]}"; do
    "$awan" render "../$name.json" --width 480 --height 320 -o "$name.png"
done
oiiotool "${names[@]/%/.png}" --mosaic:pad=6 3x2 --resize 980x0 -o contact-sheet.png
