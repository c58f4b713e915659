# SPDX-License-Identifier: BSD-3-Clause
"""Recording: every member as rosbag reads it, in every storage; views, selections, and what is wrong with an input."""
import copy
import gc
import pickle
import sys
import unittest
import warnings
from pathlib import Path

import genpy
import numpy as np
import rosbag
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from sensor_msgs.msg import CameraInfo, Image, Imu, JointState, PointCloud2, PointField
from std_msgs.msg import Duration, Empty, Header, String

import urban_nav
from urban_nav import _commands
from urban_nav._message import make_type

sys.path.insert(0, str(Path(__file__).resolve().parent))
from case import FolderCase  # noqa: E402

SECOND = 1_000_000_000


def header(i, frame="camera"):
    return Header(seq=i, stamp=genpy.Time(100 + i, 5), frame_id=frame)


def image(i):
    pixels = np.arange(6 * 8, dtype=np.uint8).reshape(6, 8) + i
    return Image(header=header(i), height=6, width=7, encoding="mono8", step=8, data=pixels.tobytes())


def cloud(i):
    points = np.zeros(5, dtype=[("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("ring", "<u2")])
    points["x"], points["ring"] = np.arange(5) + i, np.arange(5)
    fields = [PointField(name, offset, datatype, 1) for name, offset, datatype in (("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("ring", 12, 4))]
    return PointCloud2(header=header(i), height=1, width=5, fields=fields, point_step=14, row_step=70, data=points.tobytes(), is_dense=True)


def messages():
    """(topic, receipt in s, message) of the small recording."""
    for i in range(4):
        yield "/image", 200 + i, image(i)
        yield "/points", 200 + i, cloud(i)
        yield "/imu", 200.5 + i, Imu(header=header(3 - i, "imu"), linear_acceleration_covariance=[0.1 * k for k in range(9)])
    yield "/info", 204, CameraInfo(header=header(0), height=6, width=7, distortion_model="plumb_bob", D=[0.1, 0.2], K=[float(k) for k in range(9)])
    yield "/state", 204, JointState(header=header(0), name=["wheel", "räder"], position=[1.0, 2.0])
    status = DiagnosticStatus(level=2, name="laser", message="lost", values=[KeyValue("rate", "0")])
    yield "/diagnostics", 204, DiagnosticArray(header=header(0), status=[status, status])
    yield "/duration", 204, Duration(genpy.Duration(-2, 500000000))
    yield "/empty", 204, Empty()
    yield "/text", 204, String("grüße")


def differences(theirs, ours, path=""):
    """Members of a message of genpy that ours has differently."""
    if hasattr(theirs, "_type"):
        return [d for name in theirs.__slots__ if name != "seq" for d in differences(getattr(theirs, name), getattr(ours, name), f"{path}.{name}")]
    if isinstance(theirs, genpy.rostime.TVal):
        return [] if theirs.to_nsec() == ours else [path]
    if isinstance(theirs, bytes):
        return [] if theirs == ours.tobytes() else [path]
    if isinstance(theirs, (list, tuple)) and len(theirs) and hasattr(theirs[0], "_type"):
        return [path] if len(theirs) != len(ours) else [d for a, b in zip(theirs, ours) for d in differences(a, b, path)]
    if isinstance(theirs, (list, tuple)):
        return [] if list(theirs) == list(ours) else [path]
    return [] if theirs == ours else [path]


class Recordings(FolderCase):
    def setUp(self):
        super().setUp()
        self.bag = self.folder / "small.bag"
        with rosbag.Bag(str(self.bag), "w") as bag:
            for topic, receipt, message in messages():
                bag.write(topic, message, genpy.Time(receipt))

    def mcap(self):
        path = self.folder / "small.mcap"
        _commands._run("convert", {"INPUT": [str(self.bag)], "output": [str(path)]}, {})
        return path

    def test_every_member_is_that_of_rosbag_in_both_storages(self):
        with rosbag.Bag(str(self.bag)) as bag:
            theirs = sorted(((t, s.to_nsec(), i, m) for i, (t, m, s) in enumerate(bag.read_messages())), key=lambda row: row[:3])
        for path in (self.bag, self.mcap()):
            ours = sorted(((t, s, i, m) for i, (t, s, m) in enumerate(urban_nav.Recording(path))), key=lambda row: row[:3])
            self.assertEqual([row[:2] for row in ours], [row[:2] for row in theirs])
            self.assertEqual([d for a, b in zip(theirs, ours) for d in differences(a[3], b[3], a[0])], [])

    def test_contents_are_listed(self):
        for path, kind, encoding in ((self.bag, "bag", "ros1"), (self.mcap(), "mcap", "cdr")):
            recording = urban_nav.Recording(path)
            self.assertEqual(recording.kind, kind)
            topic = recording.topics["/points"]
            self.assertEqual((topic.type, topic.encoding, topic.messages), ("sensor_msgs/PointCloud2", encoding, 4))
            self.assertIn("fields", topic.definition)
            self.assertEqual((recording.start_ns, recording.end_ns), (200 * SECOND, 204 * SECOND))
            self.assertEqual(recording.warnings, [])

    def test_images_and_points_are_views(self):
        for path in (self.bag, self.mcap()):
            for _, _, message in urban_nav.Recording(path).messages(topics="/image"):
                self.assertEqual(message.image.shape, (6, 7))
                self.assertTrue(np.shares_memory(message.image, message.data))
                np.testing.assert_array_equal(message.image, message.data.reshape(6, 8)[:, :7])
            for i, (_, _, message) in enumerate(urban_nav.Recording(path).messages(topics=["/points"])):
                self.assertTrue(np.shares_memory(message.points, message.data))
                self.assertEqual(message.points.dtype.names, ("x", "y", "z", "ring"))
                np.testing.assert_array_equal(message.points["x"], np.arange(5) + i)
                np.testing.assert_array_equal(message.points["ring"], np.arange(5))

    def test_a_message_outlives_its_recording(self):
        recording = urban_nav.Recording(self.bag)
        kept = [m.image for _, _, m in recording.messages(topics=["/image"])]
        del recording
        gc.collect()
        for i, pixels in enumerate(kept):
            self.assertEqual(int(pixels[0, 0]), i)

    def test_interval_excludes_its_end(self):
        rows = list(urban_nav.Recording(self.bag).messages(topics=["/imu"], start_ns=201 * SECOND + SECOND // 2, end_ns=203 * SECOND + SECOND // 2))
        self.assertEqual([receipt for _, receipt, _ in rows], [201_500_000_000, 202_500_000_000])
        self.assertEqual(list(urban_nav.Recording(self.bag).messages(end_ns=0)), [])

    def test_header_order_is_that_of_the_stamps(self):
        stamps = [m.header.stamp for _, _, m in urban_nav.Recording(self.bag).messages(topics=["/imu"], order="header")]
        self.assertEqual(stamps, sorted(stamps))
        self.assertEqual(len(stamps), 4)
        received = [s for _, s, _ in urban_nav.Recording(self.bag).messages(topics=["/imu"])]
        self.assertEqual(received, sorted(received))
        self.fails(2, "expected file, header", urban_nav.Recording(self.bag).messages, order="stamp")

    def test_raw_messages_are_the_encoded_bytes(self):
        with rosbag.Bag(str(self.bag)) as bag:
            theirs = [(t, m[1]) for t, m, _ in bag.read_messages(topics=["/imu"], raw=True)]
        ours = [(t, bytes(m)) for t, _, m in urban_nav.Recording(self.bag).messages(topics=["/imu"], raw=True)]
        self.assertEqual(ours, theirs)

    def test_constants_are_of_the_class_and_messages_can_be_copied(self):
        message = next(iter(urban_nav.Recording(self.bag).messages(topics=["/diagnostics"])))[2]
        self.assertEqual(message.status[0].ERROR, 2)
        again = pickle.loads(pickle.dumps(message))
        self.assertEqual(again.status[1].values[0].key, "rate")
        self.assertEqual(again.status[1].STALE, 3)
        self.assertEqual(copy.deepcopy(message).header.stamp, message.header.stamp)
        self.assertIn("diagnostic_msgs/DiagnosticArray(", repr(message))

    def test_errors_name_the_topic_or_the_file(self):
        self.fails(2, "/nowhere", urban_nav.Recording(self.bag).messages, topics=["/nowhere"])
        text = self.folder / "text.bag"
        text.write_text("no recording\n")
        self.fails(2, "text.bag", urban_nav.Recording, text)
        self.fails(2, "absent.bag", urban_nav.Recording, self.folder / "absent.bag")

    def test_a_type_that_cannot_be_decoded_is_named(self):
        class Wide:
            _type, _md5sum, _full_text = "a/Wide", "0" * 32, "wstring text\n"

        with rosbag.Bag(str(self.bag), "a") as bag:
            bag.write("/wide", (Wide._type, b"\0\0\0\0", Wide._md5sum, None, Wide), genpy.Time(204), raw=True)
        recording = urban_nav.Recording(self.bag)
        self.fails(1, "wstring", list, recording.messages(topics=["/wide"]))
        with self.assertWarnsRegex(RuntimeWarning, "/wide.*wstring"):
            self.assertEqual(len(list(recording)), 18)
        self.assertEqual([bytes(m) for _, _, m in recording.messages(topics=["/wide"], raw=True)], [b"\0\0\0\0"])

    def test_nothing_is_warned_of_a_whole_recording(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(len(list(urban_nav.Recording(self.mcap()))), 18)


class Views(unittest.TestCase):
    def make(self, **members):
        cls = make_type("sensor_msgs/Image", ("height", "width", "encoding", "is_bigendian", "step", "data"), [])
        message = cls()
        for name, value in {"height": 2, "width": 3, "encoding": "mono8", "is_bigendian": 0, **members}.items():
            setattr(message, name, value)
        return message

    def test_encodings_give_type_and_channels(self):
        for encoding, big, dtype, shape in (("bgr8", 0, "u1", (2, 3, 3)), ("16UC1", 1, ">u2", (2, 3)), ("32FC2", 0, "<f4", (2, 3, 2)),
                                            ("bayer_rggb8", 0, "u1", (2, 3)), ("64FC1", 0, "<f8", (2, 3)), ("8UC", 0, "u1", (2, 3))):
            size = np.dtype(dtype).itemsize * (shape[2] if len(shape) == 3 else 1)
            message = self.make(encoding=encoding, is_bigendian=big, step=3 * size, data=np.arange(6 * size, dtype=np.uint8))
            self.assertEqual((message.image.dtype, message.image.shape), (np.dtype(dtype), shape), encoding)

    def test_data_that_are_too_short_and_unknown_encodings_are_errors(self):
        for members in ({"data": np.zeros(5, np.uint8), "step": 3}, {"data": np.zeros(6, np.uint8), "step": 2},
                        {"data": np.zeros(6, np.uint8), "step": 3, "encoding": "jpeg"}):
            with self.assertRaises(urban_nav.Error) as caught:
                self.make(**members).image
            self.assertEqual(caught.exception.status, 1)

    def test_an_empty_image_is_empty(self):
        self.assertEqual(self.make(height=0, width=0, step=0, data=np.zeros(0, np.uint8)).image.shape, (0, 0))

    def test_a_member_with_a_name_of_python_is_refused(self):
        with self.assertRaises(ValueError):
            make_type("a/B", ("__class__",), [])


if __name__ == "__main__":
    import rosunit
    rosunit.unitrun("urban_nav_python", "recording", "__main__")
