#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""bag.launch as a user starts it: once at three times the speed, once paused, once looped; and against the offline command."""
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import rospy
from sensor_msgs.msg import PointCloud2
from urban_nav_msgs.msg import PlaceBelief, TopologicalClosure

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import camera_is_connected, command, connections, rviz_file, services  # noqa: E402
from launch_case import PATIENCE, LaunchCase  # noqa: E402

TOPICS = {
    "/vo/odometry": "nav_msgs/Odometry",
    "/vo/relative_pose": "urban_nav_msgs/RelativePose",
    "/vo/statistics": "urban_nav_msgs/VoStatistics",
    "/vo/landmarks": "sensor_msgs/PointCloud2",
    "/vo/tracks": "sensor_msgs/Image",
    "/vo/path": "nav_msgs/Path",
    "/stereo/disparity": "stereo_msgs/DisparityImage",
    "/stereo/points2": "sensor_msgs/PointCloud2",
    "/stereo/ground_plane": "urban_nav_msgs/GroundPlane",
    "/stereo/obstacles": "sensor_msgs/PointCloud2",
    "/dense_stereo/status": "urban_nav_msgs/StageStatus",
    "/map/cloud": "sensor_msgs/PointCloud2",
    "/laser_mapper/status": "urban_nav_msgs/StageStatus",
    "/graph/update": "urban_nav_msgs/GraphUpdate",
    "/graph/correction": "urban_nav_msgs/PoseCorrection",
    "/graph/path": "nav_msgs/Path",
    "/graph/state": "urban_nav_msgs/GraphState",
    "/graph/markers": "visualization_msgs/MarkerArray",
    "/pose_graph/status": "urban_nav_msgs/StageStatus",
    "/swf_vo/status": "urban_nav_msgs/StageStatus",
    "/diagnostics": "diagnostic_msgs/DiagnosticArray",
    "/stereo/left/image_raw": "sensor_msgs/Image",
    "/stereo/right/image_raw": "sensor_msgs/Image",
    "/stereo/left/camera_info": "sensor_msgs/CameraInfo",
    "/stereo/right/camera_info": "sensor_msgs/CameraInfo",
    "/clock": "rosgraph_msgs/Clock",
}
SENSOR_FRAMES = ["base_link", "stereo_left_optical_frame", "stereo_right_optical_frame"]


def stamp_of(message):
    return message.header.stamp.to_nsec()


class BagLaunch(LaunchCase):
    def play(self, **arguments):
        arguments.setdefault("rviz", "false")
        self.launch("bag.launch", bag=self.bag, **arguments)

    def play_on(self):
        """Lets a paused player go as soon as the odometry hears it."""
        self.expect(lambda: "/player/pause_playback" in services(), "the player")
        self.expect(camera_is_connected, lambda: f"only {connections('/stereo_manager')}")
        subprocess.run(["rosservice", "call", "/player/pause_playback", "false"], check=True, stdout=subprocess.DEVNULL)

    def map_offline(self):
        out = Path(self.folder) / "out"
        subprocess.run([command(), "map", str(self.bag), "--stages", "vo", "--out", str(out), "--overwrite"], check=True,
                       stdout=subprocess.DEVNULL)
        return out

    def test_plays_mcap_and_agrees_with_the_command_to_the_last_bit(self):
        mcap = Path(self.folder) / "drive.mcap"
        subprocess.run([command(), "convert", str(self.bag), "-o", str(mcap)], check=True, stdout=subprocess.DEVNULL)
        out = self.map_offline()
        self.launch("bag.launch", bag=mcap, rviz="false", rate=3, paused="true", exit="true")
        self.expect(lambda: len(self.listener.clock) >= 100, "the clock of a paused player")
        self.assertEqual(len(set(self.listener.clock)), 1)
        self.play_on()
        self.expect_bits(out)
        self.assertTrue(self.launched.ended(PATIENCE), self.launched.output())

    def test_plays_and_agrees_with_the_command_to_the_last_bit(self):
        out = self.map_offline()
        self.play(rate=3, paused="true")
        for topic, type_name in TOPICS.items():  # while the player waits: its own topics go when the bag ends
            self.expect_topic(topic, type_name)
        self.play_on()
        self.expect_bits(out)
        for frame in SENSOR_FRAMES:
            self.assertTrue(self.listener.connected("map", frame), f"{frame} hangs from nothing: {self.listener.links}")

        # Settled frames follow when the window is emptied.
        subprocess.run(["rosservice", "call", "/swf_vo/reset"], check=True, stdout=subprocess.DEVNULL)
        with open(out / "relative_covariance.csv") as file:
            relative = [line.strip().split(",") for line in file if line[0].isdigit()]
        self.expect(lambda: len(self.listener.relative) == len(relative),
                    lambda: f"{len(self.listener.relative)} of {len(relative)} relative poses")
        for row, message in zip(relative, self.listener.relative):
            self.assertEqual([int(row[0]), int(row[1])], [message.from_stamp.to_nsec(), message.to_stamp.to_nsec()])
            self.assertEqual([float(value) for value in row[3:]], list(message.covariance))

    def test_waits_when_paused(self):
        self.play(paused="true", delay=0.5)
        self.expect(lambda: len(self.listener.clock) >= 100, "the clock of a paused player stands, but is told")
        self.assertEqual(len(set(self.listener.clock)), 1)
        self.assertEqual(self.listener.odometry, [], "nothing was to move")
        self.play_on()
        self.expect(lambda: len(self.listener.odometry) >= 3, "three frames")

    def test_each_round_of_a_loop_is_a_new_session(self):
        self.play(loop="true", rate=3)
        self.expect(lambda: any(a.frame > 3 and b.frame == 0 for a, b in pairs(self.listener.frames)), "a second round")
        stamps = [stamp_of(message) for message in self.listener.odometry]
        self.assertTrue(any(b < a for a, b in pairs(stamps)), "time went back")

    def test_ends_with_the_bag_if_told_to_when_all_of_it_is_stored(self):
        store = Path(self.folder) / "exit.db"
        self.play(exit="true", rate=3, paused="true", store=store)
        self.expect(lambda: "/vo/relative_pose" in connections("/pose_graph"), lambda: f"only {connections('/pose_graph')}")
        self.play_on()
        self.assertTrue(self.launched.ended(PATIENCE), self.launched.output())
        self.assertEqual(self.launched.process.returncode, 0)
        self.assertNotIn("does not finish", self.launched.output())
        self.assertTrue(self.listener.frames)
        with closing(sqlite3.connect(f"file:{store}?mode=ro", uri=True)) as file:
            self.assertEqual(file.execute("SELECT COUNT(*) FROM node").fetchone()[0], len(self.listener.frames))

    def test_a_stereo_camera_alone_gives_places_and_a_map(self):
        beliefs, closures, clouds = [], [], []
        self.listener.subscribers += [rospy.Subscriber("/map/cloud", PointCloud2, clouds.append),
                                      rospy.Subscriber("/places/belief", PlaceBelief, beliefs.append),
                                      rospy.Subscriber("/places/closure", TopologicalClosure, closures.append)]
        self.play(loop="true", paused="true")
        self.expect(lambda: {"/stereo/left/image_rect", "/vo/odometry"} <= set(connections("/fabmap_node")),
                    lambda: f"only {connections('/fabmap_node')}")
        self.play_on()
        self.expect(lambda: closures, lambda: f"no closure between two rounds, by {len(beliefs)} beliefs")
        self.assertNotEqual(closures[0].a.session, closures[0].b.session)
        self.assertLess(abs((closures[0].a.stamp - closures[0].b.stamp).to_sec()), 1.0, "the same part of the recording")
        self.expect(lambda: clouds and max(cloud.width for cloud in clouds) > 1000, lambda: f"points: {[cloud.width for cloud in clouds]}")

    def test_rviz_shows_what_is_there(self):
        self.play(loop="true")
        self.look_at(rviz_file("urban_nav"))


def pairs(items):
    return list(zip(items[:-1], items[1:]))


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "bag_launch", BagLaunch)
