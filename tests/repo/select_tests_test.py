#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""select_tests_test.py TESTS: tests of select_tests.py, the last with the list that CMake wrote."""
import pathlib
import sys
import unittest

import select_tests
from select_tests import Rooms, read_tests, select

ROOMS = Rooms(
    [
        "room engine/core limn_core",
        "room engine/scene limn_scene",
        "room engine/render limn_render",
        "room engine/render/deep limn_deep",
        "room app limn_app",
        "reach limn_scene limn_core",
        "reach limn_render limn_scene",
        "reach limn_render limn_core",
        "reach limn_app limn_render",
        "reach limn_app limn_scene",
        "reach limn_app limn_core",
    ],
    {"engine/render/CMakeLists.txt": "limn_shaders(limn_render viewport/sky.frag)"},
)
TESTS = read_tests(
    "core_a core_tests limn_core\n"
    "scene_a scene_tests limn_scene\n"
    "render_a render_tests limn_render\n"
    "deep_a render_deep_tests limn_deep\n"
    "app_a app_tests limn_json the_program\n"
    "library the_program limn_app\n"
    "fuzz_scene fuzz_scene limn_scene\n"
)


def concerned(*changed, includers=frozenset()):
    return select(TESTS, ROOMS, changed, set(includers), 0)[0]


class SelectTests(unittest.TestCase):
    def test_a_changed_room_takes_the_rooms_above_it_along(self):
        self.assertEqual(concerned("engine/scene/light/light.cpp"), ["app_tests", "fuzz_scene", "render_tests", "scene_tests"])
        self.assertEqual(concerned("app/main.cpp"), ["app_tests"])

    def test_a_file_belongs_to_the_innermost_room(self):
        self.assertEqual(concerned("engine/render/deep/a.h"), ["render_deep_tests"])

    def test_a_shader_belongs_to_the_room_that_compiles_it(self):
        self.assertEqual(concerned("shaders/viewport/sky.frag"), ["app_tests", "render_tests"])
        self.assertEqual(concerned("shaders/shared/gpu_light.h"), ["app_tests", "render_tests"])

    def test_a_changed_test_takes_its_program_along(self):
        self.assertEqual(concerned("tests/render/deep/a_test.cpp"), ["render_deep_tests"])
        self.assertEqual(concerned("tests/golden/a.h", includers={"tests/core"}), ["core_tests"])

    def test_pages_concern_no_program(self):
        self.assertEqual(concerned("README.md", "docs/testing.md"), [])

    def test_ten_consecutive_commits_cover_every_program(self):
        for first in (0, 7, 1234):
            for tests in (TESTS, read_tests(pathlib.Path(LIST).read_text())):
                everything = {program for program, _ in tests.values()}
                covered = set()
                for number in range(first, first + select_tests.SHARES):
                    some, turn = select(tests, ROOMS, [], set(), number)
                    self.assertFalse(covered & set(turn), "one program has two turns")
                    covered |= set(some) | set(turn)
                self.assertEqual(covered, everything)


if __name__ == "__main__":
    LIST = sys.argv.pop(1)
    unittest.main()
