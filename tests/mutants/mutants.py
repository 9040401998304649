#!/usr/bin/env python3
"""Plants small bugs one at a time in a copy of the tree and says which of them the tests let live.

    python3 tests/mutants/mutants.py                     all of table.py; half an hour or so
    python3 tests/mutants/mutants.py spheres albedo      those whose name or room has one of these words
    python3 tests/mutants/mutants.py --check             only whether each still has its place in the tree

A suite that passes says little about what it would have caught. Each row of table.py is a slip that a tired
programmer makes: a sign, a factor, an axis, a bound, a key that was forgotten. It names the tests that ought to fail;
"quick" stands for all tests with that label. What survives is a law that no test states: write that test (a truth about
the thing, not the bytes it gives today), or say in the row why it cannot matter. Warnings are errors here as they are in
CI: what the compiler sees by itself is no mutant.

Exit code 0: every mutant has its place, builds, and is caught or explained. Needs Python 3.11, CMake, and what the
build needs; nothing else. Edits nothing but its copy, which is deleted unless --copy names where it is to stay.
"""
import argparse
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from table import MUTANTS  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = {".cpp", ".h", ".glsl", ".js"}
TEST_SECONDS = 240  # a mutant that makes a test run for ever is caught


def files_of_tree():
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout
    return [name for name in listed.split("\0") if name and (ROOT / name).is_file()]


def place_of(mutant, names):
    """The file that has the mutant's text exactly once: its own, or, if that was moved, the only other one.
    (None, why) where there is none."""
    def times(name):
        path = ROOT / name
        return path.read_text(encoding="utf-8").count(mutant.text) if path.is_file() else 0

    if times(mutant.file) == 1:
        return mutant.file, ""
    if times(mutant.file) > 1:
        return None, f"stands {times(mutant.file)} times in {mutant.file}"
    elsewhere = [name for name in names if name.startswith(("core/", "server/", "web/"))
                 and pathlib.PurePath(name).suffix in SOURCES and times(name) > 0]
    if len(elsewhere) == 1 and times(elsewhere[0]) == 1:
        return elsewhere[0], ""
    return None, f"is no longer in {mutant.file}, and {len(elsewhere)} other files have it"


def copy_tree(names, to):
    for name in names:
        target = to / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if not target.is_file() or target.read_bytes() != (ROOT / name).read_bytes():
            shutil.copyfile(ROOT / name, target)


class Copy:
    """A copy of the tree with a build of its own. `before`: words put before every command."""

    def __init__(self, folder, before, jobs):
        self.folder, self.before, self.jobs = folder, before, jobs
        self.build = folder / "build/mutants"

    def run(self, command, seconds=None):
        """Exit code and output; a command that takes too long has failed."""
        try:
            # Waiting for its turn does not count: `timeout` stands behind `before`.
            limit = ["timeout", "--kill-after=5", str(seconds)] if seconds else []
            done = subprocess.run(self.before + limit + command, cwd=self.folder, text=True, errors="replace",
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        except OSError as error:
            return 127, str(error)
        return done.returncode, done.stdout

    def configure(self):
        return self.run(["cmake", "-S", ".", "-B", str(self.build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                         "-DAWAN_TESTS=ON", "-DAWAN_WERROR=ON"])

    def make(self, tests):
        targets = sorted({"awan" if test.name.endswith(".sh") else "all" if test.name == "quick" else test.name
                          for test in tests})
        return self.run(["cmake", "--build", str(self.build), "-j", str(self.jobs), "--target", *targets])

    def fails(self, test):
        if test.name == "quick":
            command = ["ctest", "--test-dir", str(self.build), "-L", "quick", "--stop-on-failure"]
            return self.run(command, 4 * TEST_SECONDS)[0] != 0
        if test.name.endswith(".sh"):
            return self.run(["bash", f"tests/{test.name}", str(self.build / "awan")], TEST_SECONDS)[0] != 0
        command = [str(self.build / "tests" / test.name), "--gtest_brief=1"]
        if test.filter:
            command.append(f"--gtest_filter={test.filter}")
        code, output = self.run(command, TEST_SECONDS)
        return code != 0 or "0 tests from 0 test suites" in output


class Test:
    """"name" or "name:filter", the filter as gtest has it."""

    def __init__(self, words):
        self.words = words
        self.name, _, self.filter = words.partition(":")


def tests_of(mutant):
    return [Test(words) for words in (mutant.tests or ["quick"])]


def row(columns):
    print("| " + " | ".join(columns) + " |", flush=True)


def try_one(copy, mutant, file):
    """What became of it, and by what."""
    path = copy.folder / file
    whole = path.read_text(encoding="utf-8")
    path.write_text(whole.replace(mutant.text, mutant.instead), encoding="utf-8")
    try:
        tests = tests_of(mutant)
        code, output = copy.make(tests)
        if code != 0:
            print(output[-3000:], file=sys.stderr)
            return "does not build"
        for test in tests:
            if copy.fails(test):
                return "caught by " + test.words
        return "SURVIVED" if not mutant.explained else "survived: " + mutant.explained
    finally:
        path.write_text(whole, encoding="utf-8")


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("only", nargs="*", help="words of names or rooms")
    words.add_argument("--check", action="store_true", help="only look whether each has its place")
    words.add_argument("--copy", type=pathlib.Path, help="where the copy stands, and stays for the next time")
    words.add_argument("--before", default="", help="put before every command, such as \"nice -n 19\"")
    words.add_argument("--jobs", type=int, default=2, help="of the build")
    asked = words.parse_args()

    names = files_of_tree()
    chosen = [m for m in MUTANTS if not asked.only or any(w in m.name or w == m.room for w in asked.only)]
    lost, placed = [], []
    for mutant in chosen:
        file, why = place_of(mutant, names)
        if file is None:
            print(f"{mutant.name}: its text {why}: {mutant.text}")
            lost.append(mutant)
        else:
            placed.append((mutant, file))
    if asked.check or not placed:
        print(f"{len(placed)} of {len(chosen)} mutants have their place")
        return 1 if lost or not placed else 0

    folder = asked.copy or pathlib.Path(tempfile.mkdtemp(prefix="mutants."))
    try:
        copy_tree(names, folder)
        copy = Copy(folder, shlex.split(asked.before), asked.jobs)
        tests = {test.words: test for mutant, _ in placed for test in tests_of(mutant)}
        for code, output in (copy.configure(), copy.make(tests.values())):
            if code != 0:
                print(output[-5000:], file=sys.stderr)
                return 1
        # What fails without any bug catches nothing.
        broken = [words for words, test in tests.items() if copy.fails(test)]
        if broken:
            print("These fail as they are: " + ", ".join(broken), file=sys.stderr)
            return 1

        row(["mutant", "room", "file", "outcome", "seconds"])
        row(["---"] * 5)
        outcomes = []
        for mutant, file in placed:
            start = time.monotonic()
            outcome = try_one(copy, mutant, file)
            outcomes.append((mutant, outcome))
            row([mutant.name, mutant.room, file, outcome, f"{time.monotonic() - start:.0f}"])
    finally:
        if asked.copy is None:
            shutil.rmtree(folder, ignore_errors=True)

    caught = sum(outcome.startswith("caught") for _, outcome in outcomes)
    print(f"\n{caught} of {len(chosen)} mutants were caught.")
    for mutant, outcome in outcomes:
        if not outcome.startswith("caught"):
            print(f"  {mutant.name}: {outcome} ({mutant.why})")
    for mutant in lost:
        print(f"  {mutant.name}: has no place any more")
    unexplained = any(o == "SURVIVED" or o == "does not build" for _, o in outcomes)
    return 1 if unexplained or lost else 0


if __name__ == "__main__":
    sys.exit(main())
