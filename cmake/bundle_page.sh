#!/usr/bin/env bash
# bundle_page.sh WEB OUT: the page's scripts as two files in OUT: start.js, the page itself, and workspace_view.js, which
# it loads when the first picture is there, with three.js. three.js comes from npm, as web/package-lock.json pins it, and
# nothing of it is run here; the bundler is Debian's.
set -euo pipefail
web=$1
out=$2

fail() { printf 'awan: %s\n' "$@" >&2; exit 1; }
for program in esbuild npm; do
    command -v "$program" >/dev/null ||
        fail "$program is missing, which the page is built with: bash server/install_packages.sh build"
done

mkdir -p "$out/npm"
# Fetched once, and again when another version is asked for.
if ! cmp -s "$web/package-lock.json" "$out/npm/fetched"; then
    cp "$web/package.json" "$web/package-lock.json" "$out/npm/"
    if ! (cd "$out/npm" && npm ci --ignore-scripts --no-audit --no-fund --prefer-offline --loglevel=error \
        --fetch-retries=2 --fetch-retry-mintimeout=1000 --fetch-retry-maxtimeout=5000 --fetch-timeout=60000) \
        >"$out/npm/log" 2>&1; then
        tail -n 12 "$out/npm/log" >&2
        fail "three.js could not be fetched from npm's registry, $(npm config get registry)." \
            "The first build needs it: behind a proxy, set https_proxy; for a mirror, npm config set registry URL."
    fi
    cp "$web/package-lock.json" "$out/npm/fetched"
fi

bundle() {
    NODE_PATH=$out/npm/node_modules esbuild "$web/$1" --bundle --format=esm --target=es2022 --minify --legal-comments=eof \
        --log-level=warning --outfile="$out/$1.new" && mv "$out/$1.new" "$out/$1"
}
bundle start.js
bundle workspace_view.js
