#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""robot.launch on simulated devices that a bag feeds, as a user starts it: every device comes, odometry runs on the stereo driver's images, a pulled plug is reported and survived, and all ends clean."""
import subprocess
import sys
from pathlib import Path

import rosbag
import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CompressedImage, Image, Imu, LaserScan, NavSatFix
from urban_nav_msgs.msg import RawFrame

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import command  # noqa: E402
from launch_case import LaunchCase  # noqa: E402

TOPICS = {"/laser_left/scan": LaserScan, "/laser_right/scan": LaserScan, "/imu/data": Imu, "/wheel_odom": Odometry, "/gps/fix": NavSatFix,
          "/stereo/left/image_raw": Image, "/ladybug/raw": RawFrame, "/ladybug/camera2/image_raw/compressed": CompressedImage, "/vo/odometry": Odometry}


def longest_gap(messages):
    """Seconds between the stamps of successive messages."""
    stamps = [message.header.stamp.to_sec() for message in list(messages)]
    return max((later - earlier for earlier, later in zip(stamps, stamps[1:])), default=0.0)


class RobotLaunch(LaunchCase):
    @classmethod
    def record(cls, folder):
        bag = Path(folder) / "session.bag"
        subprocess.run([command(), "simulate", "--seed", "5", "--duration", "14", "-o", str(bag)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return bag

    def statuses(self, name):
        """What one driver has reported, oldest first."""
        return [status for array in list(self.listener.diagnostics) for status in array.status if status.name.lstrip("/").startswith(name)]

    def states(self, name):
        return [status.message for status in self.statuses(name)]

    def has_recovered(self, name):
        """Whether the driver streams after it was lost."""
        states = self.states(name)
        return "lost" in states and "streaming" in states[len(states) - states[::-1].index("lost"):]

    def test_a_robot_without_hardware_survives_a_pulled_plug(self):
        received = {topic: [] for topic in TOPICS}
        subscribers = [rospy.Subscriber(topic, kind, received[topic].append, queue_size=1000) for topic, kind in TOPICS.items()]
        self.launch("robot.launch", simulated=self.bag, ports=Path(self.folder) / "devices", loops="false", laser_left_fault="unplug:5:1.5")
        self.expect(lambda: all(len(messages) > 1 for messages in received.values()), lambda: {topic: len(messages) for topic, messages in received.items()})
        self.expect(lambda: self.has_recovered("laser_left"), lambda: f"the pulled plug is not reported, or not survived: {self.states('laser_left')}")
        self.expect(lambda: longest_gap(received["/laser_left/scan"]) > 1.0, "no scan came after the plug was back")
        self.assertIn("1", [item.value for item in self.statuses("laser_left")[-1].values if item.key == "reconnections"])
        for camera in ("bumblebee2", "ladybug2"):
            self.assertIn("streaming", self.states(camera))
        for subscriber in subscribers:
            subscriber.unregister()
        with rosbag.Bag(str(self.bag)) as bag:
            ranges = {tuple(round(r, 3) for r in message.ranges) for _, message, _ in bag.read_messages(["laser_left/scan", "/laser_left/scan"])}
        for scan in received["/laser_left/scan"]:
            self.assertIn(tuple(round(r, 3) for r in scan.ranges), ranges)
        for messages in received.values():
            stamps = [message.header.stamp.to_nsec() for message in messages]
            self.assertEqual(stamps, sorted(stamps))


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "robot_launch", RobotLaunch)
