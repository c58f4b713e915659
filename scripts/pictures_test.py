#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of pictures.py: the check of the documents, and what it takes from pages and screens."""
import base64
import shutil
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
import screens  # noqa: E402  pylint: disable=wrong-import-position


def jpeg(image):
    return base64.b64encode(cv2.imencode(".jpg", image)[1]).decode()


class Documents(unittest.TestCase):
    """Pictures and documents of a small repository."""

    def setUp(self):
        self.root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        (self.root / "docs").mkdir()
        (self.root / "docs/map.png").write_bytes(b"picture")
        (self.root / "docs/data_flow.svg").write_bytes(b"<svg/>")
        (self.root / "README.md").write_text("![Map](docs/map.png)\n", encoding="utf-8")
        (self.root / "docs/page.md").write_text('<img width="5" src="data_flow.svg">\n', encoding="utf-8")

    def faults(self):
        subprocess.run(["git", "init", "-q"], cwd=self.root, check=True)
        subprocess.run(["git", "add", "."], cwd=self.root, check=True)
        return pictures.faults(self.root, ("map.png",))

    def test_nothing_is_wrong(self):
        self.assertEqual(self.faults(), [])

    def test_a_picture_that_is_not_there(self):
        (self.root / "docs/page.md").write_text("![Flow](data_flow.svg) ![Other](../docs/other.png)\n", encoding="utf-8")
        self.assertEqual(self.faults(), ["docs/page.md shows docs/other.png, which is not in the repository"])

    def test_a_picture_that_is_not_made_here(self):
        (self.root / "docs/other.jpg").write_bytes(b"picture")
        (self.root / "README.md").write_text("![Map](docs/map.png) ![Other](docs/other.jpg)\n", encoding="utf-8")
        self.assertEqual(self.faults(), ["docs/other.jpg is not made by scripts/pictures.py"])

    def test_a_picture_that_no_document_shows(self):
        (self.root / "README.md").write_text("[Map](docs/map.png)\n", encoding="utf-8")
        self.assertEqual(self.faults(), ["docs/map.png is shown by no document"])

    def test_a_large_picture(self):
        (self.root / "docs/map.png").write_bytes(bytes(pictures.LARGEST + 1))
        self.assertEqual(self.faults(), ["docs/map.png has 200001 bytes, more than 200000"])

    def test_the_repository(self):
        found = pictures.faults()
        if found is None:
            self.skipTest("no repository here")
        self.assertEqual(found, [])


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

    def test_a_large_picture_is_reduced(self):
        noise = np.random.default_rng(1).integers(0, 256, (400, 400, 3), np.uint8)
        content = pictures.encoded(".png", noise)
        self.assertLessEqual(len(content), pictures.LARGEST)
        height, width = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_COLOR).shape[:2]
        self.assertEqual(height, width)
        self.assertLess(width, 400)

    def test_the_screen_of_an_x_server_is_read(self):
        header = [100, 7, 2, 24, 3, 2, 0, 0, 32, 0, 32, 32, 16, 4, 0xFF0000, 0xFF00, 0xFF, 8, 0, 1, 3, 2, 0, 0, 0]
        line = bytes([1, 2, 3, 0] * 3 + [0] * 4)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "screen"
            path.write_bytes(struct.pack(">25I", *header) + bytes(12) + 2 * line)
            image = screens.framebuffer(path)
        self.assertEqual(image.shape, (2, 3, 3))
        self.assertEqual(image[1, 2].tolist(), [1, 2, 3])


class Needs(unittest.TestCase):
    def test_what_is_not_here_is_named(self):
        with self.assertRaisesRegex(screens.Missing, "Debian package surely"):
            screens.tool("surely-no-such-program", package="surely")
        with self.assertRaisesRegex(screens.Missing, "run_tests.sh --benches"):
            pictures.Programs(Path("none")).built("swf_vo", "swf_vo-bench-surely-none")


if __name__ == "__main__":
    unittest.main()
