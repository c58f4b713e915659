# SPDX-License-Identifier: BSD-3-Clause
"""Runs the nodelet fabmap_node in its own process group with the panoramas of a bag and a drive at constant speed.

Needs a sourced workspace (. build/ws/devel/setup.bash) and a master (live_graph.begin_master).
"""
import time

from live_graph import quietly, rospy
from support import wait_until

try:
    import rosbag
    from nav_msgs.msg import Odometry
    from sensor_msgs.msg import CompressedImage
    from urban_nav_msgs.msg import PlaceBelief, StageStatus
    from urban_nav_msgs.srv import FileCommand
except ImportError:
    rosbag = None

CAMERAS = 5
SPACING = 0.5  # m between panoramas
SPEED = 5  # factor of real time


def panoramas_of(bag):
    """Returns the messages of all cameras by stamp."""
    panoramas = {}
    topics = [f"/ladybug/camera{camera}/image_raw/compressed" for camera in range(CAMERAS)]
    with rosbag.Bag(str(bag)) as file:
        for topic, message, _ in file.read_messages(topics=topics):
            panoramas.setdefault(message.header.stamp.to_nsec(), {})[topics.index(topic)] = message
    return [images for _, images in sorted(panoramas.items()) if len(images) == CAMERAS]


class PlaceFeeder:
    """Publishes panoramas and odometry, and counts beliefs."""

    def __init__(self, bag):
        self.panoramas = panoramas_of(bag)
        self.images = [rospy.Publisher(f"ladybug/camera{camera}/image_raw/compressed", CompressedImage, queue_size=100) for camera in range(CAMERAS)]
        self.odometry = rospy.Publisher("odometry", Odometry, queue_size=100)
        self.beliefs, self.status, self.fed = 0, None, []
        rospy.Subscriber("places/belief", PlaceBelief, self.count)
        rospy.Subscriber("fabmap_node/status", StageStatus, lambda status: setattr(self, "status", status))

    def count(self, _):
        self.beliefs += 1

    def seconds(self):
        """Returns the duration of a complete run."""
        return (self.stamp(-1) - self.stamp(0)).to_sec() / SPEED

    def stamp(self, i):
        return self.panoramas[i][0].header.stamp

    def connections(self):
        return [each.get_num_connections() for each in (*self.images, self.odometry)]

    def feed(self, until):
        """Publishes everything from the start until `until` (time.monotonic()). Returns True if it reached the end."""
        self.fed, self.beliefs = [], 0
        while min(self.connections()) == 0:
            if time.monotonic() > until:
                return False
            time.sleep(0.01)
        begin = time.monotonic()
        for i, images in enumerate(self.panoramas):
            time.sleep(max(0.0, begin + (self.stamp(i) - self.stamp(0)).to_sec() / SPEED - time.monotonic()))
            if time.monotonic() > until:
                return False
            pose = Odometry()
            pose.header.stamp = self.stamp(i)
            pose.pose.pose.position.x, pose.pose.pose.orientation.w = SPACING * i, 1.0
            self.odometry.publish(pose)
            for camera, image in images.items():
                self.images[camera].publish(image)
            self.fed.append(time.monotonic())
        return True

    def recognised(self):
        """Waits for the beliefs of all published panoramas."""
        return wait_until(lambda: self.beliefs >= len(self.panoramas))

    def gone(self):
        """Waits until the publishers have noticed that the nodelet was killed."""
        wait_until(lambda: max(self.connections()) == 0)
        self.status = None


def begin_nodelet(store):
    return quietly("rosrun", "nodelet", "nodelet", "standalone", "fabmap_node/FabmapNodelet", "__name:=fabmap_node", f"_store:={store}",
                   "_recording:=crash")


def save(path):
    """Commits all; `path`: the store of the nodelet."""
    reply = rospy.ServiceProxy("fabmap_node/save", FileCommand)(path=str(path))
    return reply.message if reply.success else f"~save: {reply.message}"
