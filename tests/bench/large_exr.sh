#!/usr/bin/env bash
# How well a deadline holds for the largest picture there is, 8192 x 4096 in floats: 200 within it, or 504 at it.
#   bash tests/bench/large_exr.sh build/release/awan [DEADLINE_SECONDS...]
set -euo pipefail
awan=$1
shift
[ $# -gt 0 ] || set -- 5 15 30
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scene='{"cubes":[{"particles":200,"size":[7.4,1.07,2.9],"center":[-3.4,-3.3,-0.6],"radius":2.1}],"image":{"width":8192,"height":4096,"format":"exr","precision":"float"},"accuracy":{"rung":"transport-16"}}'
for deadline in "$@"; do
    AWAN_DEADLINE=$deadline AWAN_CACHE=0 bash "$here/serve_and_run.sh" "$awan" "$here/large_exr.py" "$deadline" "$scene"
done
