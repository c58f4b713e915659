#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""bag.launch over a simulated bag, with closures of which some are false: the relaxation live, against the truth and against the offline command."""
import csv
import subprocess
import sys
from pathlib import Path

import numpy as np
import rosbag
import rospy
from nav_msgs.msg import Path as RosPath
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from urban_nav_msgs.msg import GraphState, PoseCorrection, MetricClosure, StageStatus
from urban_nav_msgs.srv import GetTrajectory

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import camera_is_connected, command, connections, services  # noqa: E402
from launch_case import LaunchCase  # noqa: E402
from truth import matrix, pose_of, true_poses  # noqa: E402

SECONDS = 7  # a map is level once three spans of 2 s have been felt
SIGMA_M, SIGMA_RAD = 0.002, 0.0005
TRUE = [(5, 70), (21, 96), (35, 115), (52, 135)]  # frames
FALSE = [(14, 105), (44, 109)]


def quaternion(turn):
    """x, y, z, w of less than half a turn."""
    w = np.sqrt(1 + np.trace(turn)) / 2
    return np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1], 4 * w * w]) / (4 * w)


def rms(poses, truth):
    """Of the places, first poses aligned."""
    apart = [(np.linalg.inv(poses[0]) @ a)[:3, 3] - (np.linalg.inv(truth[0]) @ b)[:3, 3] for a, b in zip(poses, truth)]
    return np.sqrt(np.mean(np.sum(np.square(apart), axis=1)))


class GraphLaunch(LaunchCase):
    @classmethod
    def record(cls, folder):
        rospy.set_param("/pose_graph/queue_size", 100000)
        bag, trajectory = cls.simulated(folder, SECONDS, "stereo", "imu")
        with rosbag.Bag(str(bag)) as opened:
            cls.stamps = [message.header.stamp for _, message, _ in opened.read_messages(["/stereo/left/image_raw"])]
        cls.truth = true_poses(trajectory, cls.stamps)
        cls.closures = [(a, b, cls.measured(a, b, wrong)) for a, b, wrong in sorted([(*p, 0.0) for p in TRUE] + [(*p, 1.5) for p in FALSE])]
        return bag

    @classmethod
    def measured(cls, a, b, sideways):
        pose = np.linalg.inv(cls.truth[a]) @ cls.truth[b]
        pose[1, 3] += sideways
        return [*pose[:3, 3], *quaternion(pose[:3, :3])]

    def message(self, a, b, numbers):
        message = MetricClosure(verdict=MetricClosure.ACCEPTED, method=MetricClosure.STEREO, probability=0.99, source="test", reason_name="None")
        message.header.stamp = message.b.stamp = self.stamps[b]
        message.header.frame_id = "base_link"
        message.a.stamp = self.stamps[a]
        p, q = message.T_a_b.position, message.T_a_b.orientation
        p.x, p.y, p.z, q.x, q.y, q.z, q.w = numbers
        sigmas = np.array([SIGMA_M] * 3 + [SIGMA_RAD] * 3)
        message.information = list(np.diag(1 / (sigmas * sigmas)).ravel())
        message.covariance = list(np.diag(sigmas * sigmas).ravel())
        return message

    def offline(self):
        """What `map` makes of the same: poses and verdicts."""
        file, out = Path(self.folder) / "closures.csv", Path(self.folder) / "out"
        with open(file, "w", newline="") as opened:
            writer = csv.writer(opened)
            writer.writerow("session_a stamp_a_ns session_b stamp_b_ns probability kind x y z qx qy qz qw sigma_m sigma_rad".split())
            for a, b, numbers in self.closures:
                writer.writerow(["simulated", self.stamps[a].to_nsec(), "simulated", self.stamps[b].to_nsec(), 0.99, "stereo",
                                 *(repr(float(x)) for x in numbers), SIGMA_M, SIGMA_RAD])
        subprocess.run([command(), "map", str(self.bag), "--stages", "vo,graph", "--closures", str(file), "--out", str(out)], check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        with open(out / "closures.csv") as opened:
            verdicts = [row["verdict"] for row in csv.DictReader(opened)]
        return [matrix(row[1:4], row[4:8]) for row in np.loadtxt(out / "trajectory.tum")], verdicts

    def listen(self, name, kind):
        heard = []
        self.listener.subscribers.append(rospy.Subscriber(name, kind, heard.append))
        return heard

    def test_closures_pinch_the_trajectory_and_false_ones_do_not(self):
        states, paths, statuses = (self.listen("graph/state", GraphState), self.listen("graph/path", RosPath),
                                   self.listen("pose_graph/status", StageStatus))
        corrections, ties = self.listen("graph/correction", PoseCorrection), []
        self.listener.subscribers.append(rospy.Subscriber("/tf", TFMessage, lambda message: ties.extend(
            t for t in message.transforms if t.child_frame_id == "odom" and t.header.frame_id == "map")))
        closures = rospy.Publisher("loops/metric", MetricClosure, queue_size=100)
        self.launch("bag.launch", bag=self.bag, rviz="false", paused="true")
        self.expect(lambda: "/player/pause_playback" in services() and "/pose_graph/get_trajectory" in services(), "the nodes")
        self.expect(lambda: {"/loops/metric", "/vo/relative_pose", "/vo/odometry"} <= connections("/pose_graph"), lambda: f"only {connections('/pose_graph')}")
        self.expect(camera_is_connected, lambda: f"only {connections('/stereo_manager')}")
        # Ahead of the odometry that they need: they wait for it.
        for closure in self.closures:
            closures.publish(self.message(*closure))
        subprocess.run(["rosservice", "call", "/player/pause_playback", "false"], check=True, stdout=subprocess.DEVNULL)
        self.expect(lambda: len(self.listener.odometry) == len(self.stamps), lambda: f"{len(self.listener.odometry)} of {len(self.stamps)} frames")
        subprocess.run(["rosservice", "call", "/swf_vo/reset"], check=True, stdout=subprocess.DEVNULL)  # empties its window
        get = rospy.ServiceProxy("/pose_graph/get_trajectory", GetTrajectory)

        def poses():
            return [pose_of(pose) for run in get(rospy.Time(), rospy.Time(), 0).segments for pose in run.T_map_base]
        self.expect(lambda: len(poses()) == len(self.stamps), lambda: f"{len(poses())} of {len(self.stamps)} poses")
        self.expect(lambda: states and states[-1].closures == len(self.closures), lambda: f"{states[-1:]}")
        expected, verdicts = self.offline()
        revision = states[-1].revision
        optimized = rospy.ServiceProxy("/pose_graph/optimize", Trigger)()
        self.assertTrue(optimized.success, optimized.message)
        self.expect(lambda: states[-1].revision > revision, "the batch")
        live = poses()
        self.assertEqual(verdicts, ["accepted" if (a, b) in TRUE else "rejected" for a, b, _ in sorted(self.closures, key=lambda row: row[1])], "in the order of time")
        self.expect(lambda: states[-1].closures_rejected + states[-1].closures_waiting == len(FALSE), lambda: f"{states[-1]}")
        np.testing.assert_allclose(live, expected, rtol=0, atol=1e-9, err_msg="the batch over the same edges, live and offline")
        self.assertTrue(any(correction.reason_name == "Levelled" for correction in corrections), str(corrections))
        tilt = np.degrees(np.arccos(min(1.0, live[0][2, :3] @ self.truth[0][2, :3])))
        print(f"the map is level to {tilt:.2f} deg")
        self.assertFalse(np.allclose(live[0], np.eye(4), atol=1e-9))
        self.assertLess(tilt, 1.0, "what an accelerometer's place on the robot is known to")
        odometry = [pose_of(message.pose.pose) for message in self.listener.odometry]
        before, after = rms(odometry, self.truth), rms(live, self.truth)
        print(f"odometry {1e3 * before:.1f} mm, relaxed {1e3 * after:.1f} mm")
        self.assertLess(after, before)
        self.assertLess(after, SIGMA_M, "four closures that are better than that, and none of the false ones")

        self.assertEqual((states[-1].sessions, states[-1].poses), (1, len(self.stamps)))
        self.expect(lambda: paths and paths[-1].poses, "a path")
        self.assertEqual(paths[-1].header.frame_id, "map")
        self.assertTrue(statuses)
        self.assertTrue(self.listener.connected("map", "base_link"), str(self.listener.links))
        # The tie began as nothing and was moved, by little: closures are of a drive that odometry has nearly right.
        self.assertGreaterEqual(len(ties), len(self.stamps))
        offsets = [np.linalg.norm([t.transform.translation.x, t.transform.translation.y, t.transform.translation.z]) for t in ties]
        self.assertLess(offsets[0], 1e-9)
        self.assertTrue(1e-4 < offsets[-1] < 0.5, offsets[-1])


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "graph_launch", GraphLaunch)
