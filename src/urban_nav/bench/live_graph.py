# SPDX-License-Identifier: BSD-3-Clause
"""Runs the nodelet pose_graph in its own process group with a synthetic recording: three laps of a circle with a closure every second.

Needs a sourced workspace (. build/ws/devel/setup.bash). Starts its own master, independent of running ones.
"""
import atexit
import math
import os
import signal
import socket
import subprocess
import sys
import time

from support import wait_until

try:
    import rosgraph
    import rospy
    from std_srvs.srv import Trigger
    from urban_nav_msgs.msg import GraphState, MetricClosure, RelativePose, StageStatus
    from urban_nav_msgs.srv import FileCommand
except ImportError:
    rospy = None

RATE, LAP, STEPS = 20, 400, 1200  # Hz, steps per lap, steps
CLOSURES = len(range(LAP, STEPS + 1, RATE))
START = 1225719873  # s
SPEED = 20  # factor of real time


def stop(process):
    """Kills the process group."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()


def quietly(*words):
    return subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)


def begin_master():
    if rospy is None:
        sys.exit("there is no ROS here with this workspace's messages: . build/ws/devel/setup.bash")
    with socket.socket() as some:
        some.bind(("localhost", 0))
        port = some.getsockname()[1]
    os.environ.update(ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOSTNAME="localhost")
    master = quietly("rosmaster", "--core", "-p", str(port))
    atexit.register(stop, master)
    while not rosgraph.is_master_online():
        time.sleep(0.05)
    rospy.init_node("crash", disable_signals=True, log_level=rospy.FATAL)


def stamp(i):
    return rospy.Time(START) + rospy.Duration(nsecs=i * 1_000_000_000 // RATE)


def step(i):
    """Step of 0.1 m along the circle, whose rotation odometry underestimates slightly."""
    message = RelativePose()
    message.header.stamp = message.to_stamp = stamp(i + 1)
    message.from_stamp = stamp(i)
    turn = 2 * math.pi / LAP - 2e-5 * (1 + math.sin(0.1 * i))
    message.T_from_to.position.x = 0.1
    message.T_from_to.orientation.z, message.T_from_to.orientation.w = math.sin(turn / 2), math.cos(turn / 2)
    message.covariance = [1e-6 * (k % 7 == 0) for k in range(36)]
    message.drift_covariance = [2e-7 * (k % 7 == 0) for k in range(36)]
    message.source = "swf_vo"
    return message


def closure(i):
    """Closure with the pose one lap earlier."""
    message = MetricClosure()
    message.header.stamp = message.b.stamp = stamp(i)
    message.a.stamp = stamp(i - LAP)
    message.T_a_b.orientation.w = 1.0
    message.information = [1e4 * (k % 7 == 0) for k in range(36)]
    message.probability, message.method, message.verdict, message.odometry_gate = 0.999, MetricClosure.STEREO, MetricClosure.ACCEPTED, True
    message.source = "loop_metric"
    return message


class Feeder:
    """Publishes the recording and receives the output of the graph."""

    def __init__(self):
        self.steps = rospy.Publisher("odometry/relative_pose", RelativePose, queue_size=10 * STEPS)
        self.closures = rospy.Publisher("loops/metric", MetricClosure, queue_size=10 * STEPS)
        self.revision, self.status = 0, None
        self.fed = []  # time of each step
        rospy.Subscriber("graph/state", GraphState, self.hear)
        rospy.Subscriber("pose_graph/status", StageStatus, lambda status: setattr(self, "status", status))

    def hear(self, state):
        self.revision = state.revision

    def connected(self):
        return self.steps.get_num_connections() > 0 and self.closures.get_num_connections() > 0

    def feed(self, until, end=STEPS):
        """Publishes the recording from its start until `until` (time.monotonic()). Returns True if it reached the end."""
        self.fed = []
        while not self.connected():
            if time.monotonic() > until:
                return False
            time.sleep(0.01)
        begin = time.monotonic()
        for i in range(end):
            time.sleep(max(0.0, begin + i / (RATE * SPEED) - time.monotonic()))
            if time.monotonic() > until:
                return False
            self.steps.publish(step(i))
            self.fed.append(time.monotonic())
            if i + 1 in range(LAP, STEPS + 1, RATE):
                self.closures.publish(closure(i + 1))
        return True

    def gone(self):
        """Waits until the master and the publishers have noticed that the nodelet was killed."""
        wait_until(lambda: self.steps.get_num_connections() == 0 and self.closures.get_num_connections() == 0)
        self.status = None

    def optimized(self):
        """Relaxes from the measurements and waits."""
        before = self.revision
        rospy.ServiceProxy("pose_graph/optimize", Trigger)()
        return wait_until(lambda: self.revision > before)


def begin_nodelet(store):
    return quietly("rosrun", "nodelet", "nodelet", "standalone", "pose_graph/PoseGraphNodelet", "__name:=pose_graph", f"_store:={store}",
                   "_recording:=crash")


def save(path):
    reply = rospy.ServiceProxy("pose_graph/save", FileCommand)(path=str(path))
    if not reply.success:
        sys.exit(f"~save: {reply.message}")
