# SPDX-License-Identifier: BSD-3-Clause
"""The case from which the tests of launch files derive: a bag for all of them, and for each a listener and what it launched."""
import csv
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import rospkg
import rospy
import yaml

from graph import SIGINT_TIMEOUT, Launched, Listener, command, make_bag, published, until

sys.path.insert(0, str(Path(rospkg.RosPack().get_path("urban_nav")) / "test" / "support"))
import drive  # noqa: E402

ALL_SENSORS = tuple(drive.TOPICS)
PATIENCE = 300.0  # seconds for what takes two on an idle machine; a test that passes does not wait for them to end

# What a display of rviz reads, and the property that names it.
DISPLAYS = {
    "rviz/Image": ("Image Topic", "sensor_msgs/Image"),
    "rviz/MarkerArray": ("Marker Topic", "visualization_msgs/MarkerArray"),
    "rviz/LaserScan": ("Topic", "sensor_msgs/LaserScan"),
    "rviz/Map": ("Topic", "nav_msgs/OccupancyGrid"),
    "rviz/Path": ("Topic", "nav_msgs/Path"),
    "rviz/PointCloud2": ("Topic", "sensor_msgs/PointCloud2"),
    "rviz/Odometry": ("Topic", "nav_msgs/Odometry"),
    "rviz/Pose": ("Topic", "geometry_msgs/PoseStamped"),
    "rviz/PoseWithCovariance": ("Topic", "geometry_msgs/PoseWithCovarianceStamped"),
}
STAGES = ("swf_vo", "laser_odometry", "loop_metric", "dense_stereo", "localization", "fabmap_node", "laser_mapper", "scene_labeler",
          "trust", "stereo_rectify")
WITHOUT_TOPIC = {"rviz/Grid", "rviz/TF", "rviz/Axes"}


class LaunchCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node(cls.__name__, disable_signals=True)
        # Not a frame may be dropped on a machine that is busy: bits are compared, and frames counted.
        rospy.set_param("/swf_vo/queue_size", 100000)
        rospy.set_param("/swf_vo/max_lateness", 1.0)  # s: left and right images come on connections of their own
        rospy.set_param("/stereo_rectify/queue_size", 100000)
        for stage in STAGES:
            rospy.set_param(f"/{stage}/drain_s", 0.8 * SIGINT_TIMEOUT)  # nor given up after an interrupt
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.bag = cls.record(cls.folder)

    @classmethod
    def record(cls, folder):
        """The bag that the tests of a class share."""
        return make_bag(folder)

    @staticmethod
    def simulated(folder, seconds, *sensors):
        """Writes the first seconds of these sensors of the drive that all tests share. Returns its bag and the trajectory of its truth."""
        bag = Path(folder) / "simulated.bag"
        return bag, drive.cut(drive.record(command()), bag, seconds, sensors)

    def setUp(self):
        self.listener = Listener()
        self.launched = None

    def tearDown(self):
        if self.launched:
            self.assertEqual(self.launched.stop(), "")
        self.listener.close()
        self.assertEqual(self.listener.errors, [])

    def launch(self, file, **arguments):
        self.launched = Launched(file, **arguments)

    def expect(self, so, what="", seconds=PATIENCE):
        """Waits until it is so; `what` is a text, or a function that makes one of how far it came."""
        if not until(so, seconds):
            self.fail(f"{what() if callable(what) else what}\n{self.launched.output() if self.launched else ''}")

    def expect_topic(self, topic, type_name, what=""):
        """Waits for it: each node comes when it comes, and what is there first says nothing about the others."""
        self.expect(lambda: published().get(topic) == type_name, lambda: f"{topic} is {published().get(topic)}, not {type_name}. {what}")

    def expect_bits(self, out):
        """Waits until the odometry has told all the frames of a run of `map` in the folder `out`, and demands the same stamps and the same bits."""
        with open(out / "stats.csv") as file:
            rows = list(csv.DictReader(file))
        self.expect(lambda: len(self.listener.odometry) == len(rows), lambda: f"{len(self.listener.odometry)} of {len(rows)} frames")
        for row, message in zip(rows, self.listener.odometry):
            self.assertEqual(int(row["stamp_ns"]), message.header.stamp.to_nsec())
            p, q = message.pose.pose.position, message.pose.pose.orientation
            now = [float(row["now_" + name]) for name in ("x", "y", "z", "qx", "qy", "qz", "qw")]
            self.assertEqual(now, [p.x, p.y, p.z, q.x, q.y, q.z, q.w], f"stamp {row['stamp_ns']}")

    def look_at(self, path):
        """Every display of an rviz file reads a topic that is there, in frames that are."""
        config = yaml.safe_load(path.read_text())["Visualization Manager"]
        root = config["Global Options"]["Fixed Frame"]
        self.expect(lambda: root in self.listener.links.values(), lambda: f"nothing in {root}: {self.listener.links}")
        for display in config["Displays"]:
            kind = display["Class"]
            if kind in WITHOUT_TOPIC:
                continue
            key, type_name = DISPLAYS[kind]
            self.expect_topic(display[key], type_name, f"{display['Name']} reads it")
        for view in [config["Views"]["Current"]] + (config["Views"]["Saved"] or []):
            frame = view["Target Frame"]
            self.expect(lambda: self.listener.connected(root, frame), lambda: f"{view['Name']} follows {frame}: {self.listener.links}")
