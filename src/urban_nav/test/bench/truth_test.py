# SPDX-License-Identifier: BSD-3-Clause
import unittest

import cv2
import numpy as np

from case import FolderCase, Spiral, run
from truth import Surface, Truth, angle, inverse, moved


class TruthOfASession(FolderCase):
    def setUp(self):
        super().setUp()
        self.ride = Spiral()
        self.path = self.ride.write(self.folder / "trajectory.tum", 4.0)

    def test_between_its_poses_it_is_where_the_ride_was(self):
        truth = Truth(self.path)
        for when in (100.0, 100.0012, 101.2345, 103.9991, 104.0):
            np.testing.assert_allclose(truth.at(when)[0], self.ride.pose(when), atol=1e-8)

    def test_the_two_poses_on_each_side_decide_and_no_others(self):
        lines = self.path.read_text().splitlines()
        lines[1 + 400] = " ".join([*lines[1 + 400].split()[:3], "5.0", *lines[1 + 400].split()[4:]])  # that of 102 s
        self.path.write_text("\n".join(lines) + "\n")
        truth = Truth(self.path)
        off = [np.abs(truth.at(102 + 0.005 * step)[0] - self.ride.pose(102 + 0.005 * step)).max() > 1e-6 for step in (-2.5, -1.5, -0.5, 0.5, 1.5, 2.5)]
        self.assertEqual(off, [False, True, True, True, True, False])

    def test_the_sign_of_a_quaternion_means_nothing(self):
        lines = self.path.read_text().splitlines()
        for i in range(5, len(lines), 3):
            words = lines[i].split()
            lines[i] = " ".join(words[:4] + [str(-float(word)) for word in words[4:]])
        self.path.write_text("\n".join(lines) + "\n")
        truth = Truth(self.path)
        for when in (100.017, 100.0312, 102.503):
            np.testing.assert_allclose(truth.at(when)[0], self.ride.pose(when), atol=1e-8)

    def test_rates_are_those_of_the_robots_own_axes(self):
        rates = Truth(self.path).rates(np.array([100.5, 101.0037, 103.2]))
        np.testing.assert_allclose(rates, np.tile(self.ride.rate(), (3, 1)), atol=1e-6)


class TrueSurfaces(FolderCase):
    """A floor z = 0.1 x and a wall y = 2 that stands on it, in points 5 cm apart."""

    def setUp(self):
        super().setUp()
        along, across = (grid.ravel() for grid in np.meshgrid(np.arange(-3, 3, 0.05), np.arange(-3, 2.01, 0.05)))
        floor = np.column_stack([along, across, 0.1 * along])
        along, up = (grid.ravel() for grid in np.meshgrid(np.arange(-3, 3, 0.05), np.arange(0.05, 3, 0.05)))
        points = np.vstack([floor, np.column_stack([along, np.full(along.size, 2.0), 0.1 * along + up])])
        rows = np.zeros(len(points), np.dtype([("p", "<f4", 3), ("class", "u1")]))
        rows["p"] = points
        header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(rows)}\nend_header\n"
        path = self.folder / "cloud.ply"
        path.write_bytes(header.encode() + rows.tobytes())
        self.surface = Surface(path, np.zeros((1, 3)))

    def test_it_says_how_far_behind_the_plane_a_ray_ended(self):
        origin, onto = np.array([[0.0, 0.0, 1.2], [0.1, -0.3, 1.2]]), np.array([[1.0, 0.5, 0.1], [0.4, 2.0, 1.5]])
        way = (onto - origin) / np.linalg.norm(onto - origin, axis=1, keepdims=True)
        behind, flat = self.surface.along(origin, onto + np.array([[0.03], [-0.02]]) * way)
        self.assertTrue(flat.all())
        np.testing.assert_allclose(behind, [0.03, -0.02], atol=1e-6)

    def test_there_is_no_plane_in_an_edge_nor_far_from_everything_nor_along_it(self):
        onto = np.array([[0.5, 2.0, 0.6], [0.5, 2.0, 0.05], [0.0, 0.0, 0.5], [-1.0, 0.0, -0.1]])
        origin = np.array([[0.0, 0.0, 1.2], [0.0, 0.0, 1.2], [0.0, 0.0, 1.2], [-2.9, 0.0, -0.28]])
        self.assertEqual(list(self.surface.along(origin, onto)[1]), [True, False, False, False])


class Poses(unittest.TestCase):
    def test_there_and_back(self):
        pose = Spiral().pose(103.0)
        np.testing.assert_allclose(inverse(pose) @ pose, np.eye(4), atol=1e-12)
        points = np.array([[1.0, 2.0, 3.0], [-4.0, 0.5, 0.0]])
        np.testing.assert_allclose(moved(inverse(pose), moved(pose, points)), points, atol=1e-12)

    def test_an_angle_is_in_degrees_about_any_axis(self):
        axis = np.array([2.0, -1.0, 2.0]) / 3
        self.assertAlmostEqual(angle(cv2.Rodrigues(np.radians(37.0) * axis)[0]), 37.0, places=9)


if __name__ == "__main__":
    run("bench_truth")
