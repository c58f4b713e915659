#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""swf_vo.launch and robot.launch as a user starts them, with a bag played beside them in place of the cameras."""
import subprocess
import sys
from pathlib import Path

import rosbag

sys.path.insert(0, str(Path(__file__).resolve().parent))
from launch_case import PATIENCE, LaunchCase  # noqa: E402

ROBOT_FRAMES = ["base_link", "stereo_left_optical_frame", "stereo_right_optical_frame", "laser_left", "laser_right", "imu_link", "gps_link",
                *(f"ladybug_camera{k}_optical_frame" for k in range(5))]
CAMERA_TOPICS = [f"/stereo/{side}/{topic}" for side in ("left", "right") for topic in ("image_raw", "camera_info")]


class LiveLaunch(LaunchCase):
    def play(self, topics, *renamed, bag=None):
        """Plays these topics, once each of them has a subscriber."""
        command = ["rosbag", "play", "--quiet", "--wait-for-subscribers", str(bag or self.bag), "--topics", *topics, *renamed]
        player = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        self.addCleanup(player.wait)
        self.addCleanup(player.terminate)

    def distorted(self):
        """A copy of the bag whose images have to be rectified, and how many pairs it has."""
        copy, pairs = Path(self.folder) / "distorted.bag", 0
        with rosbag.Bag(str(self.bag)) as source, rosbag.Bag(str(copy), "w") as target:
            for topic, message, stamp in source.read_messages(topics=CAMERA_TOPICS):
                if topic.endswith("camera_info"):
                    message.distortion_model, message.D = "plumb_bob", [-0.05, 0.0, 0.0, 0.0, 0.0]
                pairs += topic == "/stereo/left/image_raw"
                target.write(topic, message, stamp)
        return copy, pairs

    def figures(self, key):
        """The newest value of a figure in /diagnostics, by the status that has it."""
        return {status.name: int(entry.value) for array in self.listener.diagnostics for status in array.status
                for entry in status.values if entry.key == key}

    def reports(self, text):
        return any(text in status.message for array in self.listener.diagnostics for status in array.status)

    def test_other_topic_names(self):
        self.launch("swf_vo.launch", stereo="cam", image="image_rect")
        names = [topic.replace("/stereo", "/cam").replace("image_raw", "image_rect") for topic in CAMERA_TOPICS]
        self.play([*CAMERA_TOPICS, "/tf_static"], *map("{}:={}".format, CAMERA_TOPICS, names))
        self.expect(lambda: len(self.listener.odometry) >= 10, "ten frames")
        self.assertTrue(self.listener.connected("odom", "stereo_left_optical_frame"), str(self.listener.links))

    def test_the_paper_s_robot(self):
        self.launch("robot.launch")
        self.expect(lambda: self.reports("no images yet"), "diagnostics say what is missing")
        self.expect(lambda: self.reports("/stereo/left/image_raw has not been received yet"), "diagnostics name the topic that is missing")
        self.expect(lambda: all(self.listener.connected("base_link", frame) for frame in ROBOT_FRAMES), lambda: str(self.listener.links))
        self.play(CAMERA_TOPICS)
        self.expect(lambda: len(self.listener.odometry) >= 10, "ten frames")
        for frame in ROBOT_FRAMES:
            self.assertTrue(self.listener.connected("odom", frame), frame)

    def test_the_paper_s_robot_rectifies_each_pair_once(self):
        bag, pairs = self.distorted()
        self.launch("robot.launch", graph="true", loops="true")
        self.expect(lambda: {"stereo_rectify", "swf_vo"} <= {name.split(":")[0].strip("/") for name in self.figures("images rectified")},
                    lambda: f"both report: {self.figures('images rectified')}")
        self.play(CAMERA_TOPICS, bag=bag)
        self.expect(lambda: len(self.listener.frames) >= pairs, lambda: f"{len(self.listener.frames)} of {pairs} frames")
        self.expect(lambda: sum(self.figures("images rectified").values()) >= 2 * pairs, lambda: str(self.figures("images rectified")))
        self.assertEqual(sum(self.figures("images rectified").values()), 2 * pairs)
        self.assertEqual(len(self.listener.frames), pairs)

    def test_a_wrong_parameter_is_named_with_what_is_allowed(self):
        config = Path(self.folder) / "wrong.yaml"
        config.write_text("swf_vo:\n  window: 0\n")
        self.launch("swf_vo.launch", config=config, required="true")
        self.assertTrue(self.launched.ended(PATIENCE), self.launched.output())
        self.assertIn("1...100000 (frames)", self.launched.output())
        self.assertNotIn("exit code -", self.launched.output(), "it ends by itself, not by a signal")
        self.launched = None
        self.listener.errors.clear()  # it says so as an error, too


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "live_launch", LiveLaunch)
