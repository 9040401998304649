#!/usr/bin/env bash
# Installs what is missing, builds, and serves on 127.0.0.1:8080.
#   bash server/start.sh                                     serve
#   bash server/start.sh serve --listen 127.0.0.1:9000       serve elsewhere
#   bash server/start.sh render web/presets/cumulus.json -o cloud.png
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

bash "$root/server/install_packages.sh" build run
log=$(mktemp)
trap 'rm -f "$log"' EXIT
build() {
    { [ -f "$root/build/release/build.ninja" ] || cmake -S "$root" --preset release -DAWAN_TESTS=OFF; } &&
    cmake --build "$root/build/release" --target awan
}
[ -x "$root/build/release/awan" ] || echo "awan: building (about a minute, once)" >&2
if ! (cd "$root" && build) >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    echo "awan: the build failed" >&2
    exit 1
fi
rm -f "$log"

[ $# -eq 0 ] && set -- serve
exec "$root/build/release/awan" "$@"
