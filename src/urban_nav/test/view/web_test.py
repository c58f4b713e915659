# SPDX-License-Identifier: BSD-3-Clause
"""The scripts of the page: their syntax, and the tests of those that need no browser. Skipped without node."""
import shutil
import subprocess
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCRIPTS = sorted((HERE.parents[1] / "web").glob("*.js"))
NODE = shutil.which("node") or shutil.which("nodejs")


@unittest.skipIf(NODE is None, "no nodejs here: the scripts of the page are not tested")
class Scripts(unittest.TestCase):
    def run_node(self, *words):
        done = subprocess.run([NODE, *map(str, words)], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_all_parse(self):
        self.assertGreater(len(SCRIPTS), 5)
        for script in SCRIPTS:
            with self.subTest(script.name):
                self.run_node("--check", script)

    def test_those_that_need_no_browser(self):
        self.run_node(HERE / "web_test.js")


class Markup(unittest.TestCase):
    def test_text_from_outside_never_becomes_markup(self):
        for script in SCRIPTS:
            text = script.read_text()
            for word in ("innerHTML", "outerHTML", "insertAdjacentHTML", "document.write", "eval(", "new Function"):
                self.assertNotIn(word, text, script.name)

    def test_nothing_is_loaded_from_elsewhere(self):
        for file in (HERE.parents[1] / "web").iterdir():
            for word in ("http://", "https://", "@import", "url("):
                self.assertNotIn(word, file.read_text(), file.name)


if __name__ == "__main__":
    import rosunit
    rosunit.unitrun("urban_nav", "view_web", "__main__")
