#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Which files are counted for which package, and what is said of the sums."""
import unittest

import coverage


def file(name, lines=(0, 0), branches=(0, 0)):
    return {"filename": name, "line_covered": lines[0], "line_total": lines[1], "branch_covered": branches[0], "branch_total": branches[1]}


class Coverage(unittest.TestCase):
    def test_libraries_are_counted_and_tests_and_nodelets_are_not(self):
        counted = {"swf_vo/src/window/window.cpp": "swf_vo", "src/urban_nav_core/include/urban_nav_core/types/error.hpp": "urban_nav_core",
                   "swf_vo/nodelet/swf_vo_nodelet.cpp": None, "src/urban_nav_input/testing/folders.hpp": None,
                   "src/urban_nav_core/test/io/test.cpp": None, "build/ws/devel/include/urban_nav_msgs/Trust.h": None}
        self.assertEqual({name: coverage.package_of(name) for name in counted}, counted)

    def test_files_of_a_package_add_up(self):
        counted = coverage.sums([file("swf_vo/src/a.cpp", (8, 10), (1, 4)), file("swf_vo/src/b.cpp", (1, 10), (0, 0)),
                                 file("build/ws/src/urban_nav/swf_vo/src/a.cpp", (2, 10), (0, 4)),
                                 file("swf_vo/test/a_test.cpp", (10, 10), (4, 4))])
        self.assertEqual(counted, {"swf_vo": [9, 20, 1, 4]})
        lines = coverage.table(counted).splitlines()
        self.assertIn("45.0", lines[1])
        self.assertIn("below the goal", lines[1])
        self.assertTrue(lines[-1].startswith("all"))


if __name__ == "__main__":
    unittest.main()
