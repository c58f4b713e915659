#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the wheel: its table, and the search path of its libraries."""
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

sys.path.insert(0, str(Path(__file__).parent))
import python_wheel  # noqa: E402  pylint: disable=wrong-import-position


class Wheel(unittest.TestCase):
    def test_every_file_is_in_the_table(self):
        files = {"urban_nav/a.py": b"x = 1\n", "urban_nav/lib/b.so": b"\x7fELF"}
        with tempfile.TemporaryDirectory() as folder:
            name = python_wheel.write_wheel(folder, files)
            again = (Path(folder) / name).read_bytes()
            self.assertEqual(python_wheel.write_wheel(folder, files), name)
            self.assertEqual((Path(folder) / name).read_bytes(), again)
            with zipfile.ZipFile(Path(folder) / name) as archive:
                self.assertEqual({path: archive.read(path) for path in files}, files)
                table = archive.read([path for path in archive.namelist() if path.endswith("RECORD")][0]).decode()
        self.assertIn("urban_nav/a.py,sha256=nia_NpkRxFwkPGhBR7I_yeHc_PJX0pmhxjIBam_NM_Q,6\n", table)
        self.assertEqual(len(table.splitlines()), 3)

    def relocate(self, content, runpath):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.so"
            path.write_bytes(content)
            output = f" 0x1d (RUNPATH)            Library runpath: [{runpath}]\n"
            with mock.patch.object(python_wheel.subprocess, "run", return_value=SimpleNamespace(stdout=output)):
                return python_wheel.relocated(path)

    def test_libraries_are_found_beside_the_module(self):
        moved = self.relocate(b"head\0/home/somebody/build/ws/devel/lib\0tail", "/home/somebody/build/ws/devel/lib")
        self.assertEqual(len(moved), len(b"head\0/home/somebody/build/ws/devel/lib\0tail"))
        self.assertIn(b"\0$ORIGIN:$ORIGIN/lib\0", moved)
        self.assertNotIn(b"somebody", moved)
        with self.assertRaisesRegex(RuntimeError, "leaves no room"):
            self.relocate(b"\0/a\0", "/a")


if __name__ == "__main__":
    unittest.main()
