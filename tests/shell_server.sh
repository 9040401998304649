# What scripts use that try the built program, $awan, as a server; each sources it after shell_checks.sh. Gives them a
# folder of their own, $work, and kills the server at the end.
patience=20 # seconds
[ -z "${AWAN_SANITIZED:-}" ] || patience=300
work=$(mktemp -d)
server=
trap '[ -n "$server" ] && kill -KILL "$server" 2>/dev/null; rm -rf "$work"' EXIT

# start ARGUMENTS...: serves on a free port (of $listen); sets $server and $url.
start() {
    # Not the address of the server before: the log is emptied here, not when the new one gets its turn.
    : >"$work/log"
    "$awan" serve --listen "${listen:-127.0.0.1:0}" "$@" 2>"$work/log" &
    server=$!
    url=
    for _ in $(seq 200); do
        url=$(sed -n 's/^awan: listening on \(http:.*\)\/$/\1/p' "$work/log")
        [ -n "$url" ] && break
        sleep 0.05
    done
    [ -n "$url" ] || { cat "$work/log" >&2; fail "the server did not start"; exit 1; }
    for _ in $(seq $((20 * patience))); do
        [ "$(code "$url/readyz")" = 200 ] && return
        sleep 0.05
    done
    cat "$work/log" >&2
    curl -si --max-time 5 "$url/readyz" >&2 || echo "curl: exit code $?" >&2
    fail "the server did not become ready"
    exit 1
}
stop() {  # expects exit code $1 after signal $2
    kill "-$2" "$server"
    wait "$server"
    same "exit code after SIG$2" "$1" "$?"
    server=
}
code() { curl -s -o /dev/null -w '%{http_code}' --max-time "$patience" "$@"; }
