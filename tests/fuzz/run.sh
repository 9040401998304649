#!/usr/bin/env bash
# run.sh TARGET SECONDS [ARGUMENTS of libFuzzer]: builds the fuzzer of a target (targets.h) with Clang and runs it. What it
# meets is kept in build/fuzz/corpus/TARGET, what breaks a law in build/fuzz/found; see README.md.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
target=${1:?usage: run.sh TARGET SECONDS} seconds=${2:?usage: run.sh TARGET SECONDS}
shift 2
cd "$root"
command -v clang++ >/dev/null || { echo "fuzz: needs clang++ (Debian: apt-get install clang)" >&2; exit 1; }
cmake --preset fuzz >/dev/null
bash server/build.sh build/fuzz --target "fuzz_$target"

corpus=build/fuzz/corpus/$target
mkdir -p "$corpus" build/fuzz/found
seeds=("tests/data/fuzz/$target")
# Whole documents beside the small ones.
case $target in
    json) seeds+=(web/presets) ;;
    file|ply|csv) seeds+=(tests/data/field) ;;
    awn) seeds+=(tests/data) ;;
esac
# The words that the readers know.
case $target in
    json) words=(core/scene/*.h) ;;
    form|head|request) words=(server/http/*.cpp server/service/*.cpp server/document/overrides.h web/openapi.json) ;;
    *) words=(core/formats/*.cpp) ;;
esac
grep -oh '"[A-Za-z0-9_/ .:;=+-]\{2,30\}"' "${words[@]}" | sort -u >build/fuzz/words
export ASAN_OPTIONS=detect_stack_use_after_return=1:allocator_may_return_null=0
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
export LSAN_OPTIONS=suppressions=tests/suppressions/lsan.txt:print_suppressions=0
exec "build/fuzz/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -max_len=4096 -timeout=20 -rss_limit_mb=3000 \
    -artifact_prefix="build/fuzz/found/$target-" -print_final_stats=1 -dict=build/fuzz/words "$@" "$corpus" "${seeds[@]}"
