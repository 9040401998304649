#!/usr/bin/env bash
# Prose that is checked by machine. Names every offender as file:line.
#   bash tests/prose_test.sh
# * Lines of comments and code are at most 120 columns long (C++ and shaders; raw strings and the fitted tables aside).
# * Comments stand above what they explain, not behind it.
# * Sources are cited as "Author year", by the bibliography of core/README.md, and by nothing that a reader cannot find.
# * Files and folders named in core/README.md and README.md exist.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit 1
python3 - <<'PYTHON'
import fnmatch
import os
import re
import sys

offenders = []


def offend(path, line, what):
    offenders.append((path, line, what))


def files(folders, endings):
    for folder in folders:
        for at, inside, names in os.walk(folder):
            inside[:] = sorted(name for name in inside if name not in ("node_modules", "build"))
            for name in sorted(names):
                if name.endswith(endings):
                    yield os.path.join(at, name)


CODE = (".h", ".cpp", ".glsl")
SELF = "tests/prose_test.sh"
LONGEST = 120

# --- Lines.
for path in files(["core", "server", "tests"], CODE):
    with open(path, encoding="utf-8") as file:
        lines = file.read().split("\n")
    raw = False  # in a raw string: data, not code
    for number, line in enumerate(lines, 1):
        was_raw = raw
        if not raw and re.search(r'R"\w*\((?!.*\)\w*")', line):
            raw = True
        elif raw and re.search(r'\)\w*"', line):
            raw = False
        if was_raw or raw or path.endswith(("forecast_errors.h", "forecast_times.h")):
            continue
        if len(line) > LONGEST and not re.fullmatch(r"\s*(//)?\s*\S+", line):
            offend(path, number, f"{len(line)} columns, over {LONGEST}")

# --- Comments stand above what they explain. Rooms that do not keep to it yet are not in the list.
ABOVE = ["core/base", "core/formats", "core/generate", "core/gl", "core/looks", "core/shaders", "server/cli", "server/http",
         "server/service"]
BEHIND = re.compile(r'''^(?:[^"'/]|"(?:[^"\\]|\\.)*"|(?<=\w)'|'(?:[^'\\]|\\.)*'|/(?!/))*''')
for path in files(ABOVE, CODE):
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            code = BEHIND.match(line.rstrip("\n")).group(0)
            behind = line.rstrip("\n")[len(code):]
            if behind.startswith("// NOLINT"):
                continue  # for clang-tidy, which wants it there
            if behind.startswith("//") and code.strip() and not re.fullmatch(r"\s*}+\s*|#.*", code):
                offend(path, number, "a comment behind code; it belongs above")

# --- Words for what a reader cannot find. A scene is a document too; that word alone is no offence.
HIDDEN = re.compile(r"\b[Dd]ocuments? 00\d\b|\b(?:PHYSICS|MODELS|DESIGN|PLATFORM|API)(?:\.md)?\b(?! *[=_(])")
for path in files(["core", "server", "web", "tests"], CODE + (".js", ".mjs", ".py", ".sh", ".md", ".json", ".html")):
    if path == SELF or (path.startswith("web/presets/") and path.endswith(".json")):
        continue
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            found = HIDDEN.search(line)
            if found and re.match(r"(?:API|MODELS|PLATFORM|DESIGN)$", found.group(0)) and not re.search(r"//|\* |#", line):
                continue  # a constant of that name
            if found:
                offend(path, number, f'"{found.group(0)}" cannot be found by a reader; cite "Author year"')

# --- Citations. The first author's surname and the year must stand in the bibliography.
with open("core/README.md", encoding="utf-8") as file:
    house = file.read()
entries = {(m.group(1), m.group(2)) for m in re.finditer(r"^\* \*\*([\w'-]+)[^*]*? (\d{4})\*\*", house, re.M)}
YEAR = r"(?:1[789]\d\d|20\d\d)"
CITED = re.compile(
    r"\b([A-Z][\w'-]+)(?:,? (?:[A-Z][\w'-]+|et al\.|&|and))*?,?(?:'s?)? \(?(" + YEAR + r")\b(?! ?(?:x|cells|pixels|steps|particles|rays|units))")
MONTHS = "January February March April May June July August September October November December".split()
COMMENT = re.compile(r"^\s*(?://+|\*|#)(.*)$|//(.*)$")
for path in files(["core"], CODE + (".md",)):
    with open(path, encoding="utf-8") as file:
        lines = file.read().split("\n")
    text, at = "", []  # all comments, so that a citation may be broken over two lines
    for number, line in enumerate(lines, 1):
        if path.endswith(".md"):
            piece = "" if line.startswith("* **") or line.startswith("  ") else line
        else:
            found = COMMENT.search(line)
            piece = (found.group(1) or found.group(2) or "") if found else "\n"
        text += piece.strip(" ") + " "
        at += [number] * (len(piece.strip(" ")) + 1)
    for found in CITED.finditer(text):
        author, year = re.sub(r"'s?$", "", found.group(1)), found.group(2)
        if author in MONTHS or (author, year) in entries:
            continue
        # Two or three authors: any of their surnames before the year may be the first.
        names = re.findall(r"[A-Z][\w'-]+", found.group(0))
        if any((name, year) in entries for name in names):
            continue
        offend(path, at[found.start()], f'"{found.group(0)}" is not in the bibliography of core/README.md')

# --- Files named in the two pages. A worked example invents its own: `plume`, `.vtp`.
known = []
for at, inside, names in os.walk("."):
    inside[:] = [name for name in inside if name not in (".git", "build", "node_modules")]
    known += ["/" + os.path.normpath(os.path.join(at, name)) for name in names]
    known += ["/" + os.path.normpath(os.path.join(at, name)) + end for name in inside for end in ("", "/")]
for path in ("core/README.md", "README.md"):
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            for code, link in re.findall(r"`([\w./*-]+)`|\]\(([\w./-]+)[)#]", line):
                name = link or code
                if re.search(r"plume|vtp|^\.", name) and not link:
                    continue
                if not link and not re.search(r"/|\.(?:h|cpp|md|sh|py|js|json|glsl|mjs|png)$", name):
                    continue  # a word of the document or of the code
                if name.startswith(("/", "build/")):
                    continue  # a route of the service, a path of the build
                if link:
                    name = os.path.normpath(os.path.join(os.path.dirname(path), link))
                if not any(fnmatch.fnmatch(one, "*/" + name) for one in known):
                    offend(path, number, f"{name} does not exist")

for path, line, what in offenders:
    print(f"{path}:{line}: {what}")
if offenders:
    print(f"{len(offenders)} offenders", file=sys.stderr)
sys.exit(1 if offenders else 0)
PYTHON
