#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""robot.launch on simulated devices that a bag feeds, as a user starts it: every device comes, odometry runs on the stereo driver's images, a pulled plug is reported and survived, what is recorded gives the bits of the live run again, and all ends clean."""
import subprocess
import sys
from pathlib import Path

import rosbag
import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CompressedImage, Image, Imu, LaserScan, NavSatFix
from urban_nav_msgs.msg import RawFrame, VoStatistics

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import Launched, command, connections, subscriptions  # noqa: E402
from launch_case import ALL_SENSORS, LaunchCase  # noqa: E402

TOPICS = {"/laser_left/scan": LaserScan, "/laser_right/scan": LaserScan, "/imu/data": Imu, "/wheel_odom": Odometry, "/gps/fix": NavSatFix,
          "/stereo/left/image_raw": Image, "/ladybug/raw": RawFrame, "/ladybug/camera2/image_raw/compressed": CompressedImage, "/vo/odometry": Odometry}
SECONDS = 24  # the tests end long before, but not on a machine that takes ten seconds to start all nodes
STEREO_TOPICS = {"/tf_static", *(f"/stereo/{side}/{topic}" for side in ("left", "right") for topic in ("image_raw", "camera_info"))}


def longest_gap(messages):
    """Seconds between the stamps of successive messages."""
    stamps = [message.header.stamp.to_sec() for message in list(messages)]
    return max((later - earlier for earlier, later in zip(stamps, stamps[1:])), default=0.0)


class RobotLaunch(LaunchCase):
    @classmethod
    def record(cls, folder):
        return cls.simulated(folder, SECONDS, *ALL_SENSORS)[0]

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
        self.launch("robot.launch", simulated=self.bag, ports=Path(self.folder) / "devices", loops="false", laser_left_fault="unplug:5:1.5")
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
        # The recorder is there before the devices begin, whose session is short.
        recorder, prefix = self.record_cameras()
        self.launch("robot.launch", simulated=self.bag, ports=Path(self.folder) / "recorded_devices", loops="false")
        self.expect(lambda: self.listener.odometry, "odometry")
        self.expect(lambda: STEREO_TOPICS <= connections("/record"), lambda: f"the recorder hears {connections('/record')}\n{recorder.output()}")
        # Now that the recorder hears all, the odometry begins again: from here on both have the same images.
        subprocess.run(["rosservice", "call", "/swf_vo/reset"], check=True, stdout=subprocess.DEVNULL)
        self.expect(lambda: self.session_frames(), "a frame after the reset")
        self.expect(lambda: len(self.session_frames()) >= 30, lambda: f"{len(self.session_frames())} frames")
        self.assertEqual(recorder.stop(), "")
        recorded, = prefix.parent.glob(f"{prefix.name}_*.bag")
        begin = self.session_frames()[0].header.stamp
        with rosbag.Bag(str(recorded)) as bag:
            last = min(max(message.header.stamp for _, message, _ in bag.read_messages([f"/stereo/{side}/image_raw"])) for side in ("left", "right"))
            pairs = Path(self.folder) / "since_the_reset.bag"
            with rosbag.Bag(str(pairs), "w") as target:
                for topic, message, received in bag.read_messages():
                    if topic == "/tf_static" or begin <= message.header.stamp <= last:
                        target.write(topic, message, received)
        self.expect(lambda: self.listener.odometry[-1].header.stamp >= last, "the odometry of the last pair that was recorded")
        self.listener.odometry = [message for message in self.listener.odometry if begin <= message.header.stamp <= last]
        out = Path(self.folder) / "again"
        subprocess.run([command(), "map", str(pairs), "--stages", "vo", "--out", str(out)], check=True, stdout=subprocess.DEVNULL)
        self.expect_bits(out)
        self.assertEqual([frame.message for frame in self.session_frames() if frame.status == VoStatistics.LOST], [])

    def session_frames(self):
        """The frames of the odometry since its newest session began."""
        frames = list(self.listener.frames)
        begin = max((k for k, frame in enumerate(frames) if frame.frame == 0 and k > 0), default=None)
        return frames[begin:] if begin is not None else []


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "robot_launch", RobotLaunch)
