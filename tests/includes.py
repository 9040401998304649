"""Holds the sources to the order of their rooms: includes run from later stages to earlier ones, never back. And no room
of core/ calls the system's elementary functions, whose last bits differ between machines.

Usage: includes.py ROOT. Says file and line of every include that breaks a rule, and fails then."""

import re
import sys
import tempfile
from pathlib import Path

# The order, earliest first. A file may include what stands above its own line, and what is of its own room; rooms that
# share a line do not know each other. A room is a folder or, without its ending, a single pair of files; where two
# fit, the longer name counts.
ORDER = [
    ["core/base"],
    ["core/scene"],
    ["core/generate"],
    ["core/generate/automaton", "core/generate/spheres", "core/generate/implicit", "core/generate/ellipsoids"],
    ["core/survey"],
    ["core/plan"],
    ["core/gl", "core/shaders"],
    ["core/light"],
    ["core/draw"],
    ["core/looks"],
    ["core/truth"],
    ["core/formats"],
    ["core/planning"],
    ["core/measured_pictures"],
    ["core/climb"],
    ["core/sequence"],
    ["core/flight_impostors", "core/flight_path", "core/impostor", "core/lit_particles"],
    ["core/pipeline"],
    ["core/accuracy"],
    ["server/document"],
    ["server/library"],
    ["server/header_text", "server/limits"],
    ["server/service"],
    ["server/http"],
    ["server/cli"],
]

# What the order alone would allow. The truth is a second opinion on light: it must not share code with the first.
FORBIDDEN = [
    ("core/truth", "core/light"),
    ("core/truth", "core/draw"),
    ("core/truth", "core/looks"),
    ("core/truth", "core/shaders"),
    ("core/truth", "core/gl"),
]

# What core/base/exact_math.h has of its own.
ELEMENTARY = re.compile(
    r"\b(?:std|glm)::(exp2?|expm1|expint|log(?:2|10|1p)?|pow|a?(?:sin|cos|tan)|(?:sin|cos|tan)h|atan2|cbrt|hypot|erfc?|"
    r"[lt]gamma)f?\("
)

ENDINGS = {".h", ".cpp", ".glsl", ".inc"}
INCLUDE = re.compile(r'\s*#\s*include\s*(?:"([^"]+)"|<((?:core|server|tests)/[^>]+)>)')
LEVEL = {room: level for level, rooms in enumerate(ORDER) for room in rooms}


def room_of(path):
    """The room of a path relative to the root; None: of none."""
    fits = [room for room in LEVEL if path.startswith(room + "/") or path.rsplit(".", 1)[0] == room]
    return max(fits, key=len, default=None)


def includes_of(root, path):
    """(line, path that is included), of what is included of our own. Shaders name their neighbours by file alone."""
    for number, line in enumerate((root / path).read_text().splitlines(), 1):
        found = INCLUDE.match(line)
        if found:
            target = found.group(1) or found.group(2)
            beside = str(Path(path).parent / target)
            yield number, beside if (root / beside).exists() else target


def sources(root):
    files = [f for top in ("core", "server") for f in (root / top).rglob("*") if f.suffix in ENDINGS]
    return sorted(str(f.relative_to(root)) for f in files)


def wrong_direction(path, line, target):
    """What is wrong with one include; None: nothing."""
    here, there = room_of(path), room_of(target)
    where = f"{path}:{line}: includes {target}"
    if there is None:
        return f"{where}, which is in no room of tests/includes.py"
    if here == there:
        return None
    if LEVEL[there] > LEVEL[here]:
        return f"{where}: {there} comes after {here}"
    if LEVEL[there] == LEVEL[here]:
        return f"{where}: {there} and {here} do not know each other"
    if (here, there) in FORBIDDEN:
        return f"{where}: {here} shares nothing with {there}"
    return None


def cycles(graph):
    """Of {file: {file it includes: where}}: one line for each include that closes a circle."""
    found, state = [], {}

    def visit(path, way):
        state[path] = "open"
        for target, where in sorted(graph.get(path, {}).items()):
            if state.get(target) == "open":
                circle = way[way.index(target):] + [target]
                found.append(f"{where}: closes a circle: " + " -> ".join(circle))
            elif target not in state:
                visit(target, way + [target])
        state[path] = "done"

    for path in sorted(graph):
        if path not in state:
            visit(path, [path])
    return found


def library_calls(root, path):
    """What is wrong with calls of one file, a line each."""
    for number, line in enumerate((root / path).read_text().splitlines(), 1):
        found = ELEMENTARY.search(line.split("//")[0])
        if found and path.startswith("core/"):
            yield f"{path}:{number}: has other bits on other machines; exact::{found.group(1)} has not"


def check(root):
    wrong, graph = [], {}
    for path in sources(root):
        wrong += library_calls(root, path)
        if room_of(path) is None:
            wrong.append(f"{path}:1: is in no room of tests/includes.py")
            continue
        for line, target in includes_of(root, path):
            fault = wrong_direction(path, line, target)
            if fault:
                wrong.append(fault)
            elif not (root / target).exists():
                wrong.append(f"{path}:{line}: there is no {target}")
            else:
                graph.setdefault(path, {})[target] = f"{path}:{line}"
    return wrong + cycles(graph)


# Trees of sources that break one rule each, and what must be said of them.
BAD_TREES = [
    (
        {"core/scene/a.cpp": '\n#include "core/plan/b.h"\n', "core/plan/b.h": ""},
        "core/scene/a.cpp:2: includes core/plan/b.h: core/plan comes after core/scene",
    ),
    (
        {"core/looks/a.h": "#include <core/formats/b.h>\n", "core/formats/b.h": ""},
        "core/looks/a.h:1: includes core/formats/b.h: core/formats comes after core/looks",
    ),
    (
        {"core/truth/a.h": '#include "core/light/b.h"\n', "core/light/b.h": ""},
        "core/truth/a.h:1: includes core/light/b.h: core/truth shares nothing with core/light",
    ),
    (
        {"core/generate/spheres/a.h": '#  include "core/generate/implicit/b.h"\n', "core/generate/implicit/b.h": ""},
        "core/generate/spheres/a.h:1: includes core/generate/implicit/b.h: "
        "core/generate/implicit and core/generate/spheres do not know each other",
    ),
    (
        {"core/sequence.cpp": '#include "core/pipeline.h"\n', "core/pipeline.h": ""},
        "core/sequence.cpp:1: includes core/pipeline.h: core/pipeline comes after core/sequence",
    ),
    (
        {
            "core/base/a.cpp": '#include "core/base/a.h"\n#include "core/base/b.h"\n',
            "core/base/a.h": '#include "core/base/b.h"\n',
            "core/base/b.h": '#include "core/base/c.h"\n',
            "core/base/c.h": '\n#include "core/base/a.h"\n',
        },
        "core/base/c.h:2: closes a circle: core/base/a.h -> core/base/b.h -> core/base/c.h "
        "-> core/base/a.h",
    ),
    (
        {"core/base/a.h": "// std::exp(x)\ndouble b = std::sqrt(std::log1p(2.0));\n"},
        "core/base/a.h:2: has other bits on other machines; exact::log1p has not",
    ),
    ({"core/attic/a.h": ""}, "core/attic/a.h:1: is in no room of tests/includes.py"),
    ({"core/base/a.h": '#include "core/base/b.h"\n'}, "core/base/a.h:1: there is no core/base/b.h"),
]
GOOD_TREE = {
    "core/scene/a.cpp": '#include <vector>\n#include "core/scene/a.h"\n#include "core/base/c.h"\n',
    "core/scene/a.h": "",
    "core/base/c.h": "",
    "core/sequence.h": '#include "core/scene/a.h"\ndouble b = exact::exp(std::sqrt(2.0));  // std::exp(x)\n',
}


def check_tree(tree):
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for path, text in tree.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text)
        return check(root)


def check_itself():
    """What this test fails to see of trees whose faults are known."""
    expected = [(tree, [fault]) for tree, fault in BAD_TREES] + [(GOOD_TREE, [])]
    faults = []
    for tree, said in expected:
        got = check_tree(tree)
        if got != said:
            faults.append(f"tests/includes.py: expected {said} of a planted tree, got {got}")
    return faults


if __name__ == "__main__":
    root = Path(sys.argv[1])
    files = sources(root)
    faults = check_itself() + check(root)
    if len(files) < 100:
        faults.append(f"{root}: only {len(files)} sources were found")
    for fault in faults:
        print(fault)
    print(f"{len(files)} sources, {len(faults)} faults")
    sys.exit(1 if faults else 0)
