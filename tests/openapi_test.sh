#!/usr/bin/env bash
# What /openapi.json says is what the server does (proofs/openapi.py). $1: the binary. Under sanitizers, which take ten times
# as long, by fewer random scenes.
scenes=25
[ -z "${AWAN_SANITIZED:-}" ] || scenes=6
exec python3 "$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/proofs/openapi.py" "$1" "$scenes"
