# SPDX-License-Identifier: BSD-3-Clause
import random
import unittest

import cv2
import numpy as np

from case import FolderCase, Spiral, run
import soak
from truth import Truth


class Faults(unittest.TestCase):
    def test_are_over_before_the_next_and_before_peace_is_measured(self):
        chance = random.Random(3)
        for start in range(20, 20000, soak.EVERY):
            begin, end = soak.span_of(soak.some_fault(chance, start))
            self.assertGreaterEqual(begin, start + 2)
            self.assertLess(end + soak.AFTER, start + soak.PEACE)
        longest = 3.0
        self.assertLess(soak.PEACE + longest + soak.AFTER, soak.EVERY + 2)

    def test_are_the_same_for_the_same_seed(self):
        for seed in (1, 2):
            self.assertEqual(soak.some_fault(random.Random(seed), 40), soak.some_fault(random.Random(seed), 40))
        self.assertNotEqual(soak.some_fault(random.Random(1), 40), soak.some_fault(random.Random(2), 40))


class WhatTheyLeaveBehind(FolderCase):
    """An odometry of 20 Hz that is right but for a step of 0.3 m and 25 deg, in its own frame, somewhere else."""

    def setUp(self):
        super().setUp()
        self.ride = Spiral()
        truth = self.ride.write(self.folder / "truth.tum", 70.0, step=0.025)
        self.truth = Truth(truth)
        self.stamps, self.exact = soak.poses_of(truth)
        self.stamps, self.exact = self.stamps[::2], self.exact[::2]
        self.elsewhere = Spiral(begin=90.0).pose(97.0)

    def ridden(self, slip_at, metres=0.3, degrees=25.0):
        slip = np.eye(4)
        slip[:3, :3] = cv2.Rodrigues(np.radians([0.0, 0.0, degrees]))[0]
        slip[:3, 3] = metres * np.array([0.6, 0.0, 0.8])
        at = np.searchsorted(self.stamps, self.ride.begin + slip_at)
        poses = self.elsewhere @ self.exact
        poses[at:] = poses[at] @ slip @ np.linalg.inv(self.exact[at]) @ self.exact[at:]
        return poses

    def test_a_pose_is_read_as_it_was_written(self):
        for i in (0, 7, 900):
            np.testing.assert_allclose(self.exact[i], self.ride.pose(self.stamps[i]), atol=1e-9)

    def test_a_slip_counts_for_the_fault_within_whose_span_it_is(self):
        spans = [(10.0, 12.0), (30.01, 31.5), (50.0, 51.0)]
        for slip_at in (30.02, 32.0):
            off = soak.left_behind(spans, self.stamps, self.ridden(slip_at), self.truth)
            np.testing.assert_allclose(off[[0, 2]], 0.0, atol=1e-5)
            self.assertAlmostEqual(off[1, 1], 25.0, places=4)
        for slip_at in (29.5, 33.0):
            np.testing.assert_allclose(soak.left_behind(spans, self.stamps, self.ridden(slip_at), self.truth), 0.0, atol=1e-5)

    def test_just_after_the_slip_its_size_is_what_is_left(self):
        off = soak.left_behind([(30.0, 31.0 - soak.AFTER)], self.stamps, self.ridden(30.9, degrees=0.0), self.truth)
        self.assertAlmostEqual(off[0, 0], 0.3, places=6)

    def test_frames_that_are_missing_are_bridged(self):
        there = (self.stamps < self.ride.begin + 30.0) | (self.stamps > self.ride.begin + 33.0)
        off = soak.left_behind([(30.1, 31.0)], self.stamps[there], self.ridden(30.5)[there], self.truth)
        self.assertAlmostEqual(off[0, 1], 25.0, places=4)

    def test_the_words_count_them(self):
        faults = ["freeze:stereo:24.00:1.00", "drop:stereo:45.00:1.00:0.3"]
        each, all_ = soak.costs(faults, self.stamps, self.ridden(45.5), self.truth)
        self.assertIn("freeze:stereo:24.00:1.00 0.000 m 0.00 deg, drop:stereo:45.00:1.00:0.3 ", each)
        self.assertIn("1 of the 2 leave at most 4 cm and 0.3 deg behind", all_)
        self.assertIn("25.00 deg; spans as long without a fault 0.0 cm and 0.00 deg (median), at most 0.0 cm and 0.00 deg.", all_)


if __name__ == "__main__":
    run("bench_soak")
