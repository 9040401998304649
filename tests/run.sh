#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test.
#   bash tests/run.sh              release build with -Werror, all tests
#   bash tests/run.sh asan         the same tests under AddressSanitizer and UBSan
#   bash tests/run.sh tsan         the threaded ones under ThreadSanitizer
#   further arguments go to ctest: bash tests/run.sh release -R http
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
preset=${1:-release}
[ $# -gt 0 ] && shift

bash "$root/server/install_packages.sh" build run test
cd "$root"
cmake --preset "$preset" -DAWAN_TESTS=ON -DAWAN_WERROR=ON >/dev/null
cmake --build "build/$preset"
if [ ! -d build/node/node_modules/playwright-core ]; then
    mkdir -p build/node
    cp tests/package.json tests/package-lock.json build/node/
    (cd build/node && npm ci --loglevel=error --no-audit --no-fund --ignore-scripts)
fi
ctest --test-dir "build/$preset" --output-on-failure --no-tests=error "$@"
