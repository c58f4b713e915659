# SPDX-License-Identifier: BSD-3-Clause
"""Estimators for a loop of one's own."""
from typing import Any, NamedTuple

import numpy as np

from ._commands import _word
from ._error import Error


class Frame(NamedTuple):
    """Result of visual odometry for one stereo pair.

    `stamp_ns`; `accepted`: False if it was dropped because of its stamp; `status` "OK", "DEGRADED", "LOST" or "RECOVERED", with
    `reason` and `sentence`; `T_first_left`: 4 x 4 (m), the left camera relative to its first pose, in optical axes (x right, y down,
    z forward); `covariance`: 6 x 6 of it, tangent (translation, m; rotation, rad) in the axes of the first pose; `features`: n x 3
    (u_left, v, u_right), px of the rectified images.
    """

    stamp_ns: int
    accepted: bool
    status: str
    reason: str
    sentence: str
    T_first_left: Any
    covariance: Any
    features: Any


class Vo:
    """Stereo visual odometry by a sliding window, as the stage vo of `map` runs it, without other sensors.

    `left_info`, `right_info`: messages sensor_msgs/CameraInfo, or objects with their members. `rectified`: the images are rectified
    already, whatever the distortion in the calibration. Parameters are those of the stage swf_vo: `window=25`. Not thread-safe.
    Throws Error if the two are not a stereo pair, and for a parameter that does not exist or is out of range.
    """

    def __init__(self, left_info, right_info, *, rectified=False, **parameters):
        from . import _suite

        self._vo = _suite.Vo(_camera(left_info, "left_info"), _camera(right_info, "right_info"), bool(rectified), _settings(parameters))

    def add(self, stamp_ns, left, right):
        """Adds one pair, in order of time; returns a Frame.

        `stamp_ns`: int, ns. `left`, `right`: H x W, uint8, grey, of the size of the calibration; None if an image is missing, which
        gives a frame with a status. Throws Error for arrays of another shape or type.
        """
        return Frame(**self._vo.add(int(stamp_ns), _grey(left, "left"), _grey(right, "right")))


class Relaxation:
    """A pose graph that is relaxed as a whole, as the stage graph of `map` does it: least squares with rejection of false edges.

    Parameters are those of the stage pose_graph: `robust=False` uses every edge as given. The first pose stays in its place. With
    `robust`, the first edge between two consecutive ids is odometry, which is trusted; all others are closures.
    """

    def __init__(self, **parameters):
        from . import _suite

        self._relaxation = _suite.Relaxation(_settings(parameters))

    def add_pose(self, id, T):  # noqa: A002
        """Adds a pose. `id`: int, each once; `T`: 4 x 4 (m), the first guess of T_map_id. Throws Error if T is not rigid."""
        self._relaxation.add_pose(int(id), _rigid(T, f"pose {id}"))

    def add_edge(self, a, b, T_a_b, information):
        """Adds a measurement of pose b in the frame of pose a, both added before.

        `T_a_b`: 4 x 4 (m). `information`: 6 x 6, the inverse of the covariance of (translation, m; rotation, rad) in the axes of a;
        zero along directions that are not measured. Throws Error if it is not symmetric and positive semidefinite.
        """
        where = f"edge {a} to {b}"
        given = np.array(information, dtype=float)
        if given.shape != (6, 6) or not np.isfinite(given).all():
            raise Error(f"{where}: information: expected 6 x 6 finite numbers")
        largest = np.abs(given).max()
        if not np.allclose(given, given.T, rtol=0, atol=1e-9 * largest) or np.linalg.eigvalsh((given + given.T) / 2)[0] < -1e-9 * largest:
            raise Error(f"{where}: information is not symmetric and positive semidefinite: expected the inverse of a covariance")
        self._relaxation.add_edge(int(a), int(b), _rigid(T_a_b, where), (given + given.T) / 2)

    def optimise(self):
        """Relaxes the graph. Returns a dict: `cost_before`, `cost_after` (sums of squares, in standard deviations), `iterations`,
        `ending` (a text), `edges_rejected`, `weights` (n, one per edge in the order of addition; 0: rejected). Ctrl-C ends it."""
        return self._relaxation.optimise()

    def poses(self):
        """{id: T_map_id}, 4 x 4 (m): as relaxed, or as added before optimise() is called."""
        return self._relaxation.poses()


def _settings(parameters):
    return [f"{name}={_word(value)}" for name, value in parameters.items()]


def _camera(info, where):
    values = {"width": int(info.width), "height": int(info.height), "distortion_model": str(info.distortion_model)}
    for name in "DKRP":
        numbers = getattr(info, name, None)
        if numbers is None:
            numbers = getattr(info, name.lower(), None)
        if numbers is None:
            raise Error(f"{where} has no member {name}: expected a message sensor_msgs/CameraInfo")
        values[name] = [float(x) for x in np.asarray(numbers, dtype=float).ravel()]
    return values


def _grey(image, where):
    if image is None:
        return None
    pixels = np.asarray(image)
    if pixels.ndim != 2 or pixels.dtype != np.uint8:
        raise Error(f"{where}: an array {pixels.shape} of {pixels.dtype}: expected H x W of uint8")
    return np.ascontiguousarray(pixels)


def _rigid(T, where):
    T = np.array(T, dtype=float)
    if T.shape != (4, 4) or not np.isfinite(T).all():
        raise Error(f"{where}: expected 4 x 4 finite numbers")
    R = T[:3, :3]
    if not np.allclose(R @ R.T, np.eye(3), atol=1e-6) or np.linalg.det(R) < 0 or not np.allclose(T[3], (0, 0, 0, 1)):
        raise Error(f"{where}: a matrix that is not a rigid transform: expected a rotation and a translation, last row 0 0 0 1")
    return T
