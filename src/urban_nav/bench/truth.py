# SPDX-License-Identifier: BSD-3-Clause
"""The truth of a simulated session, read from its folder with only numpy and OpenCV, with poses as 4x4 matrices."""
import cv2
import numpy as np

import bags


class Truth:
    """Returns base_link in `world` at any time between the poses of trajectory.tum by the cubic through the nearest four."""

    def __init__(self, path):
        rows = np.loadtxt(path)
        self.stamps, self.places, self.quaternions = rows[:, 0], rows[:, 1:4], rows[:, 4:8]
        for i in range(1, len(rows)):  # same rotation, with the sign nearest to its predecessor
            if self.quaternions[i] @ self.quaternions[i - 1] < 0:
                self.quaternions[i] *= -1

    def at(self, when):
        when = np.atleast_1d(when)
        step = (self.stamps[-1] - self.stamps[0]) / (len(self.stamps) - 1)
        at = (when - self.stamps[0]) / step
        first = np.clip(np.floor(at).astype(int) - 1, 0, len(self.stamps) - 4)
        weights = np.ones((4, len(when)))
        for i in range(4):
            for j in range(4):
                if i != j:
                    weights[i] *= (at - first - j) / (i - j)

        def between(values):
            return sum(weights[i][:, None] * values[first + i] for i in range(4))
        quaternion = between(self.quaternions)
        poses = np.tile(np.eye(4), (len(when), 1, 1))
        poses[:, :3, :3] = bags.rotation(quaternion / np.linalg.norm(quaternion, axis=1, keepdims=True))
        poses[:, :3, 3] = between(self.places)
        return poses

    def rates(self, when):
        """Returns the angular velocity in the axes of base_link, rad/s, over 5 ms."""
        before, after = self.at(when - 0.0025), self.at(when + 0.0025)
        return np.array([cv2.Rodrigues(a[:3, :3].T @ b[:3, :3])[0].ravel() for a, b in zip(before, after)]) / 0.005


class Surface:
    """The true surfaces as points of cloud.ply, with a plane through the nearest twelve if they are coplanar. `rough`: share of the extent by which
    they may deviate from it."""

    def __init__(self, path, way, rough=1e-3):
        self.rough = rough
        with open(path, "rb") as file:
            while not (line := file.readline()).startswith(b"end_header"):
                if line.startswith(b"element vertex"):
                    count = int(line.split()[2])
            rows = np.frombuffer(file.read(), np.dtype([("p", "<f4", 3), ("class", "u1")]), count)
        points = rows["p"]
        low, high = way.min(0)[:2] - 16, way.max(0)[:2] + 16
        inside = ((points[:, :2] > low) & (points[:, :2] < high)).all(1)
        self.points = np.ascontiguousarray(points[inside])
        self.index = cv2.flann_Index(self.points, {"algorithm": 4})  # a kd-tree, exact

    def planes(self, queries):
        """Returns centre, normal and whether there is a plane near each point."""
        near, squares = self.index.knnSearch(np.ascontiguousarray(queries, np.float32), 12, params={"checks": -1})
        patch = self.points[near].astype(float)
        centre = patch.mean(1)
        apart = patch - centre[:, None]
        values, vectors = np.linalg.eigh(np.einsum("nki,nkj->nij", apart, apart))
        flat = (values[:, 0] < self.rough ** 2 * values[:, 2]) & (values[:, 1] > 0.02 * values[:, 2])
        return centre, vectors[:, :, 0], flat & (squares[:, 0] < 0.3 ** 2)

    def along(self, origins, points):
        """Returns the distance (m, along the ray from its origin) of each point behind the nearest plane, and which points have one."""
        centre, normal, flat = self.planes(points)
        ray = points - origins
        ray /= np.linalg.norm(ray, axis=1, keepdims=True)
        slope = np.einsum("ni,ni->n", ray, normal)
        flat &= np.abs(slope) > 0.3
        return np.einsum("ni,ni->n", points - centre, normal) / np.where(flat, slope, 1.0), flat


def moved(pose, points):
    return points @ pose[:3, :3].T + pose[:3, 3]


def inverse(pose):
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = pose[:3, :3].T, -pose[:3, :3].T @ pose[:3, 3]
    return result


def angle(turn):
    return np.degrees(np.linalg.norm(cv2.Rodrigues(turn)[0]))
