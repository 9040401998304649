#!/usr/bin/env bash
# No include runs from an earlier stage to a later one, and none in a circle: tests/includes.py holds the order.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
exec python3 "$here/includes.py" "$here/.."
