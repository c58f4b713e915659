# SPDX-License-Identifier: BSD-3-Clause
"""What the tables say of runs that are known: bars.py, tracks.py, worlds.py, support.py."""
import contextlib
import csv
import io
import json
import unittest
from unittest import mock

import cv2
import numpy as np

from case import FolderCase, run
import bars
import support
import tracks
import worlds


def write_poses(path, places, turns=None):
    with open(path, "w") as file:
        for i, place in enumerate(places):
            matrix = np.column_stack([cv2.Rodrigues(np.array([0.0, turns[i] if turns is not None else 0.0, 0.0]))[0], place])
            file.write(" ".join(f"{x:.9g}" for x in matrix.ravel()) + "\n")


class Band(unittest.TestCase):
    def test_is_that_of_the_tables_of_chi_square(self):
        # 0.5 % and 99.5 % of chi-square (Abramowitz and Stegun, table 26.8), with 12, 30 and 60 degrees of freedom.
        for runs, low, high in ((2, 3.074 / 2, 28.300 / 2), (5, 13.787 / 5, 53.672 / 5), (10, 35.534 / 10, 91.952 / 10)):
            found = bars.band(runs)
            self.assertAlmostEqual(found[0], low, delta=0.03)
            self.assertAlmostEqual(found[1], high, delta=0.03)

    def test_holds_99_of_100_means(self):
        means = np.random.default_rng(1).chisquare(6, size=(40000, 4)).mean(1)
        low, high = bars.band(4)
        self.assertAlmostEqual(np.mean(means < low), 0.005, delta=0.0015)
        self.assertAlmostEqual(np.mean(means > high), 0.005, delta=0.0015)


class Ways(FolderCase):
    def test_are_counted_from_the_first_place_as_the_crow_flies(self):
        path = self.folder / "poses.txt"
        write_poses(path, [(1, 2, 3), (1, 2, 4), (4, 2, 7), (1, 2, 3)], [0.0, 0.5, 1.0, 3.0])
        np.testing.assert_allclose(bars.way_of(path), [0, 1, 5, 0], atol=1e-9)


class FirstFrames(FolderCase):
    def whole(self, count):
        folder = self.folder / "whole"
        for side in ("image_0", "image_1"):
            (folder / side).mkdir(parents=True)
            for i in range(count):
                (folder / side / f"{i:06d}.png").write_text(f"{side} {i}")
        (folder / "calib.txt").write_text("P0: 1\n")
        (folder / "times.txt").write_text("".join(f"{0.05 * i}\n" for i in range(count)))
        write_poses(folder / "poses.txt", [(0, 0, i) for i in range(count)])
        return folder

    def test_of_a_folder_are_a_folder_of_its_own(self):
        part = bars.first_frames(self.whole(9), 4)
        for side in ("image_0", "image_1"):
            self.assertEqual([path.read_text() for path in sorted((part / side).iterdir())], [f"{side} {i}" for i in range(4)])
        self.assertEqual([len((part / name).read_text().splitlines()) for name in ("times.txt", "poses.txt")], [4, 4])
        self.assertTrue((part / "calib.txt").exists())

    def test_what_an_earlier_run_left_is_not_mixed_in(self):
        folder = self.whole(6)
        (bars.first_frames(folder, 3) / "image_0" / "000099.png").write_text("old")
        self.assertEqual(len(list((bars.first_frames(folder, 3) / "image_0").iterdir())), 3)


class Tracks(FolderCase):
    def test_their_length_is_that_of_the_tracks_there_were(self):
        chance = np.random.default_rng(2)
        frames, tracks_ = 60, []  # (first, last) frame of each
        for frame in range(frames):
            tracks_ += [(frame, min(frame + int(chance.integers(0, 12)), frames - 1)) for _ in range(chance.integers(3, 9))]
        seen = [[t for t in tracks_ if t[0] <= i <= t[1]] for i in range(frames)]
        out, folder = self.folder / "out", self.folder / "sequence"
        out.mkdir(), folder.mkdir()
        with open(out / "stats.csv", "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(("stamp_ns", "accepted", "features", "tracked", "track_length_mean", "reprojection_px"))
            for i, those in enumerate(seen):
                writer.writerow((50_000_000 * i, 1, len(those), sum(t[0] < i for t in those), 1 + np.mean([i - t[0] for t in those]), 0.25))
                if i == 30:  # a frame that was refused does not count
                    writer.writerow((50_000_000 * i, 0, 0, 0, 0, 0))
        write_poses(folder / "poses.txt", [(0, 0, 0.04 * i) for i in range(frames)])
        summary = {"swf_vo": {"status_counts": {"OK": 58, "DEGRADED": 1, "LOST": 1}}}
        with mock.patch.object(tracks, "mapped", return_value=summary):
            found = tracks.column(folder, out)
        true = np.mean([last - first + 1 for first, last in tracks_])
        self.assertEqual(found["feature track length (frames)"], f"{true:.1f}")
        self.assertEqual([found[name] for name in ("frames a second", "velocity (m/s)", "way between frames (m)", "frames not OK")],
                         ["20", "0.80", "0.04", "2"])

    def test_a_spread_is_mean_least_and_most(self):
        self.assertEqual(tracks.spread([1.0, 2.0, 6.0], ".1f"), "3.0 (1.0 ... 6.0)")


class Rows(FolderCase):
    def test_a_world_too_short_for_10_m_and_a_peer_without_covariance_leave_cells_empty(self):
        found = {"spans": {}, "rpe_percent": 1.234, "rpe_deg_per_m": 0.01, "ate_m": 0.0123}
        self.assertEqual(worlds.row("quad", "peer", found), ["quad", "peer", "1.23 %, 0.0100 deg/m", "-", "12.3", "", "", ""])
        found |= {"spans": {"10m": {"percent": 0.5, "deg_per_m": 0.02}}, "nees_mean": 6.04,
                  "swf_vo": {"status_counts": {"OK": 3, "LOST": 2, "DEGRADED": 1}, "ms_median": 12.34}}
        self.assertEqual(worlds.row("quad", "swf_vo", found)[3:], ["0.50 %, 0.0200 deg/m", "12.3", "6.0", "3", "12.3"])
        self.assertEqual(len(worlds.row("quad", "peer", found)), len(worlds.COLUMNS))

    def test_a_table_is_kept_without_the_paths_of_this_machine(self):
        kept = self.folder / "table.json"
        words = ["/home/me/bars.py", "faults", "/data/out", "--peer", "viso=/opt/run_viso", "-o", str(kept)]
        with mock.patch("sys.argv", words), contextlib.redirect_stdout(io.StringIO()) as said:
            support.show(("a", "long name"), [["longer", "1"]], ["A note."], "abc1234+", kept)
        table = json.loads(kept.read_text())
        self.assertEqual(table["command"], "bars.py faults out --peer viso=run_viso -o table.json")
        self.assertEqual([table["columns"], table["rows"], table["notes"], table["commit"]],
                         [["a", "long name"], [["longer", "1"]], ["A note."], "abc1234+"])
        self.assertEqual(said.getvalue().splitlines(), ["a       long name", "longer  1", "A note."])


if __name__ == "__main__":
    run("bench_tables")
