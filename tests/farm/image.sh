#!/usr/bin/env bash
# docker/Dockerfile built by buildah, and what it makes run as docker/compose.yaml runs it: another user than root, no
# privilege, a root that cannot be written to. By hand and as root, without Docker and its hub: the base is made by debootstrap.
#   bash tests/farm/image.sh                          builds all of it, the program too (minutes)
#   bash tests/farm/image.sh build/release/awan       puts this program in, in place of the stage that compiles
# $WORK, if given, is kept and its base used again.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/../shell_checks.sh"
root=$(cd "$here/../.." && pwd)
[ "$(id -u)" = 0 ] || { echo "image.sh: run this as root" >&2; exit 1; }
command -v buildah debootstrap >/dev/null ||
    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends buildah debootstrap; } \
    >/dev/null || exit 1
work=${WORK:-$(mktemp -d)}
mkdir -p "$work"
server=
mounted=
b() { local command=$1; shift; buildah --root "$work/storage" --runroot "$work/run" --storage-driver vfs "$command" "$@"; }
cleanup() {
    # What this shell started is a shell that waits for unshare, which takes the server with it.
    [ -n "$server" ] && pkill -KILL -P "$server"
    wait 2>/dev/null
    [ -n "$mounted" ] && b rm "$mounted" >/dev/null
    [ -n "${WORK:-}" ] || rm -rf "$work"
}
trap cleanup EXIT

# --- the image
base=docker.io/library/debian:bookworm-slim
if ! b inspect --type image "$base" >/dev/null 2>&1; then
    [ -e "$work/base/etc/debian_version" ] ||
        debootstrap --variant=minbase bookworm "$work/base" http://deb.debian.org/debian >"$work/debootstrap.log" ||
        { tail "$work/debootstrap.log" >&2; exit 1; }
    empty=$(b from scratch)
    b add "$empty" "$work/base" / >/dev/null && b commit --rm "$empty" "$base" >/dev/null 2>&1 || { fail "no base"; exit 1; }
fi
stage=()
if [ $# -ge 1 ]; then
    mkdir -p "$work/build/awan/build/release"
    cp "$(dirname "$1")"/{awan,awan_openvdb.so,awan_pictures.so} "$work/build/awan/build/release/" || exit 1
    stage=(--build-context "build=$work/build")
fi
# Docker's own format: the other one has no health check.
b bud --isolation chroot --format docker --pull-never --layers=false "${stage[@]}" \
    -f "$root/docker/Dockerfile" --ignorefile "$root/docker/Dockerfile.dockerignore" -t awan "$root" >"$work/build.log" 2>&1 ||
    { tail -n 20 "$work/build.log" >&2; fail "the image was not built"; exit 1; }

# --- what it says of itself
b inspect --type image awan >"$work/inspect.json"
says() {
    python3 -c 'import json, sys; c = json.load(open(sys.argv[1]))["Docker"]["config"]; v = c[sys.argv[2]]
print("\n".join(v) if isinstance(v, list) else v)' "$work/inspect.json" "$1"
}
same "user" awan "$(says User)"
same "entry point" "awan" "$(says Entrypoint)"
same "command" "serve" "$(says Cmd)"
mapfile -t health < <(python3 -c 'import json, sys
for word in json.load(open(sys.argv[1]))["Docker"]["config"]["Healthcheck"]["Test"][1:]: print(word)' "$work/inspect.json")
mapfile -t variables < <(says Env)

# --- it runs
mounted=$(b from --pull-never awan)
image=$(b mount "$mounted")
user=$(chroot "$image" id -u awan)
# inside COMMAND...: in the image, as its user, without a privilege; the root is read-only, but for the cache.
inside() {
    IMAGE=$image unshare --mount --pid --fork --kill-child bash -c '
        mount --bind "$IMAGE" "$IMAGE" && mount -o remount,bind,ro "$IMAGE" && mount -t proc proc "$IMAGE/proc" &&
        mount --bind /dev "$IMAGE/dev" && mount -t tmpfs -o mode=1777 tmpfs "$IMAGE/var/cache/awan" &&
        exec chroot "$IMAGE" setpriv --reuid=awan --regid=awan --clear-groups --bounding-set=-all --no-new-privs "$@"' \
        inside /usr/bin/env -i "${variables[@]}" "$@"
}
same "who it is" "uid=$user" "$(inside id | cut -d'(' -f1)"
inside touch /usr/local/written 2>/dev/null && fail "the root can be written to"
port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
# The health check asks at 8080; the port that is free here takes its place.
health=("${health[@]//8080/$port}")
variables=("${variables[@]/:8080/:$port}")
# The first splats of a machine wait for their shaders to be compiled.
inside awan serve --deadline 120 2>"$work/log" &
server=$!
for _ in $(seq 300); do
    inside "${health[@]}" 2>/dev/null && break
    sleep 0.2
done
inside "${health[@]}" || { cat "$work/log" >&2; fail "not healthy"; exit 1; }
for _ in $(seq 300); do
    [ "$(curl -s -o /dev/null -w '%{http_code}' "http://127.0.0.1:$port/readyz")" = 200 ] && break
    sleep 0.2
done
for rung in transport-16 harris; do
    printf '{"cubes":[{"particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],"image":{"width":32,"height":24},
        "accuracy":{"rung":"%s"}}' "$rung" >"$work/scene.json"
    same "a picture by $rung" "200 image/png" "$(curl -s -o "$work/cloud.png" -w '%{http_code} %{content_type}' \
        -H 'Content-Type: application/json' --data-binary "@$work/scene.json" "http://127.0.0.1:$port/v1/render")"
done
same "a volume, by the module" 0 "$(inside awan particles - -o /var/cache/awan/cloud.vdb <"$work/scene.json" >"$work/vdb" 2>&1; echo $?)"
# The other module reads pictures that scenes are painted with; the picture that was just rendered is one.
printf '{"texture":"mine","cubes":[{"particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],
    "image":{"width":32,"height":24}}' >"$work/painted.json"
same "a texture, by the module" "200 image/png" "$(curl -s -o "$work/painted.png" -w '%{http_code} %{content_type}' \
    -F "scene=<$work/painted.json;type=application/json" -F "texture=@$work/cloud.png;filename=mine.png" \
    "http://127.0.0.1:$port/v1/render")"
[ "$failures" = 0 ] && echo "image.sh: built, $(du -sm "$image" | cut -f1) MB, healthy as user $user, root read-only"
exit "$failures"
