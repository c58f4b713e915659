# SPDX-License-Identifier: BSD-3-Clause
"""What places.py, places_reliability.py and strangers.py make of matches and claims that are known."""
import numpy as np

from case import FolderCase, run
import places
import places_reliability
import strangers
from places import Claim, Match

SECOND = 10**9


def pose_line(stamp, x, yaw):
    return f"{stamp // SECOND}.{stamp % SECOND:09d} {x} 0 0 0 0 {np.sin(yaw / 2)} {np.cos(yaw / 2)}\n"


class Judged(FolderCase):
    """Along a line at 1 m/s, out for 60 s; on the second day from 30 m back to the start."""

    def setUp(self):
        super().setUp()
        out = [pose_line(i * SECOND, i, 0.0) for i in range(61)]
        back = [pose_line((1000 + i) * SECOND, 30 - i, np.pi) for i in range(31)]
        self.bags = [self.folder / "day1.bag", self.folder / "day2.bag"]
        for bag, lines in zip(self.bags, (out, back)):
            bag.with_suffix(".truth").mkdir()
            (bag.with_suffix(".truth") / "trajectory.tum").write_text("# t x y z qx qy qz qw\n" + "".join(lines))

    def test_matches_are_right_near_and_wrong_far_from_the_place(self):
        found = [Match(0, k * SECOND, 1, 1010 * SECOND, 0.5) for k in (20, 27, 28, 30, 31)]  # of a query at 20 m
        self.assertEqual([claim.right for claim in places.judged(found, self.bags, True)], [True, True, None, None, False])
        self.assertEqual({claim.right for claim in places.judged(found, self.bags, False)}, {False})

    def test_revisits_and_stretches_are_those_of_the_query(self):
        claims = places.judged([Match(0, 0, 1, (1000 + k) * SECOND, 0.5) for k in (0, 9, 10, 29)], self.bags, True)
        self.assertEqual([claim.stretch for claim in claims], ["1:0", "1:0", "1:1", "1:2"])
        self.assertTrue(all(claim.revisit for claim in claims))

    def test_a_query_revisits_the_first_day_whichever_day_it_matches(self):
        claims = places.judged([Match(1, 1000 * SECOND, 1, 1025 * SECOND, 0.5)], self.bags, True)
        self.assertEqual((claims[0].right, claims[0].revisit), (False, True))

    def test_opposite_directions_are_told_by_the_headings(self):
        there_and_back = [self.bags[0], self.bags[0]]
        found = [Match(0, 20 * SECOND, 1, 20 * SECOND, 0.5)]
        self.assertEqual(places.judged(found, there_and_back, True, only_opposite=True), [])
        self.assertEqual(len(places.judged([Match(0, 20 * SECOND, 1, 1010 * SECOND, 0.5)], self.bags, True, only_opposite=True)), 1)

    def test_within_a_drive_only_what_is_older_than_the_mask_is_a_revisit(self):
        claims = places.judged([Match(0, 30 * SECOND, 0, 40 * SECOND, 0.5)], self.bags, True)
        self.assertFalse(claims[0].revisit)


class Summary(FolderCase):
    def test_recall_ends_at_the_first_wrong_match(self):
        claims = [Claim(0.999, True, True, "0:0"), Claim(0.95, True, True, "0:1"), Claim(0.93, False, False, "0:2"), Claim(0.4, True, True, "0:3"), Claim(0.3, None, True, "0:4")]
        self.assertEqual(places.summary(("w", "d", "e"), claims), ["w", "d", "e", "5", "4", "3", "50%", "1", "1", "2", "1", "1", "1"])


class Reliability(FolderCase):
    def test_intervals_are_those_of_the_literature(self):
        # Newcombe (1998), table I: 81 of 263, and 0 of 20.
        for (right, number), expected in (((81, 263), (0.2553, 0.3662)), ((0, 20), (0.0, 0.1611))):
            for found, wanted in zip(places_reliability.wilson(right, number), expected):
                self.assertAlmostEqual(found, wanted, delta=6e-5)

    def test_the_fewest_right_are_those_of_the_binomial_distribution(self):
        chance = np.random.default_rng(1).binomial(50, 0.95, size=200000)
        least = places_reliability.fewest(50, 0.95)
        self.assertLessEqual(np.mean(chance < least), 0.0105)
        self.assertGreater(np.mean(chance < least + 1), 0.0095)
        self.assertEqual(places_reliability.fewest(30, 1.0), 30)

    def test_a_stretch_counts_once_in_each_range(self):
        path = self.folder / "claims.csv"
        path.write_text("world,drives,probability,verdict,stretch\nquad,two days,0.95,right,1:0\nquad,two days,0.96,wrong,1:0\nquad,two days,0.6,right,1:0\n"
                        "quad,two days,0.97,wrong,1:1\nstreet,two days,0.92,right,1:0\nquad,two days,0.95,neither,1:7\n")
        bins = places_reliability.binned(places_reliability.read_claims(path))
        self.assertEqual([(each.low, each.claims, each.right, each.stretches, each.stretches_right) for each in bins], [(0.5, 1, 1, 1, 1), (0.9, 4, 2, 3, 2)])
        self.assertAlmostEqual(bins[1].stated, (0.95 + 0.97 + 0.92) / 3)
        self.assertAlmostEqual(places_reliability.calibration_error(bins), (0.4 + 2.84 - 2) / 4)


class Strangers(FolderCase):
    def test_only_closures_between_sites_count(self):
        path = self.folder / "closures.csv"
        path.write_text("session_a,stamp_a_ns,session_b,stamp_b_ns,verdict\na,1,a,2,accepted\na,1,b,2,rejected\nb,1,a,2,accepted\n")
        self.assertEqual(strangers.between_sites(path), ["rejected", "accepted"])


if __name__ == "__main__":
    run("bench_places")
