# SPDX-License-Identifier: BSD-3-Clause
"""The reader that knows nothing of ROS, beside what rosbag has written."""
import unittest

import cv2
import numpy as np
import rosbag
import rospy
from geometry_msgs.msg import TransformStamped, TwistStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, Image, Imu, LaserScan
from tf2_msgs.msg import TFMessage

from case import FolderCase, Spiral, run
import bags

STAMP = rospy.Time(1225719875, 123456789)


def stamped(message, frame="there", stamp=STAMP):
    message.header.stamp, message.header.frame_id = stamp, frame
    return message


def vector(target, x, y, z):
    target.x, target.y, target.z = x, y, z


class Bags(FolderCase):
    def read(self, messages, wanted=None, compression="none"):
        """What is read of topics as they were written: (topic, bytes)."""
        path = self.folder / "session.bag"
        with rosbag.Bag(str(path), "w", compression=compression) as bag:
            for topic, message in messages:
                bag.write(topic, message, STAMP)
        return list(bags.messages(path, wanted or {topic.strip("/") for topic, _ in messages}))

    def body(self, message):
        (_, body), = self.read([("topic", message)])
        return body

    def test_messages_come_in_their_order_and_of_the_topics_asked_for(self):
        written = [("/a" if i % 3 else "b", stamped(Imu(), f"{i}")) for i in range(20)]
        for compression in ("none", "bz2"):
            found = self.read(written, {"a"}, compression)
            self.assertEqual([topic for topic, _ in found], ["a"] * 13)
            self.assertEqual([bags.header(body)[1] for _, body in found], [str(i) for i in range(20) if i % 3])

    def test_what_it_cannot_read_it_says(self):
        with self.assertRaisesRegex(ValueError, "lz4"):
            self.read([("a", Imu())], compression="lz4")
        other = self.folder / "other"
        other.write_bytes(b"#ROSBAG V1.2\n")
        with self.assertRaisesRegex(ValueError, "no bag of format 2.0"):
            list(bags.messages(other, {"a"}))

    def test_imu(self):
        imu = stamped(Imu())
        imu.orientation_covariance[0], imu.angular_velocity_covariance[8] = -1, 7
        vector(imu.angular_velocity, 0.1, -0.2, 0.3)
        vector(imu.linear_acceleration, 1, 2, 9.81)
        stamp, frame, rate = bags.rate(self.body(imu))
        self.assertAlmostEqual(stamp, STAMP.to_sec(), places=6)
        self.assertEqual(frame, "there")
        self.assertEqual(list(rate), [0.1, -0.2, 0.3])
        self.assertEqual(list(bags.force(self.body(imu))), [1, 2, 9.81])

    def test_scan(self):
        scan = stamped(LaserScan(angle_min=-1.5, angle_max=9, angle_increment=0.25, time_increment=0.5, scan_time=7, range_min=8, range_max=9,
                                 ranges=[1, float("inf"), 3], intensities=[5, 6, 7]), "/laser")
        stamp, frame, angles, delays, ranges = bags.scan(self.body(scan))
        self.assertEqual(frame, "laser")
        self.assertEqual([list(angles), list(delays), list(ranges)], [[-1.5, -1.25, -1.0], [0, 0.5, 1.0], [1, float("inf"), 3]])

    def test_transforms(self):
        ride, message = Spiral(), TFMessage()
        for i, when in enumerate((101.0, 107.5)):
            link = stamped(TransformStamped(child_frame_id=f"/sensor{i}"), "base_link")
            vector(link.transform.translation, *ride.position(when))
            (link.transform.rotation.x, link.transform.rotation.y, link.transform.rotation.z,
             link.transform.rotation.w) = ride.quaternion(when)
            message.transforms.append(link)
        found = list(bags.transforms(self.body(message)))
        self.assertEqual([link[:2] for link in found], [("base_link", "sensor0"), ("base_link", "sensor1")])
        for (_, _, matrix), when in zip(found, (101.0, 107.5)):
            np.testing.assert_allclose(matrix, ride.pose(when), atol=1e-12)

    def test_speeds_and_velocity(self):
        wheels, gps = stamped(Odometry(child_frame_id="base_link")), stamped(TwistStamped())
        vector(wheels.twist.twist.linear, 1.5, 8, 8)
        vector(wheels.twist.twist.angular, 8, 8, -0.3)
        wheels.pose.covariance[35] = 8
        vector(gps.twist.linear, 1, 2, 3)
        self.assertEqual(list(bags.speeds(self.body(wheels))[1]), [1.5, -0.3])
        self.assertEqual(list(bags.velocity(self.body(gps))[1]), [1, 2, 3])

    def test_image_with_rows_that_are_padded(self):
        pixels = np.arange(24, dtype=np.uint8).reshape(3, 8)
        image = stamped(Image(height=3, width=5, encoding="mono8", step=8, data=pixels.tobytes()))
        stamp, found = bags.image(self.body(image))
        self.assertEqual(stamp, STAMP.to_nsec())
        np.testing.assert_array_equal(found, pixels[:, :5])
        image.encoding = "bgr8"
        with self.assertRaisesRegex(ValueError, "bgr8"):
            bags.image(self.body(image))

    def test_camera_info(self):
        info = stamped(CameraInfo(height=384, width=512, distortion_model="plumb_bob", D=[0.1, 0.2], K=range(9), R=range(9, 18), P=range(18, 30)))
        D, K, R, P = bags.camera_info(self.body(info))
        self.assertEqual([list(D), K[1, 0], R[2, 2], P[2, 3], P[0, 0]], [[0.1, 0.2], 3, 17, 29, 18])


class Rotations(unittest.TestCase):
    def test_of_quaternions(self):
        vectors = np.random.default_rng(3).normal(size=(5, 4, 3))
        sizes = np.linalg.norm(vectors, axis=-1, keepdims=True)
        quaternions = np.concatenate([vectors / sizes * np.sin(sizes / 2), np.cos(sizes / 2)], -1)
        found = bags.rotation(quaternions)
        for i, j in np.ndindex(5, 4):
            np.testing.assert_allclose(found[i, j], cv2.Rodrigues(vectors[i, j])[0], atol=1e-12)


if __name__ == "__main__":
    run("bench_bags")
