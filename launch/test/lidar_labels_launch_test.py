#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""bag.launch over a simulated drive of a robot with a 3D LiDAR alone: its sweeps have labels, in the frame of the laser odometry."""
import subprocess
import sys
from pathlib import Path

import rosbag
import rospy
from nav_msgs.msg import Odometry
from sensor_msgs import point_cloud2
from sensor_msgs.msg import PointCloud2

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import command, connections, services  # noqa: E402
from launch_case import LaunchCase  # noqa: E402

ROUTE = ["--world", "street", "--seed", "5", "--duration", "12", "--sensors", "lidar3d", "--lidar", "16"]
FEWEST_SWEEPS = 40  # of 120; others are dropped on a busy machine, and counted
REACH_M = 31.0
GROUND = {1, 2, 3}


class LidarLabelsLaunch(LaunchCase):
    @classmethod
    def record(cls, folder):
        rospy.set_param("/laser_odometry/queue_size", 100000)
        bag = Path(folder) / "lidar.bag"
        subprocess.run([command(), "simulate", *ROUTE, "-o", str(bag)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with rosbag.Bag(str(bag)) as opened:
            cls.sweeps = opened.get_message_count("/points")
        return bag

    def diagnosed(self, key):
        """The last value of an entry of the diagnostics of scene_labeler; 0 without one."""
        values = [entry.value for array in list(self.listener.diagnostics) for status in array.status if status.name.startswith("scene_labeler") for entry in status.values
                  if entry.key == key]
        return int(values[-1]) if values else 0

    def test_sweeps_have_labels(self):
        clouds, odometry = [], []
        subscribers = [rospy.Subscriber("/labels/cloud", PointCloud2, clouds.append, queue_size=1000),
                       rospy.Subscriber("/lo/odometry", Odometry, odometry.append, queue_size=1000)]
        self.launch("bag.launch", bag=self.bag, odometry="laser", rviz="false", loops="false", graph="false", laser_map="false", recognise_places="false",
                    paused="true", rate=0.5)
        self.expect(lambda: {"/player/pause_playback", "/scene_labeler/reset"} <= services(), "the nodes")
        self.expect(lambda: {"/points", "/lo/odometry"} <= connections("/scene_labeler"), lambda: f"only {connections('/scene_labeler')}")
        subprocess.run(["rosservice", "call", "/player/pause_playback", "false"], check=True, stdout=subprocess.DEVNULL)
        self.expect(lambda: len(clouds) >= FEWEST_SWEEPS, lambda: f"{len(clouds)} labelled of {len(odometry)} sweeps")
        self.expect(lambda: self.diagnosed("sweeps labelled") + self.diagnosed("sweeps dropped, faster than they are labelled") + 15 >= self.sweeps,
                    lambda: f"{self.diagnosed('sweeps')} sweeps received")
        self.assertLessEqual(self.diagnosed("sweeps labelled"), self.diagnosed("sweeps"))
        self.assertEqual({cloud.header.frame_id for cloud in clouds}, {"odom"})
        last = clouds[-1]
        points = list(point_cloud2.read_points(last, ("x", "y", "z", "probability", "label", "unsure")))
        self.assertGreater(len(points), 3000)
        self.assertTrue(all(0.0 < point[3] <= 1.0 for point in points))
        nearest = min(odometry, key=lambda message: abs((message.header.stamp - last.header.stamp).to_sec()))
        place = nearest.pose.pose.position
        self.assertTrue(all((point[0] - place.x) ** 2 + (point[1] - place.y) ** 2 < REACH_M ** 2 for point in points))
        ground = sorted(point[2] for point in points if point[4] in GROUND)
        others = sorted(point[2] for point in points if point[4] not in GROUND)
        self.assertGreater(others[len(others) // 2], ground[len(ground) // 2] + 0.5, "walls, trees and vehicles are higher than the ground")
        for subscriber in subscribers:
            subscriber.unregister()


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "lidar_labels_launch", LidarLabelsLaunch)
