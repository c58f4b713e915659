# SPDX-License-Identifier: BSD-3-Clause
import numpy as np

from case import FolderCase, Spiral, run
import end_to_end


class EndToEnd(FolderCase):
    def test_the_level_is_that_of_the_first_pose_alone(self):
        ride = Spiral()
        truth = self.folder / "day1.truth"
        truth.mkdir()
        ride.write(truth / "trajectory.tum", 2.0)
        bag, estimate = self.folder / "day1.bag", self.folder / "estimate.tum"
        np.testing.assert_allclose(end_to_end.up_of_first_pose(truth / "trajectory.tum"), ride.axes(ride.begin).T @ [0.0, 0.0, 1.0], atol=1e-9)
        turned = Spiral(ride.begin - 3.0)  # the same lean on another heading
        turned.write(estimate, 2.0)
        self.assertLess(end_to_end.level_off_deg(bag, estimate), 1e-5)
        estimate.write_text("# stamp x y z qx qy qz qw\n0 0 0 0 0 0 0 1\n0.1 5 5 5 0.6 0 0 0.8\n")
        lean = np.degrees(np.arccos(ride.axes(ride.begin)[2, 2]))
        self.assertAlmostEqual(end_to_end.level_off_deg(bag, estimate), lean, places=6)

    def test_frames_weigh_the_mean_square(self):
        self.assertAlmostEqual(end_to_end.root_mean_square([1.0, 7.0], [1, 1]), 5.0)
        self.assertAlmostEqual(end_to_end.root_mean_square([1.0, 7.0], [2, 1]), 17.0 ** 0.5)


if __name__ == "__main__":
    run("bench_end_to_end")
