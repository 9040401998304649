#!/usr/bin/env bash
# serve_and_run.sh AWAN SCRIPT ARGUMENTS...: starts a server on a free port and runs a Python script with its
# address as first argument.
set -euo pipefail
awan=$1 script=$2
shift 2
log=$(mktemp)
"$awan" serve --listen 127.0.0.1:0 --software 2>"$log" &
server=$!
trap 'kill "$server" 2>/dev/null; wait "$server" 2>/dev/null || true; rm -f "$log"' EXIT
for _ in $(seq 200); do
    grep -q 'renders with' "$log" && break
    sleep 0.05
done
address=$(sed -n 's/^awan: listening on http:\/\/\(.*\)\/$/\1/p' "$log")
python3 "$script" "$address" "$@"
