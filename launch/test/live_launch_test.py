#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""swf_vo.launch and robot.launch as a user starts them, with a bag played beside them in place of the cameras."""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import rospy

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import Launched, Listener, make_bag, until  # noqa: E402

ROBOT_FRAMES = (["base_link", "stereo_left_optical_frame", "stereo_right_optical_frame", "laser_left", "laser_right", "imu_link", "gps_link"]
                + [f"ladybug_camera{k}_optical_frame" for k in range(5)])


class LiveLaunch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("live_launch_test", disable_signals=True)
        cls.folder = tempfile.mkdtemp()
        cls.bag = make_bag(cls.folder)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.listener = Listener()
        self.launched = self.player = None

    def tearDown(self):
        if self.player:
            self.player.terminate()
            self.player.wait()
        if self.launched:
            self.assertEqual(self.launched.stop(), "")
        self.listener.close()

    def play(self, *arguments):
        self.player = subprocess.Popen(["rosbag", "play", "--quiet", "--delay", "1", str(self.bag), *arguments],
                                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)

    def reports(self, text):
        return any(text in status.message for array in self.listener.diagnostics for status in array.status)

    def test_other_topic_names(self):
        self.launched = Launched("swf_vo.launch", stereo="cam", image="image_rect")
        self.play("/stereo/left/image_raw:=/cam/left/image_rect", "/stereo/right/image_raw:=/cam/right/image_rect",
                  "/stereo/left/camera_info:=/cam/left/camera_info", "/stereo/right/camera_info:=/cam/right/camera_info")
        self.assertTrue(until(lambda: len(self.listener.odometry) >= 10, 60), self.launched.output())
        self.assertTrue(self.listener.connected("odom", "stereo_left_optical_frame"))
        self.assertEqual(self.listener.errors, [])

    def test_the_paper_s_robot(self):
        self.launched = Launched("robot.launch")
        self.assertTrue(until(lambda: self.reports("no images yet"), 30), "diagnostics say what is missing")
        self.assertTrue(self.reports("/stereo/left/image_raw has not come yet"))
        self.assertTrue(until(lambda: all(self.listener.connected("base_link", frame) for frame in ROBOT_FRAMES), 10), str(self.listener.links))
        self.play("--topics", "/stereo/left/image_raw", "/stereo/right/image_raw", "/stereo/left/camera_info", "/stereo/right/camera_info")
        self.assertTrue(until(lambda: len(self.listener.odometry) >= 10, 60), self.launched.output())
        for frame in ROBOT_FRAMES:
            self.assertTrue(self.listener.connected("odom", frame), frame)
        self.assertEqual(self.listener.errors, [])

    def test_a_wrong_parameter_is_named_with_what_is_allowed(self):
        config = Path(self.folder) / "wrong.yaml"
        config.write_text("swf_vo:\n  window: 0\n")
        self.launched = Launched("swf_vo.launch", config=config, required="true")
        self.assertTrue(self.launched.ended(30), self.launched.output())
        self.assertIn("1...100000 (frames)", self.launched.output())
        self.launched = None


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "live_launch", LiveLaunch)
