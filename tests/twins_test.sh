#!/usr/bin/env bash
# What is said twice because two languages need it says the same: the automatic camera of the service and of its page.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
service=$(sed -nE 's/^inline constexpr double kAutomaticFov = ([-0-9.]+), kAutomaticAzimuth = ([-0-9.]+), kAutomaticElevation = ([-0-9.]+);$/\2 \3 \1/p' core/scene/camera.h)
page=$(sed -nE 's/^const AUTO = \{ azimuth: ([-0-9.]+), elevation: ([-0-9.]+), fov: ([-0-9.]+), .*/\1 \2 \3/p' web/camera.js)
if [ -z "$service" ] || [ "$service" != "$page" ]; then
    echo "azimuth, elevation and fov of the automatic camera: core/scene/camera.h says '$service', web/camera.js '$page'" >&2
    exit 1
fi
