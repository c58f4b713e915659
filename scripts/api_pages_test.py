#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of api_pages.py: what is a defect of a header, and which changes concern the pages."""
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import api_pages

HEADER = """#pragma once
namespace a {{
{before}
struct Pose {{
  double x = 0.0;  ///< m
  double plain = 0.0;
  struct Options {{
    int count = 0;
  }};
}};
}}  // namespace a
"""


@unittest.skipUnless(shutil.which("doxygen"), "no doxygen here")
class Headers(unittest.TestCase):
    def defects(self, before):
        root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, root)
        (root / "src/a/include/a").mkdir(parents=True)
        (root / "docs").mkdir()
        shutil.copy(api_pages.ROOT / "docs/Doxyfile", root / "docs")
        (root / "docs/api.dox").write_text("/** @namespace a\nPoses. */\n", encoding="utf-8")
        (root / "src/a/include/a/pose.hpp").write_text(HEADER.format(before=before), encoding="utf-8")
        return api_pages.make(root)

    def test_members_and_nested_types_need_no_comment(self):
        self.assertEqual(self.defects("/// A pose."), [])

    def test_a_type_needs_one(self):
        defect, = self.defects("")
        self.assertRegex(defect, r"^src/a/include/a/pose\.hpp:\d+: .*a::Pose is not documented")

    def test_an_enumeration_needs_one(self):
        defect, = self.defects("enum class Kind { A, B };\n/// A pose.")
        self.assertIn("Kind (enumeration)", defect)

    def test_unknown_commands_tags_and_parameters(self):
        for comment, what in ((r"/// Ends at \r.", "unknown command"), ("/// Publishes <stage>/status.", "tag <stage>"),
                              ("/// @param y none\nvoid f(int x);\n/// A pose.", "argument 'y'"), ("/// As @ref Nothing.", "Nothing")):
            with self.subTest(comment):
                self.assertIn(what, "\n".join(self.defects(comment + "\n/// A pose." if "f(" not in comment else comment)))


class Changes(unittest.TestCase):
    def test_public_headers_and_what_configures_the_pages(self):
        for path in ("swf_vo/include/swf_vo/frame.hpp", "src/urban_nav_core/include/urban_nav_core/io/numbers.hpp", "docs/Doxyfile", "docs/api.dox"):
            self.assertTrue(api_pages.SOURCES.fullmatch(path), path)
        for path in ("swf_vo/src/window.hpp", "swf_vo/src/swf_vo.cpp", "docs/files.md", "README.md"):
            self.assertFalse(api_pages.SOURCES.fullmatch(path), path)

    def test_since_the_last_commit_nothing_differs_before_a_change(self):
        root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, root)

        def git(*words):
            subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", *words], cwd=root, check=True, capture_output=True)

        header = root / "a/include/a.hpp"
        header.parent.mkdir(parents=True)
        header.write_text("#pragma once\n", encoding="utf-8")
        git("init", "-q")
        git("add", ".")
        git("commit", "-q", "-m", "a")
        (root / "b.cpp").write_text("int b;\n", encoding="utf-8")
        self.assertFalse(api_pages.differs(root, "HEAD"))
        header.write_text("#pragma once\nint a();\n", encoding="utf-8")
        self.assertTrue(api_pages.differs(root, "HEAD"))
        self.assertTrue(api_pages.differs(root, "0123456789" * 4))  # in no clone


if __name__ == "__main__":
    unittest.main()
