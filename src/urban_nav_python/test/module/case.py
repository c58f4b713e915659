# SPDX-License-Identifier: BSD-3-Clause
"""Shared by the tests of the module: a temporary folder, and the program of the same space."""
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import urban_nav

PROGRAM = Path(urban_nav.__file__).parents[3] / "urban_nav" / "urban_nav"  # of the space that holds the module


class FolderCase(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def run_program(self, *words):
        """(exit status, text on the standard error) of the command."""
        done = subprocess.run([str(PROGRAM), *map(str, words)], capture_output=True, text=True, timeout=120)
        return done.returncode, done.stderr

    def fails(self, status, part, function, *arguments, **options):
        """The function raises Error with this status and a text that contains the part."""
        with self.assertRaises(urban_nav.Error) as caught:
            function(*arguments, **options)
        self.assertEqual(caught.exception.status, status)
        self.assertIn(part, str(caught.exception))
