#!/usr/bin/env bash
# Does the server keep memory? Resident memory after 1,000 small renders must be that after the first ones,
# within a few megabytes.   bash tests/bench/memory.sh build/release/awan [RENDERS]
exec bash "$(dirname "${BASH_SOURCE[0]}")/serve_and_run.sh" "$1" "$(dirname "${BASH_SOURCE[0]}")/memory.py" "${2:-1000}"
