#!/usr/bin/env bash
# The library as a stranger has it: installed into a folder of its own, and linked by a program outside of this tree, through
# the CMake package and through pkg-config, shared and static. Its pictures are the program's. $1: the binary.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/shell_checks.sh"
awan=$1
built=$(dirname "$awan")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
cmake --install "$built" --component library --prefix "$work/there" >log 2>&1 || fail "installing: $(cat log)"
# Nothing in it may know where it was built: it is moved.
mv there installed
there=$work/installed
cp -r "$here/library" source

echo '{"cubes":[{"particles":200,"size":[3,1,2],"center":[0,0,0],"radius":0.5}]}' >scene.json
run 0 render scene.json --width 96 --height 72 --json -o expected.png
expected=$(grep -o '"rung":"[a-z0-9-]*"' out | cut -d'"' -f4)

# try NAME PROGRAM: it makes the program's picture, and says what is wrong with a scene that cannot be one.
try() {
    local name=$1 program=$2
    AWAN_DEADLINE=nonsense LD_LIBRARY_PATH=$there/lib "$program" scene.json "$name.png" >"$name.out" 2>&1 ||
        fail "$name: $(cat "$name.out")"
    contains "$name" "200 particles, 96x72 by $expected, error 0.0" "$(cat "$name.out")"
    cmp -s expected.png "$name.png" || fail "$name: its picture is not the program's"
    echo '{"cubes":[{"particles":-3,"size":[3,1,2],"center":[0,0,0]}]}' >wrong.json
    LD_LIBRARY_PATH=$there/lib "$program" wrong.json wrong.png >"$name.out" 2>&1
    same "$name: exit code of a wrong scene" 1 "$?"
    contains "$name" "/cubes/0/particles: " "$(cat "$name.out")"
}

# --- the CMake package
for kind in shared static; do
    static=OFF
    [ $kind = static ] && static=ON
    { cmake -G Ninja -S source -B "cmake-$kind" -DCMAKE_PREFIX_PATH="$there" -DAWAN_STATIC=$static -DCMAKE_BUILD_TYPE=Release &&
        cmake --build "cmake-$kind"; } >log 2>&1 || fail "CMake, $kind: $(tail -5 log)"
    try "cmake-$kind" "cmake-$kind/example"
done
readelf -d cmake-shared/example | grep -q 'NEEDED.*libawan\.so\.0\.1' || fail "the shared one is not linked by its version"
readelf -d cmake-static/example | grep -q libawan && fail "the static one needs the shared one"

# --- pkg-config
export PKG_CONFIG_PATH=$there/lib/pkgconfig
same "pkg-config's version" "$("$awan" --version | cut -d' ' -f2)" "$(pkg-config --modversion awan)"
read -r -a flags <<<"$(pkg-config --cflags --libs awan)"
c++ -std=c++20 source/main.cpp "${flags[@]}" -o with-pkg-config 2>log || fail "pkg-config: $(tail -5 log)"
try with-pkg-config ./with-pkg-config
# The static one by the same names, the system's libraries still shared.
read -r -a flags <<<"$(pkg-config --static --cflags --libs awan | sed 's/-lawan/-l:libawan.a/')"
c++ -std=c++20 source/main.cpp "${flags[@]}" -o static-with-pkg-config 2>log || fail "pkg-config --static: $(tail -5 log)"
try static-with-pkg-config ./static-with-pkg-config

# --- the interface, and nothing else, is to be seen
shown=$(nm -D --defined-only --demangle "$there/lib/libawan.so" | cut -d' ' -f3- |
    grep -v -E '^(typeinfo (name )?for |vtable for )?awan::library::' )
same "symbols that are not of the interface" "" "$(head -5 <<<"$shown")"
same "installed files" "include/awan/awan.h" "$(cd "$there" && find include -type f)"

[ "$failures" = 0 ] && echo "the library installs, links and draws as the program does"
exit "$failures"
