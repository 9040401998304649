#!/usr/bin/env bash
# Renders the sheet of the models, still and in time, into web/presets/pictures/models.png:  bash web/presets/make_models.sh
# Needs build/release/awan and oiiotool (package openimageio-tools).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
awan=$here/../../build/release/awan
# A preset, or a frame of its sequence.
cells=(automaton-cumulus:15 automaton-cumulus:40 automaton-cumulus:100 automaton-wind:50 automaton-wind:120
    spheres-cumulus spheres-cirrus spheres-ostroushko:0 spheres-ostroushko:48 spheres-ostroushko:96
    implicit-cumulus implicit-cirrus implicit-stratus implicit-mackerel implicit-creature
    implicit-cirrostratus:0 implicit-cirrostratus:20 implicit-cirrostratus:60 implicit-sunset-cirrus implicit-sunset-cirrostratus
    implicit-growth:5 implicit-growth:20 implicit-growth:35 implicit-growth:48 implicit-growth:60
    implicit-bubbles:20 implicit-bubbles:52 implicit-billows:12 implicit-billows:44 implicit-cells
    ellipsoids-volume ellipsoids-stratus gardner-cumulus gardner-sky:0 gardner-sky:47)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
pictures=()
for i in "${!cells[@]}"; do
    IFS=: read -r name frame <<<"${cells[$i]}"
    picture=$work/$(printf %02d "$i").png
    "$awan" render "$here/$name.json" --width 400 --height 260 ${frame:+--frames "$frame"} -o "$picture"
    pictures+=("$picture")
done
mkdir -p "$here/pictures"
oiiotool "${pictures[@]}" --mosaic:pad=4 5x7 --resize:filter=gaussian 1040x0 --attrib png:compressionLevel 9 \
    -o "$here/pictures/models.png"
