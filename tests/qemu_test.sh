#!/usr/bin/env bash
# The same bytes on every x86-64 processor: what this machine makes, and what emulated ones make that lack its instruction
# sets. Haswell has AVX2 and fused multiply-adds, which the system's mathematics library then uses; Nehalem has neither,
# SSE4.2 being its widest. $1: the binary.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/shell_checks.sh"
awan=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

. "$here/same_bytes.sh"
pictures="noon finer single"
make_all native "$awan"
# AVX2 is emulated five times as slowly as SSE: one picture, which every stage has a part in.
pictures="noon" make_all Haswell qemu-x86_64 -cpu Haswell "$awan" &
make_all Nehalem qemu-x86_64 -cpu Nehalem "$awan" &
wait

same "what this machine made" 9 "$(find native -type f -size +500c | wc -l)"
for made in native/*; do
    name=$(basename "$made")
    for processor in Haswell Nehalem; do
        case $processor/$name in Haswell/finer.exr|Haswell/single.exr) continue ;; esac
        cmp "$made" "$processor/$name" || fail "$name has other bytes on a $processor"
    done
done
[ "$failures" = 0 ] || tail -n 5 ./*.log >&2
exit "$failures"
