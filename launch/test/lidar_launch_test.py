#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A robot with a 3D LiDAR and no camera: bag.launch with odometry:=laser maps a simulated drive and closes its return, and localization.launch finds the robot in
the map of `urban_nav map`."""
import subprocess
import sys
from pathlib import Path

import numpy as np
import rosbag
import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from urban_nav_msgs.msg import GraphState, LocalizationState, MapTile, MetricClosure
from urban_nav_msgs.srv import GetTrajectory

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import command, connections, services  # noqa: E402
from launch_case import LaunchCase  # noqa: E402
from truth import pose_of, true_poses  # noqa: E402

SECONDS = 40  # to the archway and back
ROUTE = ["--world", "quad", "--route", "return", "--seed", "5", "--duration", str(SECONDS), "--sensors", "lidar3d", "--lidar", "16"]
RATE = 3
SEARCHED_M = 2.5  # the map is searched once for each two metres
BEFORE_TF = 10  # sweeps that may come before /tf_static, on another connection
ALLOWED_M, ALLOWED_RAD = 0.1, np.radians(0.5)


class LidarLaunch(LaunchCase):
    @classmethod
    def record(cls, folder):
        for stage in ("laser_odometry", "loop_metric", "pose_graph", "localization"):
            rospy.set_param(f"/{stage}/queue_size", 100000)
        bag = Path(folder) / "lidar.bag"
        subprocess.run([command(), "simulate", *ROUTE, "-o", str(bag)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with rosbag.Bag(str(bag)) as opened:
            cls.sweeps = opened.get_message_count("/points")
        cls.trajectory = bag.with_suffix(".truth") / "trajectory.tum"
        return bag

    def listen(self, name, kind):
        messages = []
        self.listener.subscribers.append(rospy.Subscriber(name, kind, messages.append, queue_size=1000))
        return messages

    def errors(self, poses, stamps, firsts):
        """The errors of poses relative to those at the stamps `firsts`: m, rad."""
        errors = []
        for T, start, now in zip(poses, true_poses(self.trajectory, firsts), true_poses(self.trajectory, stamps)):
            off = np.linalg.inv(np.linalg.inv(start) @ now) @ T
            errors.append((np.linalg.norm(off[:3, 3]), np.arccos(np.clip((np.trace(off[:3, :3]) - 1) / 2, -1, 1))))
        return np.array(errors)

    def pause(self, is_paused):
        subprocess.run(["rosservice", "call", "/player/pause_playback", str(is_paused).lower()], check=True, stdout=subprocess.DEVNULL)

    def diagnosed(self, key):
        """The last value of an entry of the diagnostics of localization, a number; 0 without one."""
        values = [entry.value for array in self.listener.diagnostics for status in array.status if status.name.startswith("localization") for entry in status.values
                  if entry.key == key]
        return int(values[-1]) if values else 0

    @staticmethod
    def driven(odometry):
        """The distance between the first and the last pose, m."""
        places = [np.array([m.pose.pose.position.x, m.pose.pose.position.y, m.pose.pose.position.z]) for m in odometry]
        return np.linalg.norm(places[-1] - places[0]) if places else 0.0

    def test_a_drive_is_mapped_and_closed(self):
        odometry, closures, states = self.listen("lo/odometry", Odometry), self.listen("loops/metric", MetricClosure), self.listen("graph/state", GraphState)
        tiles = self.listen("map/tiles", MapTile)
        self.launch("bag.launch", bag=self.bag, odometry="laser", rate=RATE, rviz="false", paused="true")
        self.expect(lambda: {"/player/pause_playback", "/pose_graph/get_trajectory", "/loop_metric/finish"} <= services(), "the nodes")
        self.expect(lambda: {"/points", "/lo/relative_pose", "/lo/odometry"} <= connections("/stereo_manager"), lambda: f"only {connections('/stereo_manager')}")
        self.expect(lambda: {"/loops/metric", "/lo/relative_pose", "/lo/odometry"} <= connections("/pose_graph"), lambda: f"only {connections('/pose_graph')}")
        self.expect(lambda: "/points" in connections("/laser_odometry"), lambda: f"only {connections('/laser_odometry')}")
        self.pause(False)
        self.expect(lambda: len(odometry) >= self.sweeps - BEFORE_TF, lambda: f"{len(odometry)} of {self.sweeps} sweeps")
        self.assertTrue(self.listener.connected("map", "base_link"), str(self.listener.links))
        for stage in ("loop_metric", "pose_graph"):
            subprocess.run(["rosservice", "call", f"/{stage}/finish"], check=True, stdout=subprocess.DEVNULL)
        self.expect(lambda: tiles, "tiles of the map")
        accepted = [closure for closure in closures if closure.verdict == MetricClosure.ACCEPTED]
        print(f"{len(accepted)} of {len(closures)} proposed closures accepted")
        self.assertTrue(accepted, [closure.message for closure in closures])
        errors = self.errors([pose_of(each.T_a_b) for each in accepted], [each.b.stamp for each in accepted], [each.a.stamp for each in accepted])
        self.assertLess(errors[:, 0].max(), ALLOWED_M)
        self.assertLess(errors[:, 1].max(), ALLOWED_RAD)
        self.expect(lambda: states and states[-1].closures >= len(accepted), lambda: f"{states[-1:]}")
        get = rospy.ServiceProxy("/pose_graph/get_trajectory", GetTrajectory)
        runs = get(rospy.Time(), rospy.Time(), 0).segments
        stamps, poses = [stamp for run in runs for stamp in run.stamps], [pose_of(pose) for run in runs for pose in run.T_map_base]
        self.assertGreater(len(poses), 0.95 * self.sweeps)
        worst = self.errors(poses, stamps, [stamps[0]] * len(stamps))[:, 0].max()
        print(f"largest error of the graph {1e3 * worst:.0f} mm")
        self.assertLess(worst, ALLOWED_M)

    def test_the_robot_is_found_without_a_camera(self):
        out = Path(self.folder) / "map"
        subprocess.run([command(), "map", str(self.bag), "--stages", "lo,loops,graph", "--out", str(out)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        states, poses = self.listen("localization/state", LocalizationState), self.listen("localization/pose", PoseWithCovarianceStamped)
        odometry = self.listen("lo/odometry", Odometry)
        self.launch("localization.launch", store=out / "session.db", bag=self.bag, odometry="laser", start=15, rviz="false", paused="true")
        self.expect(lambda: {"/player/pause_playback", "/localization/reset"} <= services(), "the nodes")
        self.expect(lambda: {"/points", "/lo/relative_pose", "/lo/odometry"} <= connections("/localization"), lambda: f"only {connections('/localization')}")
        # Piece by piece: each search of the map is awaited, however slow the machine is.
        while not (states and states[-1].state == LocalizationState.LOCALIZED):
            begun, queries = len(odometry), self.diagnosed("cloud queries")
            self.pause(False)
            self.expect(lambda: self.driven(odometry[begun:]) > SEARCHED_M, lambda: f"{len(odometry)} sweeps: {states[-1:]}")
            self.pause(True)
            self.expect(lambda: self.diagnosed("cloud queries") > queries or states[-1].state == LocalizationState.LOCALIZED, lambda: f"a search after {len(odometry)} sweeps")
        self.expect(lambda: poses, "a pose")
        with open(out / "trajectory.tum") as file:
            seconds, _, rest = file.readline().split()[0].partition(".")
        first = rospy.Time(int(seconds), int((rest + "0" * 9)[:9]))
        errors = self.errors([pose_of(each.pose.pose) for each in poses], [each.header.stamp for each in poses], [first] * len(poses))
        print(f"localized after {len(states)} sweeps; largest error {1e3 * errors[:, 0].max():.0f} mm")
        self.assertLess(errors[:, 0].max(), ALLOWED_M)
        self.assertLess(errors[:, 1].max(), ALLOWED_RAD)


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "lidar_launch", LidarLaunch)
