# SPDX-License-Identifier: BSD-3-Clause
"""Reads bags (format 2.0) with only the standard library and numpy, independently of the code under test."""
import bz2
import struct

import numpy as np

CHUNK, CONNECTION, MESSAGE = 5, 7, 2


def _records(data, start, end):
    """Yields (fields, data) of each record."""
    while start < end:
        size = struct.unpack_from("<I", data, start)[0]
        place, stop, fields = start + 4, start + 4 + size, {}
        while place < stop:
            length = struct.unpack_from("<I", data, place)[0]
            name, _, value = data[place + 4:place + 4 + length].partition(b"=")
            fields[name.decode()] = value
            place += 4 + length
        length = struct.unpack_from("<I", data, stop)[0]
        yield fields, data[stop + 4:stop + 4 + length]
        start = stop + 4 + length


def messages(path, wanted):
    """Yields (topic, bytes) of each message whose topic, without leading slash, is in `wanted`."""
    data, topics = path.read_bytes(), {}
    magic = b"#ROSBAG V2.0\n"
    if not data.startswith(magic):
        raise ValueError(f"{path} is no bag of format 2.0")

    def inside(part, start):
        for fields, body in _records(part, start, len(part)):
            kind = fields["op"][0]
            if kind == CHUNK:
                packed = fields["compression"]
                if packed not in (b"none", b"bz2"):
                    raise ValueError(f"{path}: chunks packed by {packed.decode()}")
                yield from inside(bz2.decompress(body) if packed == b"bz2" else body, 0)
            elif kind == CONNECTION:
                topics[fields["conn"]] = fields["topic"].decode().strip("/")
            elif kind == MESSAGE and topics[fields["conn"]] in wanted:
                yield topics[fields["conn"]], body
    yield from inside(data, len(magic))


def _text(body, place):
    size = struct.unpack_from("<I", body, place)[0]
    return body[place + 4:place + 4 + size].decode().strip("/"), place + 4 + size


def header(body, place=0):
    """Returns stamp (s), frame, and the offset of the remaining bytes."""
    _, seconds, nanoseconds = struct.unpack_from("<3I", body, place)
    frame, rest = _text(body, place + 12)
    return seconds + 1e-9 * nanoseconds, frame, rest


def transforms(body):
    """Yields (parent, child, 4x4 matrix) of a tf2_msgs/TFMessage."""
    count, place = struct.unpack_from("<I", body)[0], 4
    for _ in range(count):
        _, parent, place = header(body, place)
        child, place = _text(body, place)
        x, y, z, qx, qy, qz, qw = struct.unpack_from("<7d", body, place)
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = rotation([qx, qy, qz, qw]), (x, y, z)
        yield parent, child, matrix
        place += 56


def scan(body):
    """Returns stamp, frame, angles, times after the stamp, ranges of a sensor_msgs/LaserScan."""
    stamp, frame, place = header(body)
    first, _, step, apart, _, _, _, count = struct.unpack_from("<7fI", body, place)
    ranges = np.frombuffer(body, "<f4", count, place + 32).astype(float)
    return stamp, frame, first + step * np.arange(count), apart * np.arange(count), ranges


def rate(body):
    """Returns stamp, frame, angular velocity of a sensor_msgs/Imu."""
    stamp, frame, place = header(body)
    return stamp, frame, np.array(struct.unpack_from("<3d", body, place + 32 + 72))


def force(body):
    """Returns the specific force of a sensor_msgs/Imu."""
    return np.array(struct.unpack_from("<3d", body, header(body)[2] + 32 + 72 + 24 + 72))


def speeds(body):
    """Returns stamp, forward speed and yaw rate of a nav_msgs/Odometry."""
    stamp, _, place = header(body)
    place = _text(body, place)[1] + 8 * (7 + 36)
    return stamp, np.array(struct.unpack_from("<d32xd", body, place))


def velocity(body):
    """Returns stamp, linear velocity of a geometry_msgs/TwistStamped."""
    stamp, _, place = header(body)
    return stamp, np.array(struct.unpack_from("<3d", body, place))


def image(body):
    """Returns stamp (ns), pixels of an 8-bit grey sensor_msgs/Image."""
    _, seconds, nanoseconds = struct.unpack_from("<3I", body)
    place = header(body)[2]
    height, width = struct.unpack_from("<2I", body, place)
    encoding, place = _text(body, place + 8)
    step = struct.unpack_from("<I", body, place + 1)[0]
    if encoding != "mono8":
        raise ValueError(f"an image of {encoding}, not mono8")
    pixels = np.frombuffer(body, np.uint8, height * step, place + 9).reshape(height, step)
    return 1_000_000_000 * seconds + nanoseconds, pixels[:, :width]


def camera_info(body):
    """Returns D, K, R, P of a sensor_msgs/CameraInfo."""
    place = header(body)[2] + 8
    place = _text(body, place)[1]
    count = struct.unpack_from("<I", body, place)[0]
    numbers = np.frombuffer(body, "<f8", count + 30, place + 4)
    rest = numbers[count:]
    return numbers[:count], rest[:9].reshape(3, 3), rest[9:18].reshape(3, 3), rest[18:].reshape(3, 4)


def rotation(quaternion):
    """Returns the matrices of (..., 4) quaternions x, y, z, w."""
    x, y, z, w = np.moveaxis(np.asarray(quaternion, float), -1, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return np.stack([np.stack(row, -1) for row in rows], -2)
