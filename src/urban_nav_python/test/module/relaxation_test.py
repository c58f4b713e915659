# SPDX-License-Identifier: BSD-3-Clause
"""Relaxation: a graph of one's own."""
import sys
import unittest
from pathlib import Path

import numpy as np

import urban_nav

sys.path.insert(0, str(Path(__file__).resolve().parent))
from case import FolderCase, rigid  # noqa: E402

SIDE = 10  # steps of 1 m along each side of a square


def square():
    """The true poses of two rounds of a square."""
    poses = [np.eye(4)]
    for i in range(8 * SIDE):
        poses.append(poses[-1] @ rigid(1.0, 0.0, np.pi / 2 if i % SIDE == SIDE - 1 else 0.0))
    return poses


class Graph(FolderCase):
    INFORMATION = np.diag([1e4, 1e4, 1e4, 1e5, 1e5, 1e5])

    def drifting(self, information=INFORMATION, **parameters):
        """A chain whose heading drifts, with closures between its two rounds."""
        truth = square()
        relaxation = urban_nav.Relaxation(**parameters)
        guess = np.eye(4)
        for i, pose in enumerate(truth):
            if i > 0:
                step = np.linalg.inv(truth[i - 1]) @ pose @ rigid(yaw=0.002)
                guess = guess @ step
            relaxation.add_pose(i, guess)
            if i > 0:
                relaxation.add_edge(i - 1, i, step, information)
        for i in range(0, 4 * SIDE, 4):
            relaxation.add_edge(i, i + 4 * SIDE, np.linalg.inv(truth[i]) @ truth[i + 4 * SIDE], information)
        return truth, relaxation, guess

    def test_closures_take_the_drift_away(self):
        truth, relaxation, guess = self.drifting()
        before = np.linalg.norm(guess[:3, 3] - truth[-1][:3, 3])
        result = relaxation.optimise()
        poses = relaxation.poses()
        self.assertEqual(sorted(poses), list(range(len(truth))))
        np.testing.assert_allclose(poses[0], np.eye(4), atol=1e-12)
        self.assertLess(np.linalg.norm(poses[len(truth) - 1][:3, 3] - truth[-1][:3, 3]), 0.1 * before)
        self.assertLess(result["cost_after"], result["cost_before"])
        self.assertEqual((result["edges_rejected"], len(result["weights"])), (0, len(truth) - 1 + SIDE))

    def test_a_false_edge_is_rejected_unless_robust_is_off(self):
        for robust, rejected in ((True, 1), (False, 0)):
            information = np.diag([1e4, 1e4, 1e4, 2.5e3, 2.5e3, 2.5e3])
            _, relaxation, _ = self.drifting(information, robust=robust)
            relaxation.add_edge(5, 25, np.eye(4), information)
            result = relaxation.optimise()
            self.assertEqual(result["edges_rejected"], rejected)
            self.assertEqual(result["weights"][-1] == 0.0, robust)

    def test_information_is_in_the_axes_of_a(self):
        """A pose turned by 90 deg, known along x of a by one edge and along y of a by the other."""
        relaxation = urban_nav.Relaxation(robust=False)
        relaxation.add_pose(0, np.eye(4))
        relaxation.add_pose(1, rigid(1.0, 1.0, np.pi / 2))
        turned = np.diag([0.0, 0.0, 1.0, 1.0, 1.0, 1.0])
        relaxation.add_edge(0, 1, rigid(2.0, 7.0, np.pi / 2), turned + np.diag([1.0, 0, 0, 0, 0, 0]))
        relaxation.add_edge(0, 1, rigid(9.0, 3.0, np.pi / 2), turned + np.diag([0, 1.0, 0, 0, 0, 0]))
        relaxation.optimise()
        np.testing.assert_allclose(relaxation.poses()[1][:2, 3], [2.0, 3.0], atol=1e-6)

    def test_what_is_no_graph_is_refused(self):
        relaxation = urban_nav.Relaxation()
        self.fails(2, "no edge", relaxation.optimise)
        relaxation.add_pose(3, np.eye(4))
        self.fails(2, "pose 3 was added before", relaxation.add_pose, 3, np.eye(4))
        self.fails(2, "not a rigid transform", relaxation.add_pose, 4, 2 * np.eye(4))
        self.fails(2, "4 x 4", relaxation.add_pose, 4, np.eye(3))
        self.fails(2, "pose 4 does not exist", relaxation.add_edge, 3, 4, np.eye(4), np.eye(6))
        relaxation.add_pose(4, np.eye(4))
        self.fails(2, "positive semidefinite", relaxation.add_edge, 3, 4, np.eye(4), -np.eye(6))
        self.fails(2, "6 x 6", relaxation.add_edge, 3, 4, np.eye(4), np.full((6, 6), np.nan))
        self.fails(2, "pose_graph", urban_nav.Relaxation, robus=True)
        self.fails(2, "gauss_newton", urban_nav.Relaxation, solver="ceres")


if __name__ == "__main__":
    import rosunit
    rosunit.unitrun("urban_nav_python", "relaxation", "__main__")
