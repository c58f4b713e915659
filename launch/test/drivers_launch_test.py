#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""drivers.launch as a user starts it, on simulated devices that a bag feeds: every topic comes, with the values of the bag, and all ends clean."""
import os
import sys
from pathlib import Path

import rosbag
import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, LaserScan, MagneticField, NavSatFix

sys.path.insert(0, str(Path(__file__).resolve().parent))
from launch_case import LaunchCase  # noqa: E402

TOPICS = {"/laser_left/scan": LaserScan, "/laser_right/scan": LaserScan, "/imu/data": Imu, "/imu/mag": MagneticField,
          "/wheel_odom": Odometry, "/gps/fix": NavSatFix}
SECONDS = 24


class DriversLaunch(LaunchCase):
    @classmethod
    def record(cls, folder):
        return cls.simulated(folder, SECONDS, "lasers", "imu", "wheels", "gps")[0]

    def test_simulated_devices_give_the_measurements_of_the_bag(self):
        received = {topic: [] for topic in TOPICS}
        subscribers = [rospy.Subscriber(topic, kind, received[topic].append, queue_size=1000) for topic, kind in TOPICS.items()]
        ports = Path(self.folder) / "devices"
        self.launch("drivers.launch", simulated=self.bag, ports=ports)
        self.expect(lambda: all(len(messages) > 3 for messages in received.values()) and len(received["/laser_left/scan"]) > 100,
                    lambda: {topic: len(messages) for topic, messages in received.items()})
        for subscriber in subscribers:
            subscriber.unregister()
        with rosbag.Bag(str(self.bag)) as bag:
            ranges = {tuple(round(r, 3) for r in message.ranges) for _, message, _ in bag.read_messages(["laser_left/scan", "/laser_left/scan"])}
        scans = received["/laser_left/scan"]
        for scan in scans:
            self.assertIn(tuple(round(r, 3) for r in scan.ranges), ranges)
        stamps = [scan.header.stamp.to_nsec() for scan in scans]
        self.assertEqual(stamps, sorted(set(stamps)))
        states = {status.name: status.message for array in self.listener.diagnostics for status in array.status}
        self.assertGreaterEqual(sum(state == "streaming" for state in states.values()), 3, states)

    def test_without_hardware_it_waits_for_its_ports(self):
        ports = Path(self.folder) / "none"
        os.makedirs(ports)
        self.launch("drivers.launch", ports=ports)
        self.expect(lambda: any(status.message in ("absent", "lost") for array in self.listener.diagnostics for status in array.status),
                    "no diagnostics of an absent device")


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "drivers_launch", DriversLaunch)
