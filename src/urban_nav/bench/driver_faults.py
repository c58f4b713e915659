# SPDX-License-Identifier: BSD-3-Clause
"""Faults of drivers and computers as changes of the messages of a fault-free session."""
import copy
from dataclasses import dataclass
from typing import Callable

import numpy as np

try:
    import rospy
    from sensor_msgs.msg import PointCloud2, PointField
except ImportError:  # reported by the program
    rospy = None

LEFT, RIGHT, IMU, WHEELS, GPS, TF = "laser_left/scan", "laser_right/scan", "imu/data", "wheel_odom", "gps/fix", "tf_static"
LASERS = LEFT, RIGHT
IMAGES = "stereo/left/image_raw", "stereo/right/image_raw"
INFOS = "stereo/left/camera_info", "stereo/right/camera_info"
STEREO = (*IMAGES, *INFOS)
DEGREES = 180 / np.pi
G = 9.80665
WITH_GPS = "--set", "pose_graph.gps=true"


@dataclass(frozen=True)
class Change:
    """`alter(topic, message, t)` changes a message, t seconds after the start; False omits it, a list of (topic, message, recording) replaces it."""
    topics: tuple = ()
    alter: Callable = None

    def __call__(self, topic, message, received, t):
        result = self.alter(topic.strip("/"), message, t)
        if result is False:
            return
        for name, entry, number in result if isinstance(result, list) else [(topic, message, 0)]:
            yield name, entry, received, number


PLAIN = Change()


@dataclass(frozen=True)
class Fault(Change):
    """`words`: a regular expression that a finding fits which names the cause; empty: `map` reads it, and nothing has to be named. `options`: of `map`, for
    the sound session too. `sound`: what the session is compared with. `needs`: topics that the session must have too."""
    name: str = ""
    words: str = ""
    options: tuple = ()
    sound: Change = PLAIN
    needs: tuple = ()


def fault(name, topics, alter, words, **more):
    return Fault((topics,) if isinstance(topics, str) else topics, lambda _, message, t: alter(message, t), name, words, **more)


def scaled(**factors):
    """Multiplies numbers and lists of numbers of a message."""
    def alter(message, _):
        for key, factor in factors.items():
            value = getattr(message, key)
            setattr(message, key, (factor * np.asarray(value)).tolist() if isinstance(value, (tuple, list)) else factor * value)
    return alter


def assigned(**values):
    def alter(message, _):
        for key, value in values.items():
            setattr(message, key, value)
    return alter


def delayed(seconds, drift=0.0):
    def alter(message, t):
        message.header.stamp += rospy.Duration(seconds + drift * t)
    return alter


def ranges(factor):
    return scaled(ranges=factor, range_min=factor, range_max=factor)


def force(turned):
    def alter(message, _):
        a = message.linear_acceleration
        a.x, a.y, a.z = turned(np.array([a.x, a.y, a.z]))
    return alter


def rates(factor):
    def alter(message, _):
        w = message.angular_velocity
        w.x, w.y, w.z = factor * w.x, factor * w.y, factor * w.z
    return alter


def distances(factor):
    """Changes positions and speeds of wheel odometry."""
    def alter(message, _):
        p, v = message.pose.pose.position, message.twist.twist.linear
        p.x, p.y, v.x = factor * p.x, factor * p.y, factor * v.x
    return alter


def place(frame, change):
    """Changes the transform of a frame; False omits it."""
    def alter(message, _):
        message.transforms = [t for t in message.transforms if t.child_frame_id != frame or change(t.transform) is not False]
    return alter


def moved(factor):
    def change(transform):
        t = transform.translation
        t.x, t.y, t.z = factor * t.x, factor * t.y, factor * t.z
    return change


def stretched(factor):
    def change(transform):
        q = transform.rotation
        q.x, q.y, q.z, q.w = factor * q.x, factor * q.y, factor * q.z, factor * q.w
    return change


def contradicted(topic, message, _):
    other = copy.deepcopy(message)
    other.transforms = [t for t in other.transforms if t.child_frame_id == "laser_left"]
    other.transforms[0].transform.translation.z += 0.3
    return [(topic, message, 0), (topic, other, 0)]


def renamed(**names):
    """Renames topics; slashes are two underscores."""
    table = {old.replace("__", "/"): new.replace("__", "/") for old, new in names.items()}
    return tuple(table), lambda topic, message, _: [("/" + table[topic], message, 0)]


def exchanged(topic, scan, _):
    """Exchanges the cables of the lasers: each driver publishes the scans of the other device under its name."""
    here, there = ("laser_left", "laser_right") if "left" in topic else ("laser_right", "laser_left")
    scan.header.frame_id = scan.header.frame_id.replace(here, there)
    return [("/" + topic.replace(here, there), scan, 0)]


def as_clouds(topic, scan, _):
    """Publishes a planar laser as points."""
    distance = np.array(scan.ranges)
    keep = np.isfinite(distance) & (distance > scan.range_min) & (distance < scan.range_max)
    angle = scan.angle_min + scan.angle_increment * np.arange(len(distance))
    rows = np.zeros(keep.sum(), [(name, "<f4") for name in ("x", "y", "z", "intensity", "time")])
    rows["x"], rows["y"] = (distance * np.cos(angle))[keep], (distance * np.sin(angle))[keep]
    rows["time"] = (np.arange(len(distance)) * scan.time_increment)[keep]
    rows["intensity"] = np.array(scan.intensities)[keep] if scan.intensities else 0.0
    fields = [PointField(name, 4 * k, PointField.FLOAT32, 1) for k, name in enumerate(rows.dtype.names)]
    cloud = PointCloud2(header=scan.header, height=1, width=len(rows), point_step=20, row_step=20 * len(rows), is_dense=True, data=rows.tobytes(), fields=fields)
    return [("/" + topic.replace("scan", "points"), cloud, 0)]


def sixteen_bits(message, _):
    """Stores twelve bits in sixteen, with one pixel always bright."""
    grey = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)[:, :message.width].astype("<u2") * 16
    grey[5, 5] = 65535
    message.encoding, message.step, message.is_bigendian, message.data = "mono16", 2 * message.width, 0, grey.tobytes()


def baseline(factor):
    def alter(message, _):
        message.P = [*message.P[:3], factor * message.P[3], *message.P[4:]]
    return alter


def between_fixes(topic, fix, _):
    """The receiver reports 0, 0 between its fixes."""
    lost = copy.deepcopy(fix)
    lost.header.stamp += rospy.Duration(0.05)
    lost.latitude = lost.longitude = lost.altitude = 0.0
    return [("/" + topic, fix, 0), ("/" + topic, lost, 0)]


ALL = (*STEREO, *LASERS, IMU, WHEELS, GPS, TF)
HALF = 7.5  # s


def in_two(shift):
    """Makes two recordings with shifted stamps of the second one."""
    def alter(topic, message, t):
        if topic == TF:
            return [("/" + topic, copy.deepcopy(message), 0), ("/" + topic, message, 1)]
        if t < HALF:
            return [("/" + topic, message, 0)]
        message.header.stamp += rospy.Duration(shift)
        return [("/" + topic, message, 1)]
    return alter


def frozen_turn(message, t):
    if 3 < t < 6:
        message.angular_velocity.z = float("nan")


FAULTS = [
    fault("angles in degrees", LASERS, scaled(angle_min=DEGREES, angle_max=DEGREES, angle_increment=DEGREES), "in degrees"),
    fault("ranges in millimetres", LASERS, ranges(1000.0), "millimetres"),
    fault("ranges in centimetres", LEFT, ranges(100.0), "centimetres"),
    fault("ranges in feet", LASERS, ranges(1 / 0.3048), r"ranges are .* times the true"),
    fault("range_max of zero", LASERS, assigned(range_min=0.0, range_max=0.0), "range_max"),
    fault("scan_time not finite", LASERS, assigned(scan_time=float("nan")), "scan_time"),
    fault("time_increment in milliseconds", LASERS, scaled(time_increment=1000.0), "milliseconds"),
    fault("no angle_increment", LASERS, assigned(angle_increment=0.0), "angle_increment"),
    fault("stamps of the lasers 3 s early", LASERS, delayed(-3.0), "earlier"),
    fault("clock of a laser in 1970", LEFT, delayed(-1.2e9), "earlier"),
    fault("clock of the lasers drifts", LASERS, delayed(0.0, 0.02), "drifts"),
    Fault(*renamed(laser_left__scan="scan", laser_right__scan="scan_rear"), "other names of the lasers", "laser_left:="),
    Fault(LASERS, as_clouds, "points in place of scans", "PointCloud2"),
    Fault(LASERS, exchanged, "lasers exchanged", "exchanged"),
    fault("accelerometer of NED", IMU, force(lambda a: -a), "NED"),
    fault("axes of the accelerometer exchanged", IMU, force(lambda a: a[[2, 0, 1]]), "exchanged"),
    fault("accelerometer in g", IMU, force(lambda a: a / G), "unit is g"),
    fault("rates in deg/s", IMU, rates(DEGREES), "deg/s"),
    fault("clock of the IMU 2 s ahead", IMU, delayed(2.0), "later"),
    fault("rates not finite", IMU, frozen_turn, "not finite"),
    fault("wheels in millimetres", WHEELS, distances(1000.0), "millimetres"),
    fault("wheels count backwards", WHEELS, distances(-1.0), "wrong sign"),
    fault("stamps of the wheels 5 s early", WHEELS, delayed(-5.0), "earlier"),
    Fault((GPS,), between_fixes, "fixes at latitude 0", "latitude 0", options=WITH_GPS),
    fault("altitudes not finite", GPS, assigned(altitude=float("nan")), "altitude", options=WITH_GPS),
    fault("seconds of GPS for those of UTC", GPS, delayed(18.0), "later", options=WITH_GPS),
    Fault((TF,), contradicted, "two places of a laser", "contradict", needs=LASERS),
    fault("quaternion of length 1.02", TF, place("laser_left", stretched(1.02)), "quaternion", needs=LASERS),
    fault("place of a laser in millimetres", TF, place("laser_left", moved(1000.0)), "millimetres", needs=LASERS),
    fault("no place of a laser", TF, place("laser_left", lambda _: False), "no static tf", needs=LASERS),
    fault("12 bits in 16 with a hot pixel", IMAGES, sixteen_bits, ""),
    fault("baseline in millimetres", INFOS[1], baseline(1000.0), "millimetres"),
    fault("baseline of the wrong sign", INFOS[1], baseline(-1.0), "wrong sign"),
    fault("right camera 8 ms late", (IMAGES[1], INFOS[1]), delayed(0.008), "later than the left"),
    Fault(*renamed(stereo__left__image_raw="stereo/right/image_raw", stereo__right__image_raw="stereo/left/image_raw"), "cameras exchanged", "exchanged"),
    Fault(ALL, in_two(-HALF), "two recordings of one time", "same time", sound=Change(ALL, in_two(100.0))),
]
