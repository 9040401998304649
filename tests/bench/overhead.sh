#!/usr/bin/env bash
# What HTTP costs beside the work: the wall time a client sees, less the stages of Server-Timing. The median
# must stay under 2 ms.   bash tests/bench/overhead.sh build/release/awan [REQUESTS]
exec bash "$(dirname "${BASH_SOURCE[0]}")/serve_and_run.sh" "$1" "$(dirname "${BASH_SOURCE[0]}")/overhead.py" "${2:-200}"
