# SPDX-License-Identifier: BSD-3-Clause
import unittest

import cv2
import numpy as np

from case import FolderCase, Spiral, run, shifted, texture
import ideal
from truth import Truth

G = np.array([0.0, 0.0, 9.81])


class Integration(FolderCase):
    def off(self, duration, step, ride=Spiral()):
        """Of the integrated device from where it truly is, m; its axes from theirs."""
        times = ride.begin + step * np.arange(round(duration / step) + 1)
        forces = np.array([ride.axes(when).T @ (ride.acceleration(when) + G) for when in times])
        rates = np.tile(ride.rate(), (len(times), 1))
        turn, velocity, position = ideal.integrated(ride.pose(times[0]), ride.velocity(times[0]), rates, forces, step)
        return np.linalg.norm(position - ride.position(times[-1])), np.abs(turn - ride.axes(times[-1])).max()

    def test_ten_seconds_end_where_the_ride_ended(self):
        metres, turn = self.off(10.0, 0.01)
        self.assertLess(metres, 1e-6)
        self.assertLess(turn, 1e-8)

    def test_half_the_step_leaves_a_sixteenth_of_the_error(self):
        coarse, fine = self.off(8.0, 0.4), self.off(8.0, 0.2)
        for a, b in zip(coarse, fine):
            self.assertAlmostEqual(np.log2(a / b), 4.0, delta=0.4)

    def test_it_begins_with_the_velocity_of_the_devices_own_place(self):
        ride, place = Spiral(), np.eye(4)
        place[:3, 3], place[:3, :3] = (0.3, -0.2, 0.9), cv2.Rodrigues(np.array([0.1, 0.2, -0.5]))[0]
        truth = Truth(ride.write(self.folder / "trajectory.tum", 1.0))
        pose, speed = ideal.beginning(truth, place, 100.5)
        np.testing.assert_allclose(pose, ride.pose(100.5) @ place, atol=1e-8)
        lever = ride.axes(100.5) @ place[:3, 3]
        np.testing.assert_allclose(speed, ride.velocity(100.5) + np.cross([0.0, 0.0, ride.RATE], lever), atol=1e-6)


class Planes(unittest.TestCase):
    def setUp(self):
        u, v = np.meshgrid(np.arange(60.0), np.arange(40.0))
        self.values = 3 + 0.2 * u - 0.1 * v

    def test_a_plane_has_its_value_between_the_pixels(self):
        u, v = np.array([20.3, 31.5]), np.array([11.8, 20.49])
        found, flat = ideal.planar(self.values, u, v, 3, 1e-9)
        self.assertTrue(flat.all())
        np.testing.assert_allclose(found, 3 + 0.2 * u - 0.1 * v, atol=1e-9)

    def test_a_step_or_nothing_within_the_square_is_no_plane(self):
        self.values[:, 30:] += 0.1
        self.values[10, 10] = np.inf
        u, v = np.array([27.0, 26.0, 7.0, 6.0]), np.array([20.0, 20.0, 10.0, 10.0])
        self.assertEqual(list(ideal.planar(self.values, u, v, 3, 0.01)[1]), [False, True, False, True])


class Disparities(FolderCase):
    def test_matchers_find_the_shift_of_a_texture(self):
        picture = texture(rows=384, columns=512)
        left = shifted(picture, 0.0)
        for by in (6.0, 7.25, 9.5):
            right = shifted(picture, by)
            for match in (ideal.by_corners, ideal.by_correlation):
                pixels, found = match(left, right)
                self.assertGreater(len(found), 100)
                self.assertEqual(len(pixels), len(found))
                self.assertLess(abs(np.median(found - by)), 0.02, f"{match.__name__}, {by} px")
                self.assertLess(np.median(np.abs(found - by)), 0.05, f"{match.__name__}, {by} px")

    def test_a_picture_warped_by_the_truth_has_the_true_disparities(self):
        bf, rows, columns = 40.0, 384, 512
        view = self.folder / "stereo_right_optical_frame"
        view.mkdir()
        depth = np.full((rows, columns), bf / 7.25, np.float32)
        depth[:, columns // 2:] = bf / 5.5
        cv2.imwrite(str(view / "17.pfm"), depth)
        cv2.imwrite(str(view / "17.png"), np.ones_like(depth, np.uint8))
        left = shifted(texture(rows=rows, columns=columns), 0.0)
        pixels, found = ideal.by_corners(left, ideal.warped(17, left, bf, self.folder))
        true = np.where(pixels[:, 0] - found < columns / 2, 7.25, 5.5)
        inside = np.abs(pixels[:, 0] - found - columns / 2) > 20  # of the edge, where both planes are seen
        self.assertLess(np.median(np.abs(found - true)[inside]), 0.05)


class Clocks(unittest.TestCase):
    def found(self, offset, skew, skewed=True):
        chance, begin = np.random.default_rng(5), 1000.0

        def signal(times):
            a = times - begin
            return np.column_stack([np.sin(0.7 * a) + 0.4 * np.sin(2.3 * a + 1), np.cos(1.1 * a) * np.sin(0.05 * a)])
        true_times = begin + 1 + 0.01 * np.arange(11000)
        values = signal(true_times) * [1.02, 0.95] + [0.01, -0.2] + chance.normal(scale=0.02, size=(len(true_times), 2))
        # A stamp t is told of the time t - offset - skew (t - begin).
        stamps = begin + (true_times - begin + offset) / (1 - skew)
        return ideal.clock_of(stamps, values, signal, begin, skewed)

    def test_a_late_and_a_fast_clock_are_found(self):
        for offset, skew in ((-0.3275, 22e-6), (0.4181, -30e-6)):
            found = self.found(offset, skew)
            self.assertAlmostEqual(found[0], offset, delta=0.001)
            self.assertAlmostEqual(found[1], skew, delta=10e-6)

    def test_without_a_skew_none_is_looked_for(self):
        offset, skew = self.found(0.25, 0.0, skewed=False)
        self.assertAlmostEqual(offset, 0.25, delta=0.001)
        self.assertAlmostEqual(skew, 0.0, places=12)


if __name__ == "__main__":
    run("bench_ideal")
