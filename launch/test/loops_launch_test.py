#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""bag.launch over a simulated drive to and fro, with its true revisits on places/closure: transforms come out, and map -> odom follows them."""
import subprocess
import sys
from pathlib import Path

import numpy as np
import rosbag
import rospy
from sensor_msgs.msg import Image
from std_srvs.srv import SetBool, Trigger
from tf2_msgs.msg import TFMessage
from urban_nav_msgs.msg import GraphState, MetricClosure, StageStatus, TopologicalClosure

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import camera_is_connected, connections, services  # noqa: E402
from launch_case import LaunchCase  # noqa: E402
from truth import pose_of, true_poses  # noqa: E402

SECONDS = 6
SENSORS = ["/stereo/left/image_raw", "/stereo/right/image_raw", "/stereo/left/camera_info", "/stereo/right/camera_info",
           "/laser_left/scan", "/laser_right/scan"]
REVISITS = [(10, 15), (20, 21), (30, 25)]  # frames as they were simulated: an even one, seen on the way out, and an odd one, seen on the way back


class LoopsLaunch(LaunchCase):
    @classmethod
    def record(cls, folder):
        # The way is short: views from further along it would be those of the turning point, for both moments.
        for name, value in (("queue_size", 100000), ("candidate_timeout", 10.0), ("keyframe_search_distance", 1.5)):
            rospy.set_param(f"/loop_metric/{name}", value)
        rospy.set_param("/pose_graph/queue_size", 100000)
        there, trajectory = cls.simulated(folder, SECONDS, "stereo", "lasers")
        return cls.to_and_fro(there, trajectory, Path(folder) / "to_and_fro.bag")

    @classmethod
    def to_and_fro(cls, there, trajectory, both):
        """Every second frame on the way out; the others, and the scans, once more on the way back, which the robot drives backwards."""
        with rosbag.Bag(str(there)) as bag:
            messages = [(topic, message) for topic, message, _ in bag.read_messages(SENSORS)]
            places = [(topic, message) for topic, message, _ in bag.read_messages(["/tf_static"])]
        stamps = sorted({message.header.stamp for topic, message in messages if topic == SENSORS[0]})
        stamps = stamps[:len(stamps) // 2 * 2]
        number = {stamp: i for i, stamp in enumerate(stamps)}
        end = stamps[-1]
        sent = []
        for topic, message in messages:
            stamp = message.header.stamp
            if stamp > end:
                continue
            if topic.startswith("/laser"):
                sent.append((stamp, topic, message))
                sent.append((end + (end - stamp), topic, message))
            elif stamp in number:
                sent.append((stamp if number[stamp] % 2 == 0 else end + (end - stamp), topic, message))
        sent.sort(key=lambda each: each[0])
        with rosbag.Bag(str(both), "w") as bag:
            for topic, message in places:
                bag.write(topic, message, sent[0][0])
            for stamp, topic, message in sent:
                message.header.stamp = stamp
                bag.write(topic, message, stamp)
        truth = true_poses(trajectory, stamps)
        cls.frames = len(stamps)
        cls.closures = [(stamps[a], end + (end - stamps[b]), np.linalg.inv(truth[a]) @ truth[b]) for a, b in REVISITS]
        return both

    @staticmethod
    def message(a, b):
        message = TopologicalClosure(probability=0.99)
        message.header.stamp = message.b.stamp = b
        message.a.stamp = a
        return message

    def listen(self, name, kind):
        heard = []
        self.listener.subscribers.append(rospy.Subscriber(name, kind, heard.append))
        return heard

    def test_revisits_become_transforms_and_the_map_follows(self):
        closures, pictures = self.listen("loops/metric", MetricClosure), self.listen("loops/matches", Image)
        states, statuses, ties = self.listen("graph/state", GraphState), self.listen("loop_metric/status", StageStatus), []
        self.listener.subscribers.append(rospy.Subscriber("/tf", TFMessage, lambda message: ties.extend(
            t for t in message.transforms if t.child_frame_id == "odom" and t.header.frame_id == "map")))
        places = rospy.Publisher("places/closure", TopologicalClosure, queue_size=100)
        self.launch("bag.launch", bag=self.bag, rviz="false", paused="true")
        self.expect(lambda: "/player/pause_playback" in services() and "/loop_metric/reset" in services(), "the nodes")
        heard = {*SENSORS, "/vo/relative_pose", "/vo/odometry", "/places/closure"}
        self.expect(lambda: heard <= connections("/stereo_manager"), lambda: f"only {connections('/stereo_manager')}")
        self.expect(camera_is_connected, lambda: f"only {connections('/stereo_manager')}")
        self.expect(lambda: {"/loops/metric", "/vo/relative_pose"} <= connections("/pose_graph"), lambda: f"only {connections('/pose_graph')}")
        own = rospy.get_name()
        self.expect(lambda: {"/loops/metric", "/loops/matches"} <= connections(own), lambda: f"only {connections(own)}")
        # Ahead of all data: they wait. The last one's earlier moment was before the drive.
        for a, b, _ in self.closures:
            places.publish(self.message(a, b))
        places.publish(self.message(self.closures[0][0] - rospy.Duration(1000), self.closures[0][1]))
        self.assertTrue(rospy.ServiceProxy("/player/pause_playback", SetBool)(False).success)  # at once: without odometry they wait by the clock
        self.expect(lambda: len(self.listener.odometry) == self.frames, lambda: f"{len(self.listener.odometry)} of {self.frames} frames")
        subprocess.run(["rosservice", "call", "/swf_vo/reset"], check=True, stdout=subprocess.DEVNULL)  # empties its window
        self.expect(lambda: len(closures) == len(self.closures) + 1, lambda: f"{len(closures)} verdicts")

        found = {(closure.a.stamp, closure.b.stamp): closure for closure in closures}
        for a, b, truth in self.closures:
            closure = found[a, b]
            self.assertEqual(closure.verdict, MetricClosure.ACCEPTED, f"{closure.reason_name}: {closure.message}")
            self.assertTrue(closure.odometry_gate)
            off = np.linalg.inv(truth) @ pose_of(closure.T_a_b)
            print(f"{'none stereo icp'.split()[closure.method]}: {1e3 * np.linalg.norm(off[:3, 3]):.1f} mm, {closure.message}")
            self.assertLess(np.linalg.norm(off[:3, 3]), 0.03)
            self.assertLess(np.arccos(min(1.0, (np.trace(off[:3, :3]) - 1) / 2)), np.radians(0.2))
        rejected = [closure for closure in closures if closure.verdict == MetricClosure.REJECTED]
        self.assertEqual([closure.reason_name for closure in rejected], ["unknown_moment"])
        self.expect(lambda: pictures, "the two views beside each other")  # drawn after the verdict was published
        self.assertTrue(pictures[0].encoding == "bgr8" and pictures[0].width >= 2 * 512)

        self.expect(lambda: states and states[-1].closures == len(self.closures), lambda: f"{states[-1:]}")
        self.assertTrue(rospy.ServiceProxy("/pose_graph/optimize", Trigger)().success)
        self.expect(lambda: states[-1].closures_rejected + states[-1].closures_waiting == 0, lambda: f"{states[-1]}")
        offsets = [np.linalg.norm([t.transform.translation.x, t.transform.translation.y, t.transform.translation.z]) for t in ties]
        self.assertLess(offsets[0], 1e-9)
        self.assertTrue(1e-6 < offsets[-1] < 0.5, offsets[-1])
        self.assertTrue(statuses)


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "loops_launch", LoopsLaunch)
