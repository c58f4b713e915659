#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""localization.launch over a simulated drive: `urban_nav map` makes the map of every second frame, the others are played, and the robot is found where it truly is."""
import hashlib
import subprocess
import sys
from pathlib import Path

import numpy as np
import rosbag
import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Path as PathMessage
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage
from urban_nav_msgs.msg import LocalizationState

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import command, connections, rviz_file, services  # noqa: E402
from launch_case import PATIENCE, LaunchCase  # noqa: E402
from truth import pose_of, true_poses  # noqa: E402

SECONDS = 7
SENSORS = ["/stereo/left/image_raw", "/stereo/right/image_raw", "/stereo/left/camera_info", "/stereo/right/camera_info"]
LASERS = ["/laser_left/scan", "/laser_right/scan"]


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


class LocalizationLaunch(LaunchCase):
    @classmethod
    def record(cls, folder):
        rospy.set_param("/localization/queue_size", 100000)
        folder = Path(folder)
        whole, trajectory = cls.simulated(folder, SECONDS, "stereo")
        cls.stamps = cls.split(whole, folder / "first.bag", folder / "second.bag")
        cls.truth = dict(zip(cls.stamps, true_poses(trajectory, cls.stamps)))
        subprocess.run([command(), "map", str(folder / "first.bag"), "--stages", "vo,loops,graph", "--out", str(folder / "map")],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        cls.store = folder / "map" / "session.db"
        return folder / "second.bag"

    @staticmethod
    def split(whole, even, odd):
        """Frames in turns to the one bag and the other; all stamps."""
        with rosbag.Bag(str(whole)) as bag:
            messages = [(topic, message) for topic, message, _ in bag.read_messages(SENSORS)]
            places = [message for _, message, _ in bag.read_messages(["/tf_static"])]
        stamps = sorted({message.header.stamp for topic, message in messages if topic == SENSORS[0]})
        for path, frames in ((even, set(stamps[::2])), (odd, set(stamps[1::2]))):
            with rosbag.Bag(str(path), "w") as bag:
                for message in places:
                    bag.write("/tf_static", message, stamps[0])
                for topic, message in messages:
                    if message.header.stamp in frames:
                        bag.write(topic, message, message.header.stamp)
        return stamps

    def off(self, message):
        """How far from the truth a pose in map is: m, rad."""
        here = np.linalg.inv(self.truth[self.stamps[0]]) @ self.truth[message.header.stamp]
        off = np.linalg.inv(here) @ pose_of(message.pose.pose)
        return np.linalg.norm(off[:3, 3]), np.arccos(np.clip((np.trace(off[:3, :3]) - 1) / 2, -1, 1))

    def listen(self, name, kind):
        heard = []
        self.listener.subscribers.append(rospy.Subscriber(name, kind, heard.append))
        return heard

    def test_the_robot_is_found_and_the_map_stays_as_it_is(self):
        before = digest(self.store)
        states, poses = self.listen("localization/state", LocalizationState), self.listen("localization/pose", PoseWithCovarianceStamped)
        maps, ties = self.listen("localization/map_path", PathMessage), []
        self.listener.subscribers.append(rospy.Subscriber("/tf", TFMessage, lambda message: ties.extend(
            t for t in message.transforms if t.child_frame_id == "odom" and t.header.frame_id == "map")))
        beliefs = rospy.Publisher("initialpose", PoseWithCovarianceStamped, queue_size=10)
        self.launch("localization.launch", store=self.store, bag=self.bag, rviz="false", paused="true")
        self.expect(lambda: "/player/pause_playback" in services() and "/localization/reset" in services(), "the nodes")
        heard = {*SENSORS, "/vo/relative_pose", "/vo/odometry", "/initialpose"}
        self.expect(lambda: heard <= connections("/localization"), lambda: f"only {connections('/localization')}")
        self.expect(lambda: set(SENSORS) <= connections("/swf_vo"), lambda: f"only {connections('/swf_vo')}")
        self.expect(lambda: states and maps, "what is there before the first frame")
        self.assertEqual((states[0].state, states[0].has_pose, maps[0].header.frame_id), (LocalizationState.UNCERTAIN, False, "map"))
        self.assertGreater(len(maps[0].poses), 3)
        wrong = PoseWithCovarianceStamped()
        wrong.header.frame_id = "map"
        wrong.pose.pose.position.x, wrong.pose.pose.position.y, wrong.pose.pose.orientation.z = -4.0, 3.0, 1.0
        wrong.pose.covariance[0] = wrong.pose.covariance[7] = 0.25
        wrong.pose.covariance[35] = 0.07
        beliefs.publish(wrong)
        subprocess.run(["rosservice", "call", "/player/pause_playback", "false"], check=True, stdout=subprocess.DEVNULL)
        frames = len(self.stamps) // 2
        self.expect(lambda: len(self.listener.odometry) == frames, lambda: f"{len(self.listener.odometry)} of {frames} frames")
        subprocess.run(["rosservice", "call", "/swf_vo/reset"], check=True, stdout=subprocess.DEVNULL)  # empties its window
        self.expect(lambda: states[-1].header.stamp == self.stamps[2 * frames - 1], lambda: f"the last frame: {states[-1]}")
        self.assertIn(LocalizationState.LOCALIZED, [state.state for state in states], states[-1].message)
        self.assertTrue(poses)
        errors = [self.off(pose) for pose in poses]
        print(f"{len(poses)} of {len(states)} localized, largest error {1e3 * max(e for e, _ in errors):.0f} mm, {states[-1].message}")
        self.assertLess(max(metres for metres, _ in errors), 0.15)
        self.assertLess(max(radians for _, radians in errors), np.radians(1.0))
        self.expect(lambda: ties, "map -> odom")
        lasers = [rospy.Publisher(name, LaserScan, queue_size=1) for name in LASERS]  # which the bag has not
        self.look_at(rviz_file("localization"))
        for laser in lasers:
            laser.unregister()
        self.assertEqual(self.launched.stop(), "")
        self.launched = None
        self.assertEqual(digest(self.store), before)

    def test_a_store_that_is_not_there_is_named(self):
        self.launch("localization.launch", store="/nowhere/session.db", rviz="false", vo="false", required="true")
        self.assertTrue(self.launched.ended(PATIENCE), self.launched.output())
        self.assertIn("/localization/store", self.launched.output())
        self.assertIn("/nowhere/session.db", self.launched.output())
        self.launched = None
        self.listener.errors.clear()  # it says so as an error, too


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "localization_launch", LocalizationLaunch)
