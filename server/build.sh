#!/usr/bin/env bash
# build.sh FOLDER [ARGUMENTS of cmake --build]: builds a configured folder and shows how far it is: on a terminal a line that
# counts, else a line now and then; nothing where nothing is to be done. A failure shows what the compiler said.
set -euo pipefail
log=$(mktemp)
trap 'rm -f "$log"' EXIT

# Ninja's "[12/182] Building ..." as a line of progress.
show_progress() {
    local line finished all left shown=0 begin=$SECONDS
    while IFS= read -r line; do
        printf '%s\n' "$line" >>"$log"
        [[ $line =~ ^\[([0-9]+)/([0-9]+)\] && $line != *Re-checking* && $line != *Re-running* ]] || continue
        finished=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]}
        left=$(((SECONDS - begin) * (all - finished) / (finished > 0 ? finished : 1)))
        if [ -t 2 ]; then
            printf '\rawan: built %d of %d, about %d s to go\033[K' "$finished" "$all" "$left" >&2
        elif ((SECONDS - begin >= shown + 30)); then
            shown=$((SECONDS - begin))
            echo "awan: built $finished of $all, about $left s to go" >&2
        fi
    done
    if [ -t 2 ]; then printf '\r\033[K' >&2; fi
}

if ! cmake --build "$@" 2>&1 | show_progress; then
    if grep -q '^FAILED: ' "$log"; then sed -n '/^FAILED: /,$p' "$log"; else cat "$log"; fi | tail -n 60 >&2
    echo "awan: the build failed" >&2
    exit 1
fi
