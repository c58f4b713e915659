# SPDX-License-Identifier: BSD-3-Clause
"""What places_end_to_end.py makes of closures that are known."""
from case import FolderCase, run
import closures
import places_end_to_end as bench

SECOND = 10**9
HEADER = "session_a,stamp_a_ns,session_b,stamp_b_ns,verdict,x,y,z\n"


class TwoDays(FolderCase):
    """40 m along a line at 1 m/s, on two days; the second a metre beside the first."""

    def setUp(self):
        super().setUp()
        for day, (start, aside) in enumerate(((0, 0.0), (1000, 1.0)), 1):
            folder = self.folder / f"day{day}.truth"
            folder.mkdir()
            (folder / "trajectory.tum").write_text("".join(f"{start + 0.5 * i} {0.5 * i} {aside} 0 0 0 0 1\n" for i in range(83)))
            (folder / "closures_true.csv").write_text("session_a,stamp_a_ns,session_b,stamp_b_ns,probability\n")
        self.drives = [bench.Drive(self.folder / f"day{day}.bag") for day in (1, 2)]
        self.true = closures.true_pairs(self.drives)

    def found(self, *rows):
        """Of the first day's second a and the second day's second b: verdict and what was measured along the line."""
        path = self.folder / "closures.csv"
        path.write_text(HEADER + "".join(f"day1,{a * SECOND},day2,{(1000 + b) * SECOND},{verdict},{x},1,0\n" for a, b, verdict, x in rows))
        return bench.candidates(path, self.drives)

    def test_false_are_other_places_and_wrong_transforms_that_were_accepted(self):
        found = self.found((5, 5, "accepted", 0), (5, 6, "accepted", 0), (5, 30, "accepted", 25), (5, 31, "rejected", 0))
        self.assertEqual([each.right for each in found], [True, True, False, False])
        self.assertEqual([each.is_false for each in found], [False, True, True, False])
        self.assertAlmostEqual(found[1].error, 1.0)

    def test_a_stretch_is_connected_by_an_accepted_closure_that_is_right(self):
        found = self.found((5, 5, "accepted", 0), (15, 15, "rejected", 0), (25, 26, "accepted", 5), (2, 35, "rejected", 0))
        rows = {row[1]: row[4:] for row in bench.stretch_rows(self.true, found, self.drives)}
        self.assertEqual(rows, {0: (1, 0, 1, 0), 1: (1, 0, 0, 0), 2: (1, 0, 0, 1), 3: (0, 1, 0, 0), 4: (0, 0, 0, 0)})

    def test_poses_near_a_closure_are_those_within_two_metres_of_its_later_end(self):
        near, poses = bench.near_closures(self.true, self.found((10, 10, "accepted", 0), (30, 30, "rejected", 0)), self.drives)
        self.assertEqual((near, poses), (9, 82))

    def test_without_closures_none_is_near(self):
        self.assertEqual(bench.near_closures(self.true, [], self.drives)[0], 0)


class Cases(FolderCase):
    def test_days_without_seconds_are_left_out(self):
        self.assertEqual(bench.day_names("begbroke:73::300"), "day 2, 300 s")
        self.assertEqual(bench.day_names("quad:71:120:60/return"), "day 1, 120 s + day 2, 60 s return")


if __name__ == "__main__":
    run("bench_places_end_to_end")
