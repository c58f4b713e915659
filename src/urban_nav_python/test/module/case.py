# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the module share: a folder that goes away, the program, the simulated drive, and a small bag."""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import urban_nav

PROGRAM = Path(urban_nav.__file__).parents[3] / "urban_nav" / "urban_nav"  # of the space that holds the module
sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "urban_nav" / "test" / "support"))


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


def stereo_bag(target, seconds=4):
    """A bag with the stereo pairs of the first seconds of the simulated drive."""
    import drive

    drive.cut(drive.record(PROGRAM), target, seconds, ["stereo"])
    return target


def rigid(x=0.0, y=0.0, yaw=0.0):
    """4 x 4: a translation (m) and a turn about z (rad)."""
    T = np.eye(4)
    T[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
    T[:2, 3] = x, y
    return T
