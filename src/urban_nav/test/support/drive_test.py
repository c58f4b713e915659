# SPDX-License-Identifier: BSD-3-Clause
"""The shared drive is recorded once for each build of the program, and cut as each test needs it."""
import shutil
import sys
import tempfile
import threading
import unittest
from pathlib import Path

import rosbag
import rospy
from sensor_msgs.msg import Imu, NavSatFix
from tf2_msgs.msg import TFMessage

sys.path.insert(0, str(Path(__file__).resolve().parent))
import drive  # noqa: E402

PROGRAM = """#!/bin/sh
echo "$*" >>"$(dirname "$0")/calls"
sleep 0.3
for output; do :; done
echo bag >"$output"
"""


class Record(unittest.TestCase):
    def setUp(self):
        self.devel = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.devel)
        self.program = self.devel / "lib" / "urban_nav" / "urban_nav"
        self.program.parent.mkdir(parents=True)
        self.write(PROGRAM)

    def write(self, text):
        self.program.write_text(text)
        self.program.chmod(0o755)

    def calls(self):
        return (self.program.parent / "calls").read_text().splitlines()

    def test_is_made_once_for_each_build_of_the_program(self):
        first = drive.record(self.program)
        self.assertEqual(first.read_text(), "bag\n")
        self.assertEqual(drive.record(self.program), first)
        self.assertEqual(len(self.calls()), 1)
        self.assertIn(f"simulate --seed 5 --duration {drive.SECONDS} --views lasers -o ", self.calls()[0])
        self.write(PROGRAM + "# other\n")
        second = drive.record(self.program)
        self.assertNotEqual(second, first)
        self.assertEqual(len(self.calls()), 2)
        self.assertFalse(first.exists(), "the drive of a program that is gone")

    def test_is_made_once_for_tests_at_the_same_time(self):
        paths = []
        threads = [threading.Thread(target=lambda: paths.append(drive.record(self.program))) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(paths), 3)
        self.assertEqual(len(set(paths)), 1)
        self.assertEqual(len(self.calls()), 1)

    def test_of_a_program_that_fails_nothing_is_kept(self):
        self.write("#!/bin/sh\necho no world\nexit 1\n")
        with self.assertRaisesRegex(RuntimeError, "no world"):
            drive.record(self.program)
        self.write(PROGRAM)
        self.assertEqual(drive.record(self.program).read_text(), "bag\n")


class Cut(unittest.TestCase):
    def test_keeps_the_sensors_and_the_seconds_that_are_wanted(self):
        folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        with rosbag.Bag(str(folder / "drive.bag"), "w") as bag:
            bag.write("/tf_static", TFMessage(), rospy.Time(100))
            for i in range(40):
                stamp = rospy.Time(100 + i // 10, 10**8 * (i % 10))
                bag.write("/imu/data", Imu(), stamp)
                bag.write("/gps/fix", NavSatFix(), stamp)
        truth = drive.cut(folder / "drive.bag", folder / "part.bag", 1.5, ["imu"])
        self.assertEqual(truth, folder / "drive.truth" / "trajectory.tum")
        with rosbag.Bag(str(folder / "part.bag")) as bag:
            rows = [(topic, stamp.to_nsec()) for topic, _, stamp in bag.read_messages(raw=True)]
        self.assertEqual(rows[0], ("/tf_static", 100 * 10**9))
        self.assertEqual(rows[1:], [("/imu/data", 100 * 10**9 + 10**8 * i) for i in range(15)])


if __name__ == "__main__":
    import rosunit
    rosunit.unitrun("urban_nav", "drive", "__main__")
