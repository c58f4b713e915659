# SPDX-License-Identifier: BSD-3-Clause
import csv
import subprocess
import sys
import unittest
from pathlib import Path

import cv2
import numpy as np

from case import FolderCase, Spiral, run
import bags
import closures
from truth import angle, inverse

PROGRAM = Path(closures.__file__)


def pose_of(row):
    pose = np.eye(4)
    pose[:3, :3] = bags.rotation([float(row[key]) for key in ("qx", "qy", "qz", "qw")])
    pose[:3, 3] = [float(row[key]) for key in "xyz"]
    return pose


class Closures(FolderCase):
    """Rides on a spiral that climbs 0.1 m/s: a round takes 15.7 s, so that one may close on the next but one, and not on a much later one."""

    def session(self, name, begin=100.0, duration=160.0, wrong=()):
        folder = self.folder / f"{name}.truth"
        folder.mkdir()
        ride = Spiral(begin)
        ride.write(folder / "trajectory.tum", duration)
        pairs = [(begin + 0.5 * i, begin + 0.5 * i + 31.5) for i in range(int(2 * (duration - 32)))]
        for file, each in (("closures_true.csv", pairs), ("closures_false.csv", wrong)):
            if each:
                rows = "".join(f"0,{round(1e9 * a)},0,{round(1e9 * b)},0.99\n" for a, b in each)
                (folder / file).write_text("session_a,stamp_a_ns,session_b,stamp_b_ns,probability\n" + rows)
        return folder, ride, pairs

    def made(self, *arguments):
        output = self.folder / "closures.csv"
        done = subprocess.run([sys.executable, PROGRAM, *map(str, arguments), "-o", output], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(output) as file:
            rows = list(csv.DictReader(file))
        return rows, [line == "1" for line in Path(f"{output}.truth").read_text().split()]

    def errors(self, rows, ride_a, ride_b):
        """(rho, phi) of each, in the frame of a."""
        found = []
        for row in rows:
            a, b = ride_a.pose(1e-9 * int(row["stamp_a_ns"])), ride_b.pose(1e-9 * int(row["stamp_b_ns"]))
            exact, pose = inverse(a) @ b, pose_of(row)
            found.append([*(pose[:3, 3] - exact[:3, 3]), *cv2.Rodrigues(pose[:3, :3] @ exact[:3, :3].T)[0].ravel()])
        return np.array(found)

    def test_columns_are_those_of_the_contract_and_the_noise(self):
        folder, _, pairs = self.session("quad")
        rows, true = self.made(folder)
        self.assertEqual(",".join(rows[0]), "session_a,stamp_a_ns,session_b,stamp_b_ns,probability,kind,verdict,reason,x,y,z,qx,qy,qz,qw,weight,sigma_m,sigma_rad")
        self.assertTrue(all(true))
        self.assertEqual([(round(1e9 * a), round(1e9 * b)) for a, b in pairs], [(int(row["stamp_a_ns"]), int(row["stamp_b_ns"])) for row in rows])
        self.assertEqual({(row["session_a"], row["session_b"], row["kind"], row["verdict"]) for row in rows}, {("quad", "quad", "stereo", "accepted")})
        self.assertEqual(float(rows[0]["sigma_m"]), 0.05)
        self.assertAlmostEqual(float(rows[0]["sigma_rad"]), np.radians(0.5))

    def test_without_noise_they_are_the_truth(self):
        folder, ride, _ = self.session("quad")
        rows, _ = self.made(folder.with_suffix(".bag"), "--sigma-m", 1e-9, "--sigma-deg", 1e-7)
        self.assertLess(np.abs(self.errors(rows, ride, ride)).max(), 1e-6)

    def test_their_noise_is_as_stated(self):
        folder, ride, _ = self.session("quad", duration=300)
        rows, _ = self.made(folder, "--sigma-m", 0.2, "--sigma-deg", 3)
        errors = self.errors(rows, ride, ride) / np.repeat([0.2, np.radians(3)], 3)
        count = errors.shape[0]
        for axis in range(6):  # four deviations of the mean of a chi-square
            self.assertAlmostEqual(np.mean(errors[:, axis] ** 2), 1.0, delta=4 * np.sqrt(2 / count))
            self.assertAlmostEqual(np.mean(errors[:, axis]), 0.0, delta=4 / np.sqrt(count))

    def test_false_ones_say_that_distant_places_are_nearly_one(self):
        folder, ride, pairs = self.session("quad", wrong=[(101.0, 240.0)])
        rows, true = self.made(folder, "--false", 20)
        wrong = [row for row, right in zip(rows, true) if not right]
        self.assertEqual(len(wrong), round(0.2 * len(pairs)))
        self.assertIn(("101000000000", "240000000000"), [(row["stamp_a_ns"], row["stamp_b_ns"]) for row in wrong])
        for row in wrong:
            a, b = (1e-9 * int(row[key]) for key in ("stamp_a_ns", "stamp_b_ns"))
            self.assertGreater(b, a + 30)
            self.assertGreater(np.linalg.norm(ride.position(a) - ride.position(b)), 10.0)
        poses = [pose_of(row) for row in wrong]
        self.assertAlmostEqual(np.sqrt(np.mean([pose[:3, 3] ** 2 for pose in poses])), 0.3, delta=0.1)
        self.assertAlmostEqual(np.sqrt(np.mean([angle(pose[:3, :3]) ** 2 for pose in poses]) / 3), 10.0, delta=3.0)
        self.assertEqual([row["stamp_b_ns"] for row in rows], sorted((row["stamp_b_ns"] for row in rows), key=int), "they stand among the true ones")
        self.assertEqual({row["weight"] for row in rows}, {"1"})

    def test_sessions_are_joined_where_both_have_been(self):
        monday, _, pairs = self.session("monday", duration=60)
        tuesday, _, _ = self.session("tuesday", begin=5000.0, duration=160)
        rows, true = self.made(monday, tuesday, "--sigma-m", 1e-9, "--sigma-deg", 1e-7)
        between = [row for row in rows if row["session_a"] != row["session_b"]]
        self.assertEqual({(row["session_a"], row["session_b"]) for row in between}, {("monday", "tuesday")})
        self.assertEqual(len(rows) - len(between), len(pairs) + 256)
        self.assertLess(np.abs(self.errors(between, Spiral(100.0), Spiral(5000.0))).max(), 1e-6)
        # Monday's ride ended 6 m up: what lies up to 7.5 m above is the same place, and a look is 5 cm.
        self.assertTrue(250 < len(between) <= 271, len(between))
        self.assertTrue(all(true))

    def test_a_seed_decides_and_every_nth_may_do(self):
        folder, _, pairs = self.session("quad")
        one, same, other = (self.made(folder, "--false", 10, "--seed", seed)[0] for seed in (4, 4, 5))
        self.assertEqual(one, same)
        self.assertNotEqual(one, other)
        self.assertEqual(len(self.made(folder, "--every", 10)[0]), (len(pairs) + 9) // 10)

    def test_verdicts_are_those_of_their_ends_whatever_the_order(self):
        rows = [["day1", 10, "day1", 90, 0.99], ["day1", 20, "day2", 200, 0.99], ["day1", 30, "day1", 100, 0.99]]
        path = self.folder / "map.csv"
        path.write_text("session_a,stamp_a_ns,session_b,stamp_b_ns,verdict\nday1,30,day1,100,rejected\nday1,10,day1,90,accepted\nday1,20,day2,200,waiting\n")
        found = [(row["verdict"], right) for row, right in closures.outcomes(path, rows, [True, True, False])]
        self.assertEqual(found, [("rejected", False), ("accepted", True), ("waiting", True)])

    def test_what_is_not_there_is_named(self):
        done = subprocess.run([sys.executable, PROGRAM, self.folder / "gone.bag", "-o", self.folder / "x"], capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("gone.truth/trajectory.tum", done.stderr)
        folder, _, _ = self.session("quad")
        done = subprocess.run([sys.executable, PROGRAM, folder, folder, "-o", self.folder / "x"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("one name", done.stderr)


class Turns(unittest.TestCase):
    def test_a_quaternion_gives_its_matrix_back(self):
        for vector in ([0, 0, 0], [1e-9, 0, 0], [0.3, -0.2, 0.1], [0, 0, np.pi], [2, 1, -2.0]):
            turn = cv2.Rodrigues(np.array(vector, float))[0]
            np.testing.assert_allclose(bags.rotation(closures.quaternion(turn)), turn, atol=1e-12)


if __name__ == "__main__":
    run("bench_closures")
