# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of launch files share: a launch file started as a user starts it, and a listener to the graph it makes."""
import os
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path
from xmlrpc.client import Fault, ServerProxy

import rosgraph
import rospkg
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock, Log
from tf2_msgs.msg import TFMessage
from urban_nav_msgs.msg import RelativePose, VoStatistics

# Debian's image_proc ships a plugin description without content; pluginlib says so whenever a nodelet is loaded.
# Where all nodes are ended at once, a manager may be gone before those that loaded nodelets into it.
SIGINT_TIMEOUT = 120  # s
HARMLESS = ("image_proc/nodelet_plugins.xml", "Failed to unload nodelet")


def until(so, seconds=20.0):
    """Waits until it is so; False after the time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if so():
            return True
        time.sleep(0.05)
    return False


class Launched:
    """`roslaunch PACKAGE FILE ARG:=VALUE...` in a process of its own, on the master of the test."""

    def __init__(self, file, package="urban_nav_launch", **arguments):
        # A busy machine may take longer to end its nodes than the 15 s after which roslaunch kills them.
        command = ["roslaunch", f"--sigint-timeout={SIGINT_TIMEOUT}", package, file] + [f"{name}:={value}" for name, value in arguments.items()]
        self.log = tempfile.NamedTemporaryFile("w+", suffix=".log", delete=False)
        self.process = subprocess.Popen(command, stdout=self.log, stderr=subprocess.STDOUT, start_new_session=True)

    def output(self):
        return Path(self.log.name).read_text(errors="replace")

    def ended(self, seconds=60.0):
        return until(lambda: self.process.poll() is not None, seconds)

    def stop(self):
        """Ends it by Ctrl-C, if it has not ended, and gives what was wrong with that: nothing, as a rule."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
            if not self.ended(2.0 * SIGINT_TIMEOUT):
                os.killpg(self.process.pid, signal.SIGKILL)
                return "did not end by Ctrl-C:\n" + self.output()
        text = self.output()
        wrong = [line for line in text.splitlines()
                 if "Traceback" in line or "exit code" in line or "escalating to SIGTERM" in line]
        os.unlink(self.log.name)
        if self.process.returncode not in (0, -signal.SIGINT) or wrong:
            return f"exit status {self.process.returncode}: {wrong}\n{text}"
        return ""


class Listener:
    """Keeps what the odometry says, which frames tf connects, and every error."""

    def __init__(self):
        self.odometry, self.relative, self.frames, self.diagnostics, self.clock, self.errors = [], [], [], [], [], []
        self.links = {}
        self.subscribers = [
            rospy.Subscriber("vo/odometry", Odometry, self.odometry.append),
            rospy.Subscriber("vo/relative_pose", RelativePose, self.relative.append),
            rospy.Subscriber("vo/statistics", VoStatistics, self.frames.append),
            rospy.Subscriber("/diagnostics", DiagnosticArray, self.diagnostics.append),
            rospy.Subscriber("/clock", Clock, lambda message: self.clock.append(message.clock.to_nsec())),
            rospy.Subscriber("/rosout", Log, self._log),
            rospy.Subscriber("/tf", TFMessage, self._transforms),
            rospy.Subscriber("/tf_static", TFMessage, self._transforms),
        ]

    def close(self):
        for subscriber in self.subscribers:
            subscriber.unregister()

    def _log(self, message):
        if message.level >= Log.ERROR and not any(words in message.msg for words in HARMLESS):
            self.errors.append(f"{message.name}: {message.msg}")

    def _transforms(self, message):
        for transform in message.transforms:
            self.links[transform.child_frame_id.lstrip("/")] = transform.header.frame_id.lstrip("/")

    def hear_truth(self):
        """What rviz is given for tf where no odometry runs."""
        self.subscribers.append(rospy.Subscriber("/ground_truth/tf", TFMessage, self._transforms))

    def connected(self, root, frame):
        """Does tf know the way from `root` down to `frame`?"""
        for _ in range(50):
            if frame == root:
                return True
            if frame not in self.links:
                return False
            frame = self.links[frame]
        return False


def published():
    """Name -> type of every topic that somebody publishes."""
    master = rosgraph.Master("/launch_test")
    types = dict(master.getTopicTypes())
    return {name: types.get(name, "") for name, _ in master.getSystemState()[0]}


def services():
    return {name for name, _ in rosgraph.Master("/launch_test").getSystemState()[2]}


def subscriptions(node):
    """The topics that `node` asks for, published or not."""
    return {topic for topic, nodes in rosgraph.Master("/launch_test").getSystemState()[1] if node in nodes}


def connections(node):
    """The topics that `node` hears: not only asked for, but connected to somebody who publishes them."""
    try:
        uri = rosgraph.Master("/launch_test").lookupNode(node)
        _, _, rows = ServerProxy(uri).getBusInfo("/launch_test")
    except (rosgraph.MasterException, OSError, Fault):  # also of a node that has just begun to answer
        return set()
    return {row[4] for row in rows if row[2] == "i" and row[5]}


CAMERA = {f"/stereo/{side}/{topic}" for side in ("left", "right") for topic in ("image_raw", "camera_info", "image_rect")}


def camera_is_connected():
    """Do the images reach the stages in stereo_manager, by way of stereo_rectify?"""
    return {"/stereo_rectify/reset", "/swf_vo/reset"} <= services() and CAMERA <= connections("/stereo_manager")


def rviz_file(name):
    return Path(rospkg.RosPack().get_path("urban_nav_rviz")) / "rviz" / f"{name}.rviz"


def command():
    """The `urban_nav` program of this workspace."""
    found = shutil.which("urban_nav")
    if not found:
        raise RuntimeError("urban_nav is not on the path: source the workspace's setup.bash")
    return found


def sequence_folder(directory):
    """A KITTI folder: a real street where the data are, else a rendered one."""
    data = os.environ.get("URBAN_NAV_DATA")
    real = Path(data) / "stereo" / "kitti06_000_050" if data else None
    if real and real.is_dir():
        return real
    folder = Path(directory) / "rendered"
    subprocess.run(["rosrun", "urban_nav_core", "render_sequence", str(folder), "--seconds", "4", "--rate", "15"], check=True)
    return folder


def make_bag(directory):
    """The bag that `urban_nav convert` makes of that folder."""
    bag = Path(directory) / "session.bag"
    subprocess.run([command(), "convert", "kitti", str(sequence_folder(directory)), "-o", str(bag)], check=True,
                   stdout=subprocess.DEVNULL)
    return bag
