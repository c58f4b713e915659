# SPDX-License-Identifier: BSD-3-Clause
"""Files of the suite as arrays."""
import csv
import io
from pathlib import Path

import numpy as np

from ._error import Error

_PLY_NUMBERS = {"char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
                "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4", "double": "f8", "float64": "f8"}
_WHOLE = ("stamp_a_ns", "stamp_b_ns")
_TEXTS = ("session_a", "session_b", "kind", "verdict", "reason")


def closure_table(text):
    """closures.csv as a structured array: stamps int64 (ns), texts str, numbers float64, NaN for an empty cell."""
    rows = list(csv.reader(io.StringIO(text)))
    names, rows = rows[0], rows[1:]
    formats = []
    for i, name in enumerate(names):
        width = max((len(row[i]) for row in rows), default=1)
        formats.append("i8" if name in _WHOLE else f"U{max(width, 1)}" if name in _TEXTS else "f8")
    table = np.empty(len(rows), dtype={"names": names, "formats": formats})
    for i, (name, kind) in enumerate(zip(names, formats)):
        if kind == "f8":
            table[name] = [float(row[i]) if row[i] else np.nan for row in rows]
        else:
            table[name] = [int(row[i]) if kind == "i8" else row[i] for row in rows]
    return table


def read_pfm(path):
    """A PFM file of one channel as H x W float32, the first row at the top."""
    content = Path(path).read_bytes()
    kind, size, scale, pixels = content.split(b"\n", 3)
    if kind.strip() != b"Pf":
        raise Error(f"{path}: a PFM file of another kind: expected one channel", 1)
    width, height = (int(word) for word in size.split())
    dtype = "<f4" if float(scale) < 0 else ">f4"
    return np.frombuffer(pixels, dtype, width * height).reshape(height, width)[::-1].astype(np.float32)


def read_ply(path):
    """The vertices of a binary PLY file as a structured array, one field per property."""
    with open(path, "rb") as file:
        fields, count, lines = [], None, []
        while not lines or lines[-1] != "end_header":
            line = file.readline()
            if not line:
                raise Error(f"{path}: the header of a PLY file does not end", 1)
            lines.append(line.decode("ascii", "replace").strip())
        in_vertices = False
        for words in (line.split() for line in lines):
            if words[:1] == ["element"]:
                in_vertices = words[1] == "vertex"
                count = int(words[2]) if in_vertices else count
            elif words[:1] == ["property"] and in_vertices:
                fields.append((words[2], "<" + _PLY_NUMBERS[words[1]]))
        if "format binary_little_endian 1.0" not in lines or count is None:
            raise Error(f"{path}: a PLY file of another kind: expected binary_little_endian with vertices", 1)
        return np.fromfile(file, np.dtype(fields), count)


def write_points(path, points, name):
    """Writes an array n x 3 (m) as a binary PLY file. Throws Error for another shape."""
    points = np.asarray(points)
    if points.ndim != 2 or points.shape[1] != 3 or points.dtype.kind not in "fiu":
        raise Error(f"{name}: an array {points.shape} of {points.dtype}: expected n x 3 numbers (m), or a file")
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
              "property double x\nproperty double y\nproperty double z\nend_header\n")
    Path(path).write_bytes(header.encode() + np.ascontiguousarray(points, dtype="<f8").tobytes())
