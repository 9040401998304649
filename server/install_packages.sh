#!/usr/bin/env bash
# install_packages.sh KIND... : installs those of server/packages.txt that are missing, as root or with sudo.
# Quiet when nothing is missing.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

wanted=()
for kind in "$@"; do
    while read -r first package; do
        [ "$first" = "$kind" ] && wanted+=("$package")
    done < "$here/packages.txt"
done
missing=()
for package in "${wanted[@]}"; do
    status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
    [ "$status" = "install ok installed" ] || missing+=("$package")
done
# A Node.js that did not come from Debian will do; Debian's npm would pull in a second one.
if command -v node >/dev/null && command -v npm >/dev/null; then
    kept=()
    for package in "${missing[@]}"; do
        case $package in nodejs|npm) ;; *) kept+=("$package") ;; esac
    done
    missing=("${kept[@]}")
fi
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "awan: missing packages: ${missing[*]}; run this as root, or install sudo" >&2; exit 1; }
    as_root=(sudo)
fi
echo "awan: installing ${#missing[@]} Debian packages: ${missing[*]}" >&2
log=$(mktemp)
if ! { "${as_root[@]}" apt-get update -qq &&
       "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"; } >"$log" 2>&1
then
    tail -n 20 "$log" >&2
    echo "awan: installing packages failed; the whole log: $log" >&2
    exit 1
fi
rm -f "$log"
