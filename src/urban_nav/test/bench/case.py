# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of bench/ share: the way to its programs, a folder that goes away, and a ride that is known in closed form."""
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import cv2
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))


class FolderCase(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)


class Spiral:
    """base_link on a circle that climbs, leaning sideways: position, velocity, acceleration, axes and turn rate at any time."""

    RADIUS, CLIMB, RATE = 3.0, 0.1, 0.4  # m, m/s, rad/s
    LEAN = np.array([0.25, 0.1, 0.0])    # rotation vector, of the robot against the way

    def __init__(self, begin=100.0):
        self.begin = begin
        self.lean = cv2.Rodrigues(self.LEAN)[0]

    def turn(self, when):
        return self.RATE * (when - self.begin)

    def position(self, when):
        a = self.turn(when)
        return np.array([self.RADIUS * np.sin(a), -self.RADIUS * np.cos(a), self.CLIMB * (when - self.begin)])

    def velocity(self, when):
        a, speed = self.turn(when), self.RADIUS * self.RATE
        return np.array([speed * np.cos(a), speed * np.sin(a), self.CLIMB])

    def acceleration(self, when):
        a, force = self.turn(when), self.RADIUS * self.RATE ** 2
        return np.array([-force * np.sin(a), force * np.cos(a), 0.0])

    def axes(self, when):
        return cv2.Rodrigues(np.array([0.0, 0.0, self.turn(when)]))[0] @ self.lean

    def pose(self, when):
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = self.axes(when), self.position(when)
        return matrix

    def rate(self):
        """In the robot's own axes, rad/s."""
        return self.lean.T @ [0.0, 0.0, self.RATE]

    def quaternion(self, when):
        """x, y, z, w of the turn, then the lean."""
        half, size = self.turn(when) / 2, np.linalg.norm(self.LEAN)
        z, w = np.sin(half), np.cos(half)
        (bx, by, bz), bw = self.LEAN / size * np.sin(size / 2), np.cos(size / 2)
        return np.array([w * bx - z * by, w * by + z * bx, w * bz + z * bw, w * bw - z * bz])

    def write(self, path, duration, step=0.005):
        """As the simulator writes trajectory.tum."""
        times = self.begin + step * np.arange(round(duration / step) + 1)
        lines = (" ".join(f"{x:.12f}" for x in (when, *self.position(when), *self.quaternion(when))) for when in times)
        path.write_text("# stamp x y z qx qy qz qw\n" + "\n".join(lines) + "\n")
        return path


def texture(seed=1, rows=200, columns=320):
    """Grey blobs some pixels wide, as float, so that shifts by parts of a pixel are true."""
    noise = np.random.default_rng(seed).normal(size=(rows, columns))
    smooth = cv2.GaussianBlur(noise, (0, 0), 2.0)
    return 128 + 40 * smooth / smooth.std()


def shifted(picture, by):
    """The picture moved to the left by so many pixels, as 8 bit: what a right camera sees of a plane."""
    rows, columns = picture.shape
    u, v = np.meshgrid(np.arange(columns, dtype=np.float32), np.arange(rows, dtype=np.float32))
    return np.clip(np.rint(cv2.remap(picture, u + np.float32(by), v, cv2.INTER_LANCZOS4)), 0, 255).astype(np.uint8)


def run(name):
    """As rostest runs a test; the results go where --gtest_output says."""
    import rosunit
    rosunit.unitrun("urban_nav", name, "__main__")
