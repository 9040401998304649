#!/usr/bin/env bash
# Installs what is missing, builds, and serves on 127.0.0.1:8080.
#   bash server/start.sh                                     serve
#   bash server/start.sh serve --listen 127.0.0.1:9000       serve elsewhere
#   bash server/start.sh render web/presets/cumulus.json -o cloud.png
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
built=$root/build/release

bash "$root/server/install_packages.sh" build run
if [ ! -f "$built/build.ninja" ]; then
    log=$(mktemp)
    trap 'rm -f "$log"' EXIT
    if ! (cd "$root" && cmake --preset release -DAWAN_TESTS=OFF) >"$log" 2>&1; then
        tail -n 40 "$log" >&2
        echo "awan: the build could not be set up" >&2
        exit 1
    fi
    rm -f "$log"
fi
[ -x "$built/awan" ] ||
    echo "awan: the first build takes 2 to 5 minutes of processor time, shared by $(nproc) processors" >&2
bash "$root/server/build.sh" "$built" --target awan

[ $# -eq 0 ] && set -- serve
exec "$built/awan" "$@"
