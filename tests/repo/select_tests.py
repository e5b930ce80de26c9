#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""select_tests.py TESTS COMMIT: which test programs ./check runs under the sanitizers.

TESTS is the list that CMake writes, build/PRESET/tests.txt: a line for each test with its name, the program that must be
built for it, and the libraries that it tests; and lines "library NAME PART..." for libraries that are no room. Selected are the programs that test a room whose files changed since COMMIT,
or a room above it, and of all others every tenth, a different tenth at each commit. Prints "programs NAME...",
"tests REGULAR-EXPRESSION" and lines of "# text" for people.
"""
import pathlib
import re
import subprocess
import sys

SHARES = 10
SCRIPT = "tests/repo/repository_test.sh"
CODE = re.compile(r"\.(cpp|h|in|glsl|vert|frag|comp|gltf|bin|limn|png|js|py|sh)$")


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def changed_since(commit):
    """Files that differ from the commit's, those that git does not know yet among them."""
    tracked = run("git", "diff", "--name-only", "--no-renames", commit)
    new = run("git", "ls-files", "--others", "--exclude-standard")
    return sorted(file for file in (tracked + new).splitlines() if CODE.search(file))


class Rooms:
    """The rooms as CMake's lists declare them."""

    def __init__(self, lines, cmake_lists):
        self.target_of = {}  # folder -> target
        self.below = {}  # target -> targets that it reaches, itself among them
        for line in lines:
            kind, *words = line.split()
            if kind == "room":
                self.target_of[words[0]] = words[1]
                self.below.setdefault(words[1], set()).add(words[1])
            elif kind == "reach":
                self.below.setdefault(words[0], set()).add(words[1])
        self.shaders_of = {}  # target -> text that names its shaders
        for path, text in cmake_lists.items():
            folder = str(pathlib.PurePath(path).parent)
            if "limn_shaders(" in text and folder in self.target_of:
                self.shaders_of[self.target_of[folder]] = text

    def of_file(self, file):
        """Targets that the file is part of; none if it belongs to no room."""
        if file.startswith("shaders/"):
            name = file.removeprefix("shaders/")
            return {t for t, text in self.shaders_of.items() if name.startswith("shared/") or name in text} or set(
                self.shaders_of
            )
        if file.startswith(("resources/", "projects/")):
            return {"limn_app"}
        folder = pathlib.PurePath(file).parent
        while str(folder) != ".":
            if str(folder) in self.target_of:
                return {self.target_of[str(folder)]}
            folder = folder.parent
        return set()


def select(tests, rooms, changed, includers, share):
    """Programs of `tests`, {name: (program, libraries)}, in two sorted lists: those that test what changed, and those of
    the others whose turn it is. `includers`: for a changed file below tests/, the folders that include it."""
    touched = set().union(*(rooms.of_file(file) for file in changed)) if changed else set()
    folders = {str(pathlib.PurePath(file).parent) for file in changed if file.startswith("tests/")} | includers
    prefixes = {folder.removeprefix("tests/").replace("/", "_") for folder in folders}
    concerned = set()
    for program, libraries in tests.values():
        below = set().union(*(rooms.below.get(library, {library}) for library in libraries)) if libraries else set()
        if below & touched or program.removesuffix("_tests") in prefixes or program in prefixes:
            concerned.add(program)
    programs = sorted({program for program, _ in tests.values()})
    turn = [p for i, p in enumerate(programs) if i % SHARES == share % SHARES and p not in concerned]
    return sorted(concerned), turn


def read_tests(text):
    """{name: (program, libraries)}, where the parts of libraries that are no room are added."""
    lines = [line.split() for line in text.splitlines()]
    parts = {line[1]: line[2:] for line in lines if line[0] == "library"}

    def rooms(libraries):
        return [room for library in libraries for room in [library, *rooms(parts.get(library, []))]]

    return {name: (program, rooms(libraries)) for name, program, *libraries in lines if name != "library"}


def including_folders(changed):
    headers = [file for file in changed if file.startswith("tests/") and file.endswith(".h")]
    found = set()
    for header in headers:
        result = subprocess.run(["git", "grep", "-l", f'#include "{header}"', "--", "tests"], capture_output=True, text=True)
        found |= {str(pathlib.PurePath(file).parent) for file in result.stdout.splitlines()}
    return found


def main(tests_file, commit):
    tests = read_tests(pathlib.Path(tests_file).read_text())
    lists = {path: pathlib.Path(path).read_text() for path in run("git", "ls-files", "*CMakeLists.txt").splitlines()}
    rooms = Rooms(run(SCRIPT, "rooms_and_reach").splitlines(), lists)
    changed = changed_since(commit)
    share = int(run("git", "rev-list", "--count", "HEAD"))
    concerned, turn = select(tests, rooms, changed, including_folders(changed), share)
    chosen = set(concerned) | set(turn)
    names = sorted(name for name, (program, _) in tests.items() if program in chosen)
    left_out = sorted({program for program, _ in tests.values()} - chosen)
    touched = sorted(set().union(*(rooms.of_file(file) for file in changed)) if changed else set())
    print("programs", *sorted(chosen))
    print("tests", "^(" + "|".join(names) + ")$")
    print(f"# {len(changed)} files changed since {commit[:12]}, of", ", ".join(t.removeprefix("limn_") for t in touched) or "no room")
    print(f"# these and the rooms above them are tested by {len(concerned)} of {len(concerned) + len(turn) + len(left_out)} programs")
    print(f"# share {share % SHARES} of {SHARES} of the others:", ", ".join(turn) or "none")
    print("# left out:", ", ".join(left_out) or "nothing")


if __name__ == "__main__":
    main(*sys.argv[1:])
