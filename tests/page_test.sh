#!/usr/bin/env bash
# page_test.sh AWAN: the page in a real browser, against servers of its own.
set -euo pipefail
awan=$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/.." && pwd)

fail() { echo "page_test: $*" >&2; exit 1; }
command -v node >/dev/null || fail "node is missing"
[ -x /usr/bin/chromium ] || fail "/usr/bin/chromium is missing"
for module in playwright-core axe-core; do
    [ -d "$root/build/node/node_modules/$module" ] || fail "$module is missing: run tests/run.sh, which installs it"
done

scratch=$(mktemp -d)
server=
stop() {
    if [ -n "$server" ]; then
        kill "$server" 2>/dev/null || true
        wait "$server" 2>/dev/null || true
    fi
    server=
}
trap 'stop; rm -rf "$scratch"' EXIT

patience=900
deadline=4 # of the server that has little time
[ -z "${AWAN_SANITIZED:-}" ] || { patience=1700; deadline=40; }

# use SCRIPT ARGUMENTS...: a server with these flags, and the script in $arguments against it.
use() {
    local script=$1 port ready=
    shift
    port=$(node -e 'const s = require("net").createServer().listen(0, "127.0.0.1", () => { console.log(s.address().port); s.close(); })')
    "$awan" serve --listen "127.0.0.1:$port" "$@" >"$scratch/server.log" 2>&1 &
    server=$!
    for _ in $(seq 100); do
        if curl -fsS -o /dev/null "http://127.0.0.1:$port/readyz" 2>/dev/null; then ready=yes; break; fi
        kill -0 "$server" 2>/dev/null || break
        sleep 0.1
    done
    if [ -z "$ready" ]; then
        cat "$scratch/server.log" >&2
        fail "the server did not become ready"
    fi
    if ! timeout $patience node "$here/$script" "http://127.0.0.1:$port" "$scratch" $arguments; then
        tail -n 40 "$scratch/server.log" >&2
        exit 1
    fi
    stop
}

arguments=
use page.mjs
rm -rf "$scratch/profile"
use page_state.mjs
rm -rf "$scratch/profile"
use page_controls.mjs
use page_form.mjs
rm -rf "$scratch/profile"
use page_looks.mjs
AWAN_PAGE_GL=1 use page_workspace.mjs
rm -rf "$scratch/profile"
AWAN_PAGE_GL=1 use page_flight.mjs
rm -rf "$scratch/profile"
use page_deadline.mjs --deadline $deadline
echo 0123456789abcdef >"$scratch/token"
arguments=0123456789abcdef
use page_token.mjs --token-file "$scratch/token"
