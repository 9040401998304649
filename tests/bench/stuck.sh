#!/usr/bin/env bash
# What /healthz takes while a thousand connections are stuck in bodies, and open anew whenever they are closed.
#   bash tests/bench/stuck.sh build/release/awan [CONNECTIONS] [SECONDS]
ulimit -n "$(ulimit -Hn)"
exec bash "$(dirname "${BASH_SOURCE[0]}")/serve_and_run.sh" "$1" "$(dirname "${BASH_SOURCE[0]}")/stuck.py" "${2:-1000}" "${3:-20}"
