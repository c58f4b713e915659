#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""simulator.launch as a user starts it: against the bag of the command with the same options, and with the odometry that watches it."""
import io
import math
import subprocess
import sys
from pathlib import Path

import rosbag
import rospy
from geometry_msgs.msg import PoseStamped
from roslib.message import get_message_class

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import camera_is_connected, published, rviz_file, services  # noqa: E402
from launch_case import ALL_SENSORS, PATIENCE, LaunchCase  # noqa: E402

SECONDS = 1.2  # enough for each sensor to speak twice, GPS to speak once
FRAMES = {
    **{f"/stereo/{side}/{topic}": f"stereo_{side}_optical_frame" for side in ("left", "right") for topic in ("image_raw", "camera_info")},
    **{f"/ladybug/camera{k}/{topic}": f"ladybug_camera{k}_optical_frame" for k in range(5) for topic in ("image_raw/compressed", "camera_info")},
    "/laser_left/scan": "laser_left",
    "/laser_right/scan": "laser_right",
    "/imu/data": "imu_link",
    "/imu/mag": "imu_link",
    "/wheel_odom": "odom",
    "/gps/fix": "gps_link",
    "/ground_truth/pose": "ground_truth",
}


def said(message):
    """The bytes of a message but for header.seq, which is counted by whoever publishes."""
    message.header.seq = 0
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def moved(first, last):
    """Where `last` is, seen from `first`."""
    p, q, r = first.position, last.position, first.orientation
    x, y, z = q.x - p.x, q.y - p.y, q.z - p.z
    # v - 2 w (r x v) + 2 r x (r x v): the inverse rotation of a unit quaternion
    cx, cy, cz = r.y * z - r.z * y, r.z * x - r.x * z, r.x * y - r.y * x
    return (x + 2 * (r.y * cz - r.z * cy - r.w * cx), y + 2 * (r.z * cx - r.x * cz - r.w * cy), z + 2 * (r.x * cy - r.y * cx - r.w * cz))



class SimulatorLaunch(LaunchCase):
    @classmethod
    def record(cls, folder):
        return cls.simulated(folder, SECONDS, *ALL_SENSORS)[0]

    def simulate(self, **arguments):
        """Starts it and holds it at its first message."""
        self.launch("simulator.launch", seed=5, paused="true", **arguments)
        self.expect(lambda: "/simulator/resume" in services(), "the simulator")

    def resume(self):
        subprocess.run(["rosservice", "call", "/simulator/resume"], check=True, stdout=subprocess.DEVNULL)

    def hear(self, types):
        """Keeps all messages of these topics, once they are connected."""
        heard = {topic: [] for topic in types}
        subscribers = [rospy.Subscriber(topic, get_message_class(name), heard[topic].append) for topic, name in types.items()]
        for subscriber in subscribers:
            self.addCleanup(subscriber.unregister)
        self.expect(lambda: all(subscriber.get_num_connections() for subscriber in subscribers), "connections")
        return heard

    def test_all_sensors_say_what_the_command_writes(self):
        wanted, types = {}, {}
        with rosbag.Bag(str(self.bag)) as bag:
            for topic, message, _ in bag.read_messages():
                wanted.setdefault(topic, []).append(message)
                types[topic] = message._type
        wanted.pop("/tf_static")
        types.pop("/tf_static")
        self.assertLessEqual(set(FRAMES), set(wanted))
        self.simulate(duration=SECONDS, vo="false")
        heard = self.hear(types)
        self.resume()
        for topic, messages in wanted.items():
            self.expect(lambda: len(heard[topic]) >= len(messages), lambda: f"{topic}: {len(heard[topic])} of {len(messages)}")
        for topic, messages in wanted.items():
            self.assertEqual(len(heard[topic]), len(messages), topic)
            for live, written in zip(heard[topic], messages):
                self.assertEqual(said(live), said(written), f"{topic} at {live.header.stamp}")
            stamps = [message.header.stamp for message in heard[topic]]
            self.assertTrue(all(a < b for a, b in zip(stamps, stamps[1:])), f"{topic}: {stamps}")
            if topic in FRAMES:
                self.assertEqual({message.header.frame_id for message in heard[topic]}, {FRAMES[topic]}, topic)
        for frame in set(FRAMES.values()) - {"odom", "ground_truth"}:
            self.assertTrue(self.listener.connected("base_link", frame), f"{frame}: {self.listener.links}")

    def test_the_odometry_follows_the_truth(self):
        # At a quarter of real time: odometry that a busy machine delays leaves out no pair.
        self.simulate(duration=4, sensors="stereo", delay=0, rate=0.25)
        truth = self.hear({"/ground_truth/pose": PoseStamped._type})["/ground_truth/pose"]
        self.expect(self.heard_by_odometry, "the odometry")
        self.resume()
        self.expect(lambda: len(self.listener.odometry) == 80, lambda: f"{len(self.listener.odometry)} of 80 frames")
        self.assertEqual({frame.status for frame in self.listener.frames}, {self.listener.frames[0].OK})
        first, last = self.listener.odometry[0], self.listener.odometry[-1]
        true = [min(truth, key=lambda pose: abs((pose.header.stamp - odometry.header.stamp).to_sec())).pose for odometry in (first, last)]
        way, estimate = moved(*true), moved(first.pose.pose, last.pose.pose)
        distance = math.dist(way, (0, 0, 0))
        self.assertGreater(distance, 1.0, "it did move")
        self.assertLess(math.dist(way, estimate), 0.02 * distance + 0.01)
        self.assertTrue(self.listener.connected("odom", "stereo_left_optical_frame"))

    def heard_by_odometry(self):
        return camera_is_connected()

    def test_rviz_shows_what_is_there(self):
        self.launch("simulator.launch", sensors="stereo", duration=60)
        self.look_at(rviz_file("urban_nav"))

    def test_rviz_shows_sensors_and_truth_without_odometry(self):
        self.listener.hear_truth()
        self.launch("simulator.launch", sensors="stereo,lasers", duration=60, vo="false")
        self.look_at(rviz_file("simulator"))
        for frame in ("laser_left", "laser_right", "stereo_left_optical_frame"):
            self.assertTrue(self.listener.connected("ground_truth", frame), frame)
        self.assertNotIn("/tf", published(), "a robot does not know where it truly is")

    def test_rviz_is_told_the_truth_by_nothing_but_the_absence_of_odometry(self):
        for vo, name, uses_truth in (("true", "urban_nav", False), ("false", "simulator", True)):
            asked = ["roslaunch", "--args", "/rviz", "urban_nav_launch", "simulator.launch", "rviz:=true", f"vo:={vo}"]
            words = subprocess.run(asked, check=True, capture_output=True, text=True).stdout.split()
            self.assertIn(str(rviz_file(name)), words)
            self.assertEqual("/tf:=/ground_truth/tf" in words, uses_truth, words)

    def test_ends_with_the_session_if_told_to(self):
        self.launch("simulator.launch", sensors="wheels,gps", duration=2, exit="true", rate=0, vo="false")
        self.assertTrue(self.launched.ended(PATIENCE), self.launched.output())
        self.assertEqual(self.launched.process.returncode, 0)
        self.assertIn("the session is over", self.launched.output())

    def test_a_fault_that_there_is_not_is_named_with_those_there_are(self):
        self.launch("simulator.launch", fault="unplug:imu:0:1,melt:stereo:0:1", exit="true", vo="false")
        self.assertTrue(self.launched.ended(PATIENCE), self.launched.output())
        self.assertIn('/simulator/fault melt:stereo:0:1: fault "melt": expected drop, freeze', self.launched.output())
        self.launched = None
        self.listener.errors.clear()  # it says so as an error, too


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "simulator_launch", SimulatorLaunch)
