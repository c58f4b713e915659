# SPDX-License-Identifier: BSD-3-Clause
"""MCAP files of the suite, read by the libraries of Foxglove: checksums, index, and every message by its own schema."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import urban_nav

sys.path.insert(0, str(Path(__file__).resolve().parent))
from case import FolderCase, stereo_bag  # noqa: E402

HERE = Path(__file__).resolve().parent
LIBRARIES = ["@mcap/core@2", "@mcap/support@1", "@foxglove/rosmsg@5", "@foxglove/rosmsg2-serialization@3"]


def install():
    """A folder with the libraries, kept for the next test; skips the tests where npm cannot install them."""
    folder = Path(tempfile.gettempdir()) / f"urban_nav-npm-{os.getuid()}"
    if not (folder / "node_modules" / "@mcap" / "core").exists():
        folder.mkdir(exist_ok=True)
        command = ["npm", "install", "--prefix", str(folder), "--no-audit", "--no-fund", "--silent", *LIBRARIES]
        try:
            subprocess.run(command, cwd=folder, timeout=180, check=True, capture_output=True)
        except (OSError, subprocess.SubprocessError) as error:
            raise unittest.SkipTest(f"npm cannot install {', '.join(LIBRARIES)}: {error}")
    return folder


class IndependentReader(FolderCase):
    @classmethod
    def setUpClass(cls):
        cls.libraries = install()

    def read(self, path):
        script = self.libraries / "read_mcap.mjs"
        shutil.copy(HERE / script.name, script)  # node searches the folder of the script for libraries
        done = subprocess.run(["node", str(script), str(path)], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def check(self, path):
        """Returns the types in a file whose messages are all read without an error."""
        found = self.read(path)
        self.assertEqual(found["errors"], [])
        expected = sum(topic.messages for topic in urban_nav.Recording(path).topics.values())
        self.assertGreater(expected, 100)
        self.assertEqual((found["messages"], found["by_index"]), (expected, expected))
        return found["types"]

    def test_recordings_and_results_are_read_without_an_error(self):
        bag, recording, results = stereo_bag(self.folder / "drive.bag"), self.folder / "drive.mcap", self.folder / "results.mcap"
        status, text = self.run_program("convert", bag, "-o", recording)
        self.assertEqual(status, 0, text)
        self.assertIn("sensor_msgs/msg/Image", self.check(recording))
        urban_nav.map(recording, self.folder / "out", stages="vo", mcap=results)
        types = self.check(results)
        for name in ("nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage", "nav_msgs/msg/Path", "diagnostic_msgs/msg/DiagnosticArray"):
            self.assertIn(name, types)
        damaged = bytearray(recording.read_bytes())
        damaged[len(damaged) // 2] ^= 0xFF
        recording.write_bytes(damaged)
        self.assertNotEqual(self.read(recording)["errors"], [])


if __name__ == "__main__":
    import rosunit
    rosunit.unitrun("urban_nav_python", "independent_reader", "__main__")
