# SPDX-License-Identifier: BSD-3-Clause
"""Session stores as arrays."""
import os
import tempfile
from typing import NamedTuple

import numpy as np

from ._commands import _run
from ._error import Error
from ._tables import closure_table, read_ply


class Session(NamedTuple):
    """A session of a store: `id` (20 hexadecimal digits), `name`, `robot`, number of its `map` from 0, `start_ns`, whether it is
    `complete`, whether its poses are `relaxed` (otherwise they are those of odometry), number of `poses`."""

    id: str
    name: str
    robot: str
    map: int
    start_ns: int
    complete: bool
    relaxed: bool
    poses: int


class Keyframe:
    """A view that is kept in a store: `session` (id), `camera` (name of its frame), `stamp_ns`, `T_map_base` (4 x 4, m, the pose of
    base_link at the nearest stamp), and `image`, which is decoded when it is asked for."""

    __slots__ = ("session", "camera", "stamp_ns", "T_map_base", "_reader")

    def __init__(self, reader, session, camera, stamp_ns, T_map_base):
        self._reader = reader
        self.session, self.camera, self.stamp_ns, self.T_map_base = session, camera, stamp_ns, T_map_base

    def __repr__(self):
        return f"Keyframe(session={self.session!r}, camera={self.camera!r}, stamp_ns={self.stamp_ns})"

    @property
    def image(self):
        """The image, H x W or H x W x 3 (RGB), uint8; None if the store has none."""
        return self._reader.keyframe_image(self.session, self.camera, self.stamp_ns)


class Store:
    """A store of `map`, session.db, as it is when the object is created. It is only read.

    Sessions follow one another as in the trajectory files of `map`. `session=None` means all sessions of the first map, whose frame
    `map` they share; otherwise the beginning of an id or of a name selects one. Throws Error for what is not a store.
    """

    def __init__(self, path):
        from . import _suite

        self.path = os.fspath(path)
        self._reader = _suite.StoreReader(self.path)
        self._sessions = [Session(*row) for row in self._reader.sessions()]

    def __repr__(self):
        return f"Store({self.path!r})"

    @property
    def sessions(self):
        """A list of Session, map after map."""
        return list(self._sessions)

    def _select(self, session):
        if session is None:
            return [i for i, each in enumerate(self._sessions) if each.map == 0]
        found = [i for i, each in enumerate(self._sessions) if each.id.startswith(session) or each.name.startswith(session)]
        if len(found) != 1:
            known = ", ".join(f"{each.id} ({each.name})" for each in self._sessions) or "none: it is empty"
            what = "has no session" if not found else f"has {len(found)} sessions"
            raise Error(f"{self.path}: {what} {session}: expected {known}")
        return found

    def trajectory(self, session=None):
        """(stamps_ns, T_map_base): int64 n, and n x 4 x 4 (m), base_link in `map`, as in trajectory.tum."""
        parts = [self._reader.trajectory(i) for i in self._select(session)]
        if not parts:
            return np.zeros(0, np.int64), np.zeros((0, 4, 4))
        return np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])

    def _matrices(self, session, read):
        parts = [read(i) for i in self._select(session)]
        return np.concatenate(parts) if parts else np.zeros((0, 6, 6))

    def covariances(self, session=None):
        """n x 6 x 6: covariance of each pose relative to the first pose of its map, tangent (translation, m; rotation, rad) in the axes
        of that pose, as in covariance.csv. Throws Error if the store was written live, or by an earlier version: it holds none."""
        return self._matrices(session, self._reader.covariances)

    def relative_covariances(self, session=None):
        """(n - 1) x 6 x 6 (of several sessions: n - 1 of each): covariance of T_from_to from pose to pose, tangent (translation, m;
        rotation, rad) in the axes of `from`, as in relative_covariance.csv."""
        return self._matrices(session, self._reader.relative_covariances)

    def closures(self):
        """A structured array with the columns of closures.csv: T_a_b as x, y, z (m), qx, qy, qz, qw; stamps in ns."""
        return closure_table(self._reader.closures())

    def keyframes(self, session=None):
        """A list of Keyframe, session by session, camera by camera, in order of time."""
        all_of = []
        for i in self._select(session):
            stamps, poses = self._reader.trajectory(i)
            for camera, times in self._reader.keyframes(i):
                for stamp in times:
                    pose = poses[_nearest(stamps, stamp)] if len(stamps) else None
                    all_of.append(Keyframe(self._reader, self._sessions[i].id, camera, stamp, pose))
        return all_of

    def cloud(self, session=None):
        """The map of points as a structured array with the properties of map.ply: x, y, z, nx, ny, nz, sigma (m, in `map`), red,
        green, blue, intensity, laser, coloured, pass, stamp (s), and those of labels. Throws Error if the store has no map."""
        ids = [self._sessions[i].id for i in self._select(session)]
        with tempfile.TemporaryDirectory(prefix="urban_nav-") as folder:
            path = os.path.join(folder, "map.ply")
            _run("export", {"STORE": [self.path], "ply": [path], "session": ids}, {})
            return read_ply(path)

    def labels(self, session=None):
        """The labels of the points of cloud(), in the same order: label (class 0...8, 255 none), label_probability, unsure (0 or 1).
        Throws Error if the map is not labelled."""
        cloud = self.cloud(session)
        names = [name for name in ("label", "label_probability", "unsure") if name in cloud.dtype.names]
        if not names:
            raise Error(f"{self.path}: the map is not labelled: expected a map with the stage labels", 1)
        labels = np.empty(len(cloud), dtype=[(name, cloud.dtype[name]) for name in names])
        for name in names:
            labels[name] = cloud[name]
        return labels


def _nearest(stamps, stamp):
    after = int(np.searchsorted(stamps, stamp))
    if after == 0 or after == len(stamps):
        return min(after, len(stamps) - 1)
    return after if stamps[after] - stamp < stamp - stamps[after - 1] else after - 1
