# SPDX-License-Identifier: BSD-3-Clause
"""Makes closures with their transforms from the truth of simulated sessions, for `urban_nav map --closures`.

Reads trajectory.tum, closures_true.csv and, if it exists, closures_false.csv of each BAG_STEM.truth/ of `simulate`, and finds the common places of
two sessions (all days of a world share one frame). A true closure is the true T_a_b with noise in the frame of a; a false one states that two
places nearly coincide, as after a wrong recognition: 0.3 m and 10 deg of deviation about each axis. The file does not distinguish them.

Sessions are named by the stem of their bags, as in `map`. Columns as in closures.csv, followed by the standard deviations of the noise.
"""
import argparse
import csv
import io
import sys
from pathlib import Path

import cv2
import numpy as np

from truth import Truth, inverse

COLUMNS = ("session_a", "stamp_a_ns", "session_b", "stamp_b_ns", "probability", "kind", "verdict", "reason", "x", "y", "z", "qx", "qy", "qz", "qw",
           "weight", "sigma_m", "sigma_rad")
SAME_PLACE, OTHER_PLACE = 7.5, 10.0  # m, as in the simulator
APART = 30.0  # s, within a session
PERIOD = 0.5  # s between panoramas
WRONG_PLACE, WRONG_TURN = 0.3, np.radians(10.0)  # of a false closure, each axis


class Session:
    def __init__(self, path):
        """`path`: the folder of the truth, or its bag."""
        folder = path if path.suffix == ".truth" else path.with_suffix(".truth")
        for name in ("trajectory.tum", "closures_true.csv"):
            if not (folder / name).exists():
                sys.exit(f"{folder / name}: no such file; simulate writes it beside its bag")
        self.name, self.truth = folder.stem, Truth(folder / "trajectory.tum")
        self.closures = {True: closures_of(folder / "closures_true.csv"), False: closures_of(folder / "closures_false.csv")}
        seconds = np.arange(self.truth.stamps[0], self.truth.stamps[-1], PERIOD)
        self.looks = np.rint(seconds * 1e9).astype(np.int64)
        self.places = self.at(self.looks)[:, :3, 3]

    def at(self, stamps):
        return self.truth.at(np.asarray(stamps) * 1e-9)


def closures_of(path):
    """Returns pairs (stamp a, stamp b) in ns."""
    if not path.exists():
        return []
    with open(path) as file:
        return [(int(row["stamp_a_ns"]), int(row["stamp_b_ns"])) for row in csv.DictReader(file)]


def in_common(earlier, later):
    """Returns for each sample of `later` the nearest of `earlier` if it is the same place."""
    found = []
    for stamp, place in zip(later.looks, later.places):
        distances = np.linalg.norm(earlier.places - place, axis=1)
        nearest = distances.argmin()
        if distances[nearest] <= SAME_PLACE:
            found.append((int(earlier.looks[nearest]), int(stamp)))
    return found


def true_pairs(sessions):
    """Returns (session a, stamp a, session b, stamp b)."""
    pairs = [(i, a, i, b) for i, session in enumerate(sessions) for a, b in session.closures[True]]
    for j, later in enumerate(sessions):
        for i, earlier in enumerate(sessions[:j]):
            pairs += [(i, a, j, b) for a, b in in_common(earlier, later)]
    return pairs


def false_pairs(sessions, count, chance):
    """Returns those of the files of the simulator, and random ones up to `count`."""
    pairs = [(i, a, i, b) for i, session in enumerate(sessions) for a, b in session.closures[False]]
    for _ in range(1000 * count):
        if len(pairs) >= count:
            break
        i, j = sorted(chance.integers(len(sessions), size=2))
        a, b = chance.integers(len(sessions[i].looks)), chance.integers(len(sessions[j].looks))
        if i == j and a > b:
            a, b = b, a
        far = np.linalg.norm(sessions[i].places[a] - sessions[j].places[b]) > OTHER_PLACE
        if far and (i != j or (b - a) * PERIOD > APART):
            pairs.append((int(i), int(sessions[i].looks[a]), int(j), int(sessions[j].looks[b])))
    if len(pairs) < count:
        sys.exit("the sessions have no places that lie far enough apart for false closures")
    return pairs


def moved_by(pose, noise):
    """Returns [Exp(phi) R, t + rho], both in the parent frame."""
    result = pose.copy()
    result[:3, :3] = cv2.Rodrigues(noise[3:])[0] @ pose[:3, :3]
    result[:3, 3] += noise[:3]
    return result


def quaternion(turn):
    """Returns x, y, z, w of a rotation matrix, w >= 0, by the largest component (Shepperd 1978)."""
    products = np.zeros((4, 4))  # 4 q q^T
    products[:3, :3] = turn + turn.T + (1 - np.trace(turn)) * np.eye(3)
    products[:3, 3] = products[3, :3] = turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]
    products[3, 3] = 1 + np.trace(turn)
    row = products[np.argmax(np.diag(products))]
    return row / np.linalg.norm(row) * (-1 if row[3] < 0 else 1)


def rows_of(sessions, percent, sigma_m, sigma_rad, seed, every=1):
    """Returns the rows of the file and whether each is true."""
    chance = np.random.default_rng(seed)
    right = true_pairs(sessions)[::every]
    wrong = false_pairs(sessions, round(0.01 * percent * len(right)), chance)
    rows = []
    for pairs, true in ((right, True), (wrong, False)):
        for i, a, j, b in pairs:
            if true:
                scale = [sigma_m] * 3 + [sigma_rad] * 3
                pose = inverse(sessions[i].at([a])[0]) @ sessions[j].at([b])[0]
            else:
                scale = [WRONG_PLACE] * 3 + [WRONG_TURN] * 3
                pose = np.eye(4)
            pose = moved_by(pose, scale * chance.normal(size=6))
            numbers = [repr(float(x)) for x in (*pose[:3, 3], *quaternion(pose[:3, :3]))]
            key = (j, b, i, a)
            rows.append((key, true, [sessions[i].name, a, sessions[j].name, b, 0.99, "stereo", "accepted", "", *numbers, 1, sigma_m, sigma_rad]))
    rows.sort(key=lambda row: row[0])
    return [row for _, _, row in rows], [true for _, true, _ in rows]


def ends(row):
    """Returns session and stamp of both ends of a row of the input file or of closures.csv of a map."""
    a, stamp_a, b, stamp_b = (row[key] for key in COLUMNS[:4]) if isinstance(row, dict) else row[:4]
    return a, int(stamp_a), b, int(stamp_b)


def outcomes(path, rows, true):
    """Returns each row of closures.csv of a map and whether it is true, by the input `rows`; a map writes closures in the order of time."""
    truth = {ends(row): right for row, right in zip(rows, true)}
    with open(path) as file:
        return [(row, truth[ends(row)]) for row in csv.DictReader(file)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("session", type=Path, nargs="+", help="a simulated bag, or its BAG_STEM.truth; in the order in which map gets them")
    parser.add_argument("-o", "--output", type=Path, required=True, help="file of closures; OUTPUT.truth states for each row whether it is true")
    parser.add_argument("--false", type=float, default=0.0, metavar="PERCENT", help="false closures, relative to the number of true ones")
    parser.add_argument("--sigma-m", type=float, default=0.05, help="standard deviation of x, y and z of true closures (default 0.05)")
    parser.add_argument("--sigma-deg", type=float, default=0.5, help="standard deviation of rotation about x, y and z (default 0.5)")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="use only every Nth true closure")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    if not (arguments.false >= 0 and arguments.sigma_m > 0 and arguments.sigma_deg > 0 and arguments.every > 0):
        parser.error("--false is at least 0; --sigma-m, --sigma-deg and --every are above it")
    sessions = [Session(path) for path in arguments.session]
    if len({session.name for session in sessions}) < len(sessions):
        parser.error("two sessions have one name: a closure could not say which it means")
    rows, true = rows_of(sessions, arguments.false, arguments.sigma_m, float(np.radians(arguments.sigma_deg)), arguments.seed, arguments.every)
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([COLUMNS, *rows])
    arguments.output.write_text(text.getvalue())
    Path(f"{arguments.output}.truth").write_text("".join(f"{int(each)}\n" for each in true))
    print(f"{sum(true)} true closures and {len(true) - sum(true)} false ones")


if __name__ == "__main__":
    main()
