# SPDX-License-Identifier: BSD-3-Clause
import types
import unittest

import numpy as np

from case import FolderCase, Spiral, run, shifted, texture
import exactness
from truth import Truth, inverse


def kitti(poses):
    return "\n".join(" ".join(f"{x:.9f}" for x in (inverse(poses[0]) @ pose)[:3].ravel()) for pose in poses) + "\n"


class PosesBesideTheTruth(FolderCase):
    def measured(self, poses):
        (self.folder / "poses.txt").write_text(kitti(poses))
        eyes = np.array([Spiral().pose(100 + 0.5 * i) for i in range(8)])
        return exactness.poses(types.SimpleNamespace(folder=self.folder, eyes=eyes))[0]

    def test_equal_ones_are_not_apart_and_one_that_is_counts(self):
        poses = [Spiral().pose(100 + 0.5 * i) for i in range(8)]
        self.assertEqual(self.measured(poses)[1::2], ["0.00 mm, 0.0000 deg", 8])
        poses[5][:3, 3] += (0.0, 0.003, 0.004)
        self.assertEqual(self.measured(poses)[1], "5.00 mm, 0.0000 deg")

    def test_a_pose_too_few_is_said(self):
        with self.assertRaisesRegex(ValueError, "7 poses in poses.txt, 8 left images"):
            self.measured([Spiral().pose(100 + 0.5 * i) for i in range(7)])


class Gyroscope(FolderCase):
    def test_what_it_says_too_much_is_left(self):
        ride, place = Spiral(), np.eye(4)
        place[:3, :3] = ride.axes(101.7)
        times = np.arange(100.1, 102.9, 0.01)
        says = place[:3, :3].T @ ride.rate()
        truth = Truth(ride.write(self.folder / "trajectory.tum", 3.0))
        for error in (0.0, 0.05):
            rates = [(when, "imu_link", says + (-1) ** i * error) for i, when in enumerate(times)]
            (_, found, _, count), = exactness.gyroscope(types.SimpleNamespace(truth=truth, rates=rates, places={"imu_link": place}))
            self.assertEqual((found, count), (f"{error:.4f} rad/s", len(times)))


class Corners(unittest.TestCase):
    def test_every_square_has_its_own_however_faint(self):
        picture = texture(rows=192, columns=256)
        picture[:, :128] = 128 + 0.2 * (picture[:, :128] - 128)
        corners = exactness.corners_all_over(np.rint(picture).astype(np.uint8)).reshape(-1, 2)
        squares = {tuple(corner // 64) for corner in corners.astype(int)}
        self.assertEqual(len(squares), 12)
        self.assertIsNone(exactness.corners_all_over(np.full((64, 64), 99, np.uint8)))

    def test_followed_where_they_went_and_refused_where_they_are_gone(self):
        picture = texture()
        left, right = shifted(picture, 0.0), shifted(picture, 4.5)
        right[:, :120] = 77
        corners = exactness.corners_all_over(left)
        there, good = exactness.followed(left, right, corners)
        off = (corners.reshape(-1, 2) - there)[good]
        np.testing.assert_allclose(np.median(off, 0), [4.5, 0.0], atol=0.02)
        gone = (corners.reshape(-1, 2)[:, 0] < 100) & (corners.reshape(-1, 2)[:, 0] > 20)
        self.assertGreater(gone.sum(), 10)
        self.assertEqual(good[gone].sum(), 0)


if __name__ == "__main__":
    run("bench_exactness")
