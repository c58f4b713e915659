#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""swf_vo.launch and robot.launch as a user starts them, with a bag played beside them in place of the cameras."""
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from launch_case import PATIENCE, LaunchCase  # noqa: E402

ROBOT_FRAMES = ["base_link", "stereo_left_optical_frame", "stereo_right_optical_frame", "laser_left", "laser_right", "imu_link", "gps_link",
                *(f"ladybug_camera{k}_optical_frame" for k in range(5))]
CAMERA_TOPICS = [f"/stereo/{side}/{topic}" for side in ("left", "right") for topic in ("image_raw", "camera_info")]


class LiveLaunch(LaunchCase):
    def play(self, topics, *renamed):
        """Plays these topics, once each of them is heard."""
        command = ["rosbag", "play", "--quiet", "--wait-for-subscribers", str(self.bag), "--topics", *topics, *renamed]
        player = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        self.addCleanup(player.wait)
        self.addCleanup(player.terminate)

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
        self.assertTrue(self.reports("/stereo/left/image_raw has not come yet"))
        self.expect(lambda: all(self.listener.connected("base_link", frame) for frame in ROBOT_FRAMES), lambda: str(self.listener.links))
        self.play(CAMERA_TOPICS)
        self.expect(lambda: len(self.listener.odometry) >= 10, "ten frames")
        for frame in ROBOT_FRAMES:
            self.assertTrue(self.listener.connected("odom", frame), frame)

    def test_a_wrong_parameter_is_named_with_what_is_allowed(self):
        config = Path(self.folder) / "wrong.yaml"
        config.write_text("swf_vo:\n  window: 0\n")
        self.launch("swf_vo.launch", config=config, required="true")
        self.assertTrue(self.launched.ended(PATIENCE), self.launched.output())
        self.assertIn("1...100000 (frames)", self.launched.output())
        self.launched = None
        self.listener.errors.clear()  # it says so as an error, too


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "live_launch", LiveLaunch)
