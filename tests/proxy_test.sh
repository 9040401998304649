#!/usr/bin/env bash
# Two servers behind nginx, then behind HAProxy, by the recipes of docker/farm: a scene meets the instance that has its
# answer already, and nobody notices when an instance is killed. $1: the binary.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/shell_checks.sh"
awan=$1
recipes=$here/../docker/farm
work=$(mktemp -d)
started=()
trap 'kill -KILL "${started[@]}" 2>/dev/null; wait 2>/dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1
# Where Debian has nginx and HAProxy, for whoever is not root.
PATH=$PATH:/usr/sbin
scenes=12
clients=4

for i in $(seq "$scenes"); do
    printf '{"seed":%d,"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],
        "image":{"width":16,"height":12,"format":"exr"},"accuracy":{"rung":"transport-16"}}' "$i" >"scene-$i.json"
    "$awan" digest "scene-$i.json" | cut -d' ' -f1 >"digest-$i"
done

# Takes some tenths of a second: what is being rendered when an instance is killed.
printf '{"cubes":[{"particles":2000,"size":[4,2,4],"center":[0,0,0],"radius":0.5}],
    "image":{"width":240,"height":180,"format":"exr"},"accuracy":{"rung":"transport-32"}}' >scene-slow.json

# port_of LOG: the port that the server of this log took.
port_of() { sed -n 's/^awan: listening on http:.*:\([0-9]*\)\/$/\1/p' "$1"; }
# until_ready URL: waits for 200.
until_ready() {
    for _ in $(seq 600); do
        [ "$(curl -s -o /dev/null -w '%{http_code}' --max-time 5 "$1")" = 200 ] && return
        sleep 0.05
    done
    cat ./*.log >&2
    fail "$1 did not answer"
    exit 1
}
# start_instance N: sets port[N] and instance[N].
start_instance() {
    # Not the port of the one before: the log is emptied by who reads it, before the server is there to do so.
    : >"instance-$1.log"
    "$awan" serve --listen 127.0.0.1:0 --software --threads 1 --deadline 55 2>"instance-$1.log" &
    instance[$1]=$!
    started+=($!)
    for _ in $(seq 600); do
        port[$1]=$(port_of "instance-$1.log")
        [ -n "${port[$1]}" ] && break
        sleep 0.05
    done
    until_ready "http://127.0.0.1:${port[$1]}/readyz"
}
free_port() { python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }

# ask URL SCENE NAME: posts a scene with its digest; status in NAME.status, cache in NAME.head, body in NAME.exr.
ask() {
    curl -s --max-time 90 -D "$3.head" -o "$3.exr" -w '%{http_code}' -H "Awan-Digest: $(cat "digest-$2")" \
        -H 'Content-Type: application/json' --data-binary "@scene-$2.json" "$1/v1/render" >"$3.status"
}
# counts INSTANCE: the kept and the new answers that it gave, as its metrics say: "hits misses ".
counts() { curl -s "http://127.0.0.1:${port[$1]}/metrics" | awk '/^awan_cache_(hits|misses)_total /{printf "%d ", $2}'; }
# working INSTANCE: how many lanes of it compute; kept answers take none for longer than a look.
working() { curl -s "http://127.0.0.1:${port[$1]}/metrics" | sed -n 's/^awan_lanes_taken{of="processor"} //p'; }
cache_of() { tr -d '\r' <"$1.head" | sed -n 's/^[Aa]wan-[Cc]ache: //p'; }

# try PROXY COMMAND...: the recipe PROXY stands in ./PROXY, its port in $proxy_port.
try() {
    local proxy=$1
    shift
    start_instance 1
    start_instance 2
    local proxy_port
    proxy_port=$(free_port)
    sed -e "s/awan-1:8080/127.0.0.1:${port[1]}/; s/awan-2:8080/127.0.0.1:${port[2]}/" \
        -e "s/listen 8000/listen 127.0.0.1:$proxy_port/; s/bind :8000/bind 127.0.0.1:$proxy_port/" \
        -e "s|/tmp/awan-nginx|$work/nginx|" "$recipes/$proxy" >"$proxy"
    "$@" >"$proxy.log" 2>&1 &
    local front=$!
    started+=("$front")
    local url=http://127.0.0.1:$proxy_port
    until_ready "$url/readyz"

    # Every scene twice more: the second and the third answer are kept ones, so they came from the same instance.
    local i round
    for round in first second third; do
        for i in $(seq "$scenes"); do
            ask "$url" "$i" "$proxy-$round-$i"
            same "$proxy: scene $i, $round time" 200 "$(cat "$proxy-$round-$i.status")"
            case $round in
                first) same "$proxy: scene $i is new" miss "$(cache_of "$proxy-$round-$i")" ;;
                *) same "$proxy: scene $i meets its instance" hit "$(cache_of "$proxy-$round-$i")" ;;
            esac
            cmp -s "$proxy-first-$i.exr" "$proxy-$round-$i.exr" || fail "$proxy: scene $i has other bytes"
        done
    done
    local busy_1 busy_2
    busy_1=$(counts 1)
    busy_2=$(counts 2)
    [ "${busy_1#* }" != "0 " ] && [ "${busy_2#* }" != "0 " ] || fail "$proxy: one instance did it all: $busy_1/ $busy_2"

    # A digest that leads to the first instance, for the scene that takes long.
    local hits leads
    for i in $(seq "$scenes"); do
        hits=$(counts 1)
        ask "$url" "$i" "$proxy-look"
        [ "$hits" != "$(counts 1)" ] && leads=$i && break
    done
    cp "digest-$leads" digest-slow

    # Each instance by itself has the same bytes.
    for i in 1 2; do
        ask "http://127.0.0.1:${port[$i]}" 1 "$proxy-alone-$i"
        cmp -s "$proxy-first-1.exr" "$proxy-alone-$i.exr" || fail "$proxy: instance $i has other bytes"
    done

    # The first is killed while it renders and clients ask without a pause; each goes on until well after that.
    rm -f killed
    local asking=() client
    for client in $(seq "$clients"); do
        (
            turn=0
            after=0
            while [ "$after" -lt "$scenes" ]; do
                i=$(((turn * clients + client) % scenes + 1))
                ask "$url" "$i" "$proxy-load-$client-$turn"
                echo "$i $(cat "$proxy-load-$client-$turn.status")" >>"$proxy-load-$client"
                cmp -s "$proxy-first-$i.exr" "$proxy-load-$client-$turn.exr" || echo "$i bytes" >>"$proxy-load-$client"
                turn=$((turn + 1))
                [ -e killed ] && after=$((after + 1))
            done
        ) &
        asking+=($!)
    done
    sleep 0.5
    ask "$url" slow "$proxy-slow" &
    asking+=($!)
    for i in $(seq 200); do
        [ "$(working 1)" -ge 1 ] && break
    done
    sleep 0.1
    [ -s "$proxy-slow.status" ] && fail "$proxy: the slow scene was done before the kill"
    kill -KILL "${instance[1]}"
    wait "${instance[1]}" 2>/dev/null
    touch killed
    wait "${asking[@]}"
    same "$proxy: what the killed instance was rendering" 200 "$(cat "$proxy-slow.status")"
    local answers
    answers=$(cat "$proxy"-load-[0-9])
    same "$proxy: whatever failed while an instance was killed" "" "$(grep -v ' 200$' <<<"$answers")"
    [ "$(wc -l <<<"$answers")" -gt $((clients * scenes)) ] || fail "$proxy: nothing was asked before the kill"

    # The scenes of the instance that is left stay where they were; all are answered.
    for i in $(seq "$scenes"); do
        ask "$url" "$i" "$proxy-left-$i"
        same "$proxy: scene $i afterwards" "200 hit" "$(cat "$proxy-left-$i.status") $(cache_of "$proxy-left-$i")"
    done
    echo "$proxy: $(wc -l <<<"$answers") requests under load, none failed; before, hits and misses: $busy_1/ $busy_2"
    kill -TERM "$front" "${instance[2]}"
    wait "$front" "${instance[2]}" 2>/dev/null
}

try nginx.conf nginx -c "$work/nginx.conf" -g 'daemon off;'
try haproxy.cfg haproxy -db -f "$work/haproxy.cfg"
exit "$failures"
