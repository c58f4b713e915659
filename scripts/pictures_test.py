#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of pictures.py: every picture of the documents has a recipe, and what it takes from pages and screens."""
import base64
import re
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import cv2
import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
import pictures  # noqa: E402  pylint: disable=wrong-import-position


def jpeg(image):
    return base64.b64encode(cv2.imencode(".jpg", image)[1]).decode()


class Recipes(unittest.TestCase):
    def tracked(self, *patterns):
        return subprocess.run(["git", "ls-files", *patterns], cwd=pictures.ROOT, capture_output=True, text=True, check=True).stdout.split()

    def test_there_is_one_for_every_picture_of_the_repository(self):
        found = self.tracked("*.png", "*.jpg", "*.jpeg", "*.svg", ":!src/urban_nav_input/test/corpus")  # hostile files are no pictures
        if not found:
            self.skipTest("no repository here")
        self.assertEqual(sorted(found), sorted([*(f"docs/{name}" for name in pictures.PICTURES), "docs/data_flow.svg"]))

    def test_every_picture_is_shown_by_a_document(self):
        text = "".join((pictures.ROOT / name).read_text(encoding="utf-8") for name in self.tracked("*.md"))
        if not text:
            self.skipTest("no repository here")
        shown = {Path(target).name for target in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", text)}
        self.assertEqual([name for name in pictures.PICTURES if name not in shown], [])


class Pages(unittest.TestCase):
    def test_pictures_of_a_section_come_with_their_captions(self):
        grey = np.full((4, 6, 3), 128, np.uint8)
        page = ('<section id="map"><figure><img src="data:image/jpeg;base64,%s"><figcaption>A &amp; B</figcaption></figure></section>'
                '<section id="none"></section>' % jpeg(grey))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "page.html"
            path.write_text(page, encoding="utf-8")
            report = pictures.Report(path)
        (caption, image), = report.pictures("map")
        self.assertEqual(caption, "A & B")
        self.assertEqual(image.shape, (4, 6, 3))
        for name in ("none", "absent"):
            with self.assertRaises(RuntimeError):
                report.pictures(name)


class Images(unittest.TestCase):
    def test_beside_keeps_proportions_at_the_lowest_height(self):
        row = pictures.beside([np.zeros((20, 30, 3), np.uint8), np.zeros((10, 10, 3), np.uint8)], gap=5)
        self.assertEqual(row.shape, (10, 15 + 5 + 10, 3))
        self.assertTrue((row[:, 15:20] == 255).all())

    def test_margins_are_cut_but_for_an_edge(self):
        image = np.full((100, 80, 3), 250, np.uint8)
        image[10, 20] = image[30, 2] = 0
        self.assertEqual(pictures.without_margin(image, edge=3).shape, (3 + 21 + 3, 2 + 19 + 3, 3))
        self.assertEqual(pictures.without_margin(np.zeros((4, 5, 3), np.uint8)).shape, (4, 5, 3))

    def test_the_screen_of_an_x_server_is_read(self):
        header = [100, 7, 2, 24, 3, 2, 0, 0, 32, 0, 32, 32, 16, 4, 0xFF0000, 0xFF00, 0xFF, 8, 0, 1, 3, 2, 0, 0, 0]
        line = bytes([1, 2, 3, 0] * 3 + [0] * 4)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "screen"
            path.write_bytes(struct.pack(">25I", *header) + bytes(12) + 2 * line)
            image = pictures.framebuffer(path)
        self.assertEqual(image.shape, (2, 3, 3))
        self.assertEqual(image[1, 2].tolist(), [1, 2, 3])


class Needs(unittest.TestCase):
    def test_what_is_not_here_is_named(self):
        with self.assertRaisesRegex(pictures.Missing, "Debian package surely"):
            pictures.tool("surely-no-such-program", package="surely")
        with self.assertRaisesRegex(pictures.Missing, "run_tests.sh --benches"):
            pictures.built("swf_vo", "swf_vo-bench-surely-none")


if __name__ == "__main__":
    unittest.main()
