# SPDX-License-Identifier: BSD-3-Clause
"""Classes of messages, generated from the definitions in recordings."""
import re

import numpy as np

from ._error import Error

_NUMBERS = {"8U": "u1", "8S": "i1", "16U": "u2", "16S": "i2", "32S": "i4", "32F": "f4", "64F": "f8"}
_CHANNELS = {"mono8": ("u1", 1), "mono16": ("u2", 1), "rgb8": ("u1", 3), "bgr8": ("u1", 3), "rgba8": ("u1", 4), "bgra8": ("u1", 4),
             "rgb16": ("u2", 3), "bgr16": ("u2", 3), "rgba16": ("u2", 4), "bgra16": ("u2", 4), "yuv422": ("u1", 2), "yuv422_yuy2": ("u1", 2)}
_POINT_FIELDS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}


class Message:
    """A message of a recording.

    Members have their ROS 1 names, whatever the recording's storage: numbers are int, float or bool, texts str, times and durations
    int (ns), messages Message, arrays of numbers numpy views on the bytes of the message, other arrays lists. `_type` is the name of
    the type ("sensor_msgs/Imu"). Constants of the definition are attributes of the class.
    """

    __slots__ = ()
    _type = ""

    def __repr__(self):
        return f"{self._type}({', '.join(f'{name}={getattr(self, name)!r}' for name in self.__slots__)})"

    def __reduce__(self):
        constants = {name: value for name, value in vars(type(self)).items() if name in type(self)._constants}
        return _restore, (self._type, self.__slots__, constants, [getattr(self, name) for name in self.__slots__])

    _constants = ()


class _Image(Message):
    __slots__ = ()

    @property
    def image(self):
        """The pixels as a view on `data`, H x W or H x W x channels, of the type that `encoding` names.

        Nothing is copied and no colour is converted: channels come in the order of the encoding.
        """
        number, channels = _pixel(self.encoding)
        dtype = np.dtype((">" if self.is_bigendian else "<") + number)
        size = dtype.itemsize
        shape = (self.height, self.width, channels)
        strides = (self.step, size * channels, size)
        needed = (self.height - 1) * self.step + self.width * size * channels if self.height and self.width else 0
        if needed > self.data.size or self.height and self.step < self.width * size * channels:
            raise Error(f"image of {self.width}x{self.height} px, {self.encoding}: {self.data.size} bytes of data, step {self.step}: "
                        f"expected at least {needed} bytes", 1)
        pixels = np.ndarray(shape, dtype, self.data, 0, strides)
        return pixels[:, :, 0] if channels == 1 else pixels


class _PointCloud(Message):
    __slots__ = ()

    @property
    def points(self):
        """The points as a structured view on `data`, one field per PointField: n of them, or H x W of an organised cloud."""
        names, formats, offsets = [], [], []
        for field in self.fields:
            number = _POINT_FIELDS.get(field.datatype)
            if number is None:
                raise Error(f"point field {field.name}: datatype {field.datatype}: expected 1...8", 1)
            dtype = np.dtype((">" if self.is_bigendian else "<") + number)
            count = max(field.count, 1)
            if field.offset + dtype.itemsize * count > self.point_step:
                raise Error(f"point field {field.name}: ends beyond the point_step of {self.point_step} bytes", 1)
            names.append(field.name)
            formats.append(dtype if count == 1 else (dtype, (count,)))
            offsets.append(field.offset)
        try:
            point = np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": self.point_step})
        except ValueError as error:
            raise Error(f"fields of a point cloud: {error}", 1) from error
        needed = (self.height - 1) * self.row_step + self.width * self.point_step if self.height and self.width else 0
        if needed > self.data.size:
            raise Error(f"point cloud of {self.width}x{self.height} points: {self.data.size} bytes of data: expected at least {needed}", 1)
        points = np.ndarray((self.height, self.width), point, self.data, 0, (self.row_step, self.point_step))
        return points[0] if self.height == 1 else points


_BASES = {"sensor_msgs/Image": _Image, "sensor_msgs/PointCloud2": _PointCloud}
_classes = {}


def _pixel(encoding):
    if encoding in _CHANNELS:
        return _CHANNELS[encoding]
    if encoding.startswith("bayer_"):
        return ("u2" if encoding.endswith("16") else "u1"), 1
    match = re.fullmatch(r"(8U|8S|16U|16S|32S|32F|64F)C?(\d*)", encoding)
    if match and match.group(2) != "0":
        return _NUMBERS[match.group(1)], int(match.group(2) or 1)
    raise Error(f"image encoding {encoding}: expected {', '.join(_CHANNELS)}, bayer_..., and those of OpenCV such as 16UC1", 1)


def _value(kind, text):
    """The value of a constant: a text as it is, a number else."""
    if kind in ("string", "wstring"):
        return text
    if kind == "bool":
        return text.lower() in ("true", "1")
    return float(text) if kind.startswith("float") else int(text, 0)


def make_type(name, members, constants):
    """The class of a message type. `members`: their names in order; `constants`: "uint8 NAME=1". ValueError for names that Python
    cannot use."""
    values = {}
    for line in constants:
        kind, rest = line.split(" ", 1)
        key, text = rest.split("=", 1)
        try:
            values[key] = _value(kind, text)
        except ValueError:
            continue  # of no use to a reader
    return _class(name, tuple(members), values)


def _class(name, members, constants):
    key = name, members, tuple(sorted(constants))
    if key not in _classes:
        for member in members:
            if not member.isidentifier() or member.startswith("_"):
                raise ValueError(f"{name} has a member {member!r}")
        base = _BASES.get(name, Message)
        constants = {k: v for k, v in constants.items() if k.isidentifier() and not k.startswith("_") and k not in members}
        content = {**constants, "__slots__": members, "__module__": "urban_nav", "__doc__": base.__doc__, "_type": name,
                   "_constants": tuple(constants)}
        if name == "std_msgs/Header" and "seq" not in members:
            content["seq"] = 0  # which ROS 2 does not have
        _classes[key] = type(name.rsplit("/", 1)[-1], (base,), content)
    return _classes[key]


def _restore(name, members, constants, values):
    message = _class(name, members, constants)()
    for member, value in zip(members, values):
        setattr(message, member, value)
    return message
