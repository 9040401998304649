#!/usr/bin/env bash
# The attack table against the program, behind nginx (proofs/attacks.py). $1: the binary.
exec python3 "$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/proofs/attacks.py" "$1" nginx
