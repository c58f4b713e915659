# SPDX-License-Identifier: BSD-3-Clause
"""Plays a bag with a fault to the live stages and records what they publish.

Messages are stamped with the present time, as a driver stamps them. Needs a sourced workspace and a master (live_graph.begin_master).
"""
import threading
import time
from collections import Counter

from live_graph import rospy

try:
    import rosbag
    from diagnostic_msgs.msg import DiagnosticArray
    from nav_msgs.msg import Odometry
    from urban_nav_msgs.msg import RelativePose, VoStatistics
except ImportError:
    rosbag = None

IMAGES = ("/stereo/left/image_raw", "/stereo/right/image_raw")
INFOS = ("/stereo/left/camera_info", "/stereo/right/camera_info")
TOPICS = (*IMAGES, *INFOS, "/tf_static", "/imu/data", "/wheel_odom", "/laser_left/scan", "/laser_right/scan")
LATCHED = ("/tf_static",)
OK = 0  # VoStatistics.status


def seconds(stamp):
    return stamp.to_nsec() * 1e-9


class Player:
    """Publishes the messages of a bag in their order and at their rate. `change(topic, message, at)` returns the message to publish `at` seconds after
    the first, or None. `clock_step(at)`: s added to all stamps. Latched topics are published once, `latched_at` seconds after the first message."""

    def __init__(self, bag, duration, latched_at=0.0):
        self.messages, self.publishers, begin = [], {}, None
        with rosbag.Bag(str(bag)) as file:
            for topic, message, received in file.read_messages(topics=TOPICS):
                begin = begin or received
                if (received - begin).to_sec() > duration:
                    break
                at = latched_at if topic in LATCHED else (received - begin).to_sec()
                self.messages.append((at, topic, message, getattr(message, "header", None) and message.header.stamp))
                if topic not in self.publishers:
                    self.publishers[topic] = rospy.Publisher(topic, type(message), queue_size=200, latch=topic in LATCHED)
        self.messages.sort(key=lambda each: each[0])
        self.original = {}  # stamp of a left image as published, ns: its stamp in the bag, s
        self.pairs = 0  # stamps of which both images were published
        self.begin = None  # time.monotonic() of the first message

    def connected(self):
        return all(publisher.get_num_connections() for topic, publisher in self.publishers.items() if topic in IMAGES + INFOS)

    def play(self, change, clock_step):
        now, sides = rospy.Time.now(), Counter()
        offset = now - next(stamp for _, topic, _, stamp in self.messages if topic in IMAGES)
        self.begin = time.monotonic()
        for at, topic, message, stamp in self.messages:
            time.sleep(max(0.0, self.begin + at - time.monotonic()))
            if stamp is not None:
                message.header.stamp = stamp + offset + rospy.Duration(clock_step(at))
            changed = change(topic, message, at)
            if changed is None:
                continue
            if topic in IMAGES:
                sides[stamp.to_nsec()] += 1
                self.original[message.header.stamp.to_nsec()] = seconds(stamp)
            self.publishers[topic].publish(changed)
        self.pairs = sum(count == 2 for count in sides.values())


class Recorder:
    """Records diagnostics, frames and odometry with the time of arrival (time.monotonic())."""

    def __init__(self):
        self.lock = threading.Lock()
        self.reports, self.frames, self.odometry, self.steps = [], [], [], []
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.report, queue_size=1000)
        rospy.Subscriber("vo/statistics", VoStatistics, lambda message: self.add(self.frames, message), queue_size=1000)
        rospy.Subscriber("vo/odometry", Odometry, lambda message: self.add(self.odometry, message), queue_size=1000)
        rospy.Subscriber("vo/relative_pose", RelativePose, lambda message: self.add(self.steps, message), queue_size=1000)

    def add(self, records, message):
        with self.lock:
            records.append((time.monotonic(), message))

    def report(self, message):
        for status in message.status:
            self.add(self.reports, status)

    def good_frames(self):
        """Returns the times of arrival of the frames with a measured pose."""
        return [when for when, frame in self.frames if frame.accepted and frame.status == OK]
