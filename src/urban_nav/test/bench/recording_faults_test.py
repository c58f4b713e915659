# SPDX-License-Identifier: BSD-3-Clause
"""Faults of drivers in a short drive: named by `doctor`, and repaired by the options that it prints."""
import re
import shutil
import sys
from pathlib import Path

from case import FolderCase, run
import recording_faults
from driver_faults import FAULTS

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import drive  # noqa: E402

SECONDS = 6
NAMES = "ranges in feet", "lasers exchanged", "accelerometer of NED", "right camera 8 ms late"


class RecordingFaults(FolderCase):
    def test_the_options_of_doctor_give_the_results_of_the_sound_drive(self):
        recording_faults.PROGRAM = Path(shutil.which("urban_nav")).resolve()  # of the workspace
        bag = self.folder / "sound.bag"
        drive.cut(drive.record(recording_faults.PROGRAM), bag, SECONDS, ["stereo", "lasers", "imu"])
        sound = recording_faults.Run([bag], self.folder / "sound", ())
        self.assertEqual(sound.status, 0, sound.text)
        self.assertEqual(recording_faults.examined([bag], self.folder)[0], [])
        for fault in (each for each in FAULTS if each.name in NAMES):
            with self.subTest(fault.name):
                bags = recording_faults.dressed(bag, fault, self.folder / "in")
                findings, options = recording_faults.examined(bags, self.folder)
                self.assertTrue(any(re.search(fault.words, each["text"]) for each in findings), findings)
                repaired = recording_faults.Run(bags, self.folder / "out", options)
                self.assertLess(max(repaired.apart(sound)), recording_faults.NEAR, repaired.text)


if __name__ == "__main__":
    run("bench_recording_faults")
