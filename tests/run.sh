#!/usr/bin/env bash
# Installs what is missing, builds, and runs tests.
#   bash tests/run.sh              release build with -Werror, all tests: what must pass before a change lands
#   bash tests/run.sh quick        of these, those that together take a few minutes: while one works
#   bash tests/run.sh asan         all tests under AddressSanitizer and UBSan
#   bash tests/run.sh tsan         those that use threads, under ThreadSanitizer
#   further arguments go to ctest: bash tests/run.sh release -R http
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
which=${1:-release}
[ $# -gt 0 ] && shift

preset=$which targets=(all) labels=()
case $which in
    quick) preset=release targets=(awan quick_tests) labels=(-L '^quick$') ;;
    tsan) targets=(threads_tests) labels=(-L '^threads$') ;;
    *) ;;
esac

bash "$root/server/install_packages.sh" build run test
cd "$root"
cmake --preset "$preset" -DAWAN_TESTS=ON -DAWAN_WERROR=ON >/dev/null
bash server/build.sh "build/$preset" --target "${targets[@]}"
if ! cmp -s tests/package-lock.json build/node/package-lock.json || [ ! -d build/node/node_modules/playwright-core ]; then
    mkdir -p build/node
    cp tests/package.json tests/package-lock.json build/node/
    (cd build/node && npm ci --loglevel=error --no-audit --no-fund --ignore-scripts)
fi
# Tests that measure time or wait for a server have the machine to themselves (RUN_SERIAL in tests/CMakeLists.txt).
ctest --test-dir "build/$preset" --output-on-failure --no-tests=error -j "$(nproc)" "${labels[@]}" "$@"
