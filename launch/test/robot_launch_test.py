#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""robot.launch on simulated devices that a bag feeds, as a user starts it: every device comes, odometry runs on the stereo driver's images, a pulled plug is reported and survived, what is recorded gives the bits of the live run again, and all ends clean."""
import os
import subprocess
import sys
import time
from pathlib import Path

import rosbag
import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CompressedImage, Image, Imu, LaserScan, NavSatFix
from urban_nav_msgs.msg import RawFrame, VoStatistics

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import Launched, camera_is_connected, command, connections, services, subscriptions  # noqa: E402
from launch_case import ALL_SENSORS, LaunchCase  # noqa: E402

TOPICS = {"/laser_left/scan": LaserScan, "/laser_right/scan": LaserScan, "/imu/data": Imu, "/wheel_odom": Odometry, "/gps/fix": NavSatFix,
          "/stereo/left/image_raw": Image, "/ladybug/raw": RawFrame, "/ladybug/camera2/image_raw/compressed": CompressedImage, "/vo/odometry": Odometry}
SECONDS = 24
LEAD = 4  # s from the call that begins the session of the devices to that begin, in which drivers find their ports
STEREO_TOPICS = {"/tf_static", *(f"/stereo/{side}/{topic}" for side in ("left", "right") for topic in ("image_raw", "camera_info"))}


def longest_gap(messages):
    """Seconds between the stamps of successive messages."""
    stamps = [message.header.stamp.to_sec() for message in list(messages)]
    return max((later - earlier for earlier, later in zip(stamps, stamps[1:])), default=0.0)


class RobotLaunch(LaunchCase):
    @classmethod
    def record(cls, folder):
        rospy.set_param("/swf_vo/tf_timeout", 3600.0)  # s
        # The stereo camera waits for the odometry, so that no pair is left out, and no image for a recorder.
        rospy.set_param("/bumblebee2/paced_by", "vo/statistics")
        rospy.set_param("/bumblebee2/image_queue", 1000)
        return cls.simulated(folder, SECONDS, *ALL_SENSORS)[0]

    def launch_held(self, name, **arguments):
        """robot.launch with devices that are absent until begin_session(): all nodes are there before, however long they take."""
        self.ports = Path(self.folder) / name
        self.session_begin = self.ports / "session_begin"
        os.makedirs(self.ports)
        self.launch("robot.launch", simulated=self.bag, ports=self.ports, loops="false", session_begin=self.session_begin, session_held="true", **arguments)
        drivers = {f"/{device}/get_loggers" for device in ("bumblebee2", "ladybug2", "laser_left/driver", "laser_right/driver", "xsens_mti", "segway_rmp", "gps")}
        self.expect(lambda: drivers <= services(), lambda: f"drivers: {drivers - services()} are absent")
        self.expect(camera_is_connected, lambda: f"only {connections('/stereo_manager')}")
        self.expect(lambda: self.listener.connected("base_link", "stereo_left_optical_frame"), lambda: str(self.listener.links))
        self.expect(lambda: {self.diagnosed_device(device) for device in ("laser_left", "bumblebee2", "ladybug2")} == {True}, "drivers that report")

    def diagnosed_device(self, name):
        return bool(self.statuses(name))

    def begin_session(self):
        proposal = self.session_begin.with_suffix(".new")
        proposal.write_text(str(time.clock_gettime_ns(time.CLOCK_MONOTONIC) + LEAD * 10**9))
        os.rename(proposal, self.session_begin)

    def statuses(self, name):
        """What one driver has reported, oldest first."""
        return [status for array in list(self.listener.diagnostics) for status in array.status if status.name.lstrip("/").startswith(name)]

    def states(self, name):
        return [status.message for status in self.statuses(name)]

    def has_recovered(self, name):
        """Whether the driver streams after it was lost."""
        states = self.states(name)
        return "lost" in states and "streaming" in states[len(states) - states[::-1].index("lost"):]

    def test_a_robot_without_hardware_survives_a_pulled_plug(self):
        received = {topic: [] for topic in TOPICS}
        subscribers = [rospy.Subscriber(topic, kind, received[topic].append, queue_size=1000) for topic, kind in TOPICS.items()]
        self.launch_held("devices", laser_left_fault="unplug:8:5")
        self.expect(lambda: all(subscriber.get_num_connections() for subscriber in subscribers), "connections")
        self.begin_session()
        self.expect(lambda: all(len(messages) > 1 for messages in received.values()), lambda: {topic: len(messages) for topic, messages in received.items()})
        self.expect(lambda: self.has_recovered("laser_left"), lambda: f"the pulled plug is not reported, or not survived: {self.states('laser_left')}")
        self.expect(lambda: longest_gap(received["/laser_left/scan"]) > 1.0, "no scan came after the plug was back")
        self.assertIn("1", [item.value for item in self.statuses("laser_left")[-1].values if item.key == "reconnections"])
        for camera in ("bumblebee2", "ladybug2"):
            self.assertIn("streaming", self.states(camera))
        for subscriber in subscribers:
            subscriber.unregister()
        with rosbag.Bag(str(self.bag)) as bag:
            ranges = {tuple(round(r, 3) for r in message.ranges) for _, message, _ in bag.read_messages(["laser_left/scan", "/laser_left/scan"])}
        for scan in received["/laser_left/scan"]:
            self.assertIn(tuple(round(r, 3) for r in scan.ranges), ranges)
        for messages in received.values():
            stamps = [message.header.stamp.to_nsec() for message in messages]
            self.assertEqual(stamps, sorted(stamps))

    def record_cameras(self):
        """record.launch for what the odometry reads, which nobody publishes yet; gives the beginning of the names of its bags."""
        prefix = Path(self.folder) / "recorded"
        recorder = Launched("record.launch", output=prefix, topics=" ".join(STEREO_TOPICS), least_speed=1)
        self.addCleanup(lambda: recorder.process.poll() is None and recorder.stop())
        self.expect(lambda: STEREO_TOPICS <= subscriptions("/record"), lambda: f"the recorder waits for {subscriptions('/record')}\n{recorder.output()}")
        return recorder, prefix

    def test_what_is_recorded_gives_the_bits_of_the_live_run_again(self):
        recorder, prefix = self.record_cameras()
        self.launch_held("recorded_devices", motion_input="none")  # only the cameras are recorded
        self.expect(lambda: STEREO_TOPICS <= connections("/record"), lambda: f"the recorder hears {connections('/record')}\n{recorder.output()}")
        self.begin_session()
        self.expect(lambda: len(self.listener.frames) >= 30, lambda: f"{len(self.listener.frames)} frames")
        self.assertEqual(recorder.stop(), "")
        recorded, = prefix.parent.glob(f"{prefix.name}_*.bag")
        with rosbag.Bag(str(recorded)) as bag:
            last = min(max(message.header.stamp for _, message, _ in bag.read_messages([f"/stereo/{side}/image_raw"])) for side in ("left", "right"))
            pairs = Path(self.folder) / "until_the_recorder_ended.bag"
            with rosbag.Bag(str(pairs), "w") as target:
                for topic, message, received in bag.read_messages():
                    if topic == "/tf_static" or message.header.stamp <= last:
                        target.write(topic, message, received)
        self.expect(lambda: self.listener.odometry[-1].header.stamp >= last, "the odometry of the last pair that was recorded")
        self.listener.odometry = [message for message in self.listener.odometry if message.header.stamp <= last]
        out = Path(self.folder) / "again"
        subprocess.run([command(), "map", str(pairs), "--stages", "vo", "--out", str(out)], check=True, stdout=subprocess.DEVNULL)
        self.expect_bits(out)
        self.assertEqual([frame.message for frame in list(self.listener.frames) if frame.status == VoStatistics.LOST], [])


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "robot_launch", RobotLaunch)
