#!/usr/bin/env bash
# What /openapi.json says is what the server does (proofs/openapi.py). $1: the binary.
exec python3 "$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/proofs/openapi.py" "$1"
