# SPDX-License-Identifier: BSD-3-Clause
"""Closures that `urban_nav map` proposes and accepts by a 3D LiDAR alone, against the truth.

Days of a simulated world are mapped in one run, without images and without given candidates. A place is a point each 3 m of the true path; it is a revisit if an
earlier one lies within 3 m, in another session or 20 m further back along the path. It is closed if an accepted closure begins or ends within 3 m of path of it. A
closure is false if it is wrong by more than 0.3 m or 2 deg.
"""
import argparse
import csv
import json
from pathlib import Path

import numpy as np

from support import commit, driven, show, urban_nav

COLUMNS = ("world, seed, seconds of each day", "rings", "revisits", "of these in the opposite direction", "closed", "closed, opposite", "proposed", "accepted", "false", "error, median, mm", "95 %", "largest",
           "sessions in the map", "ms a candidate")
SPACING_M, NEAR_M, APART_M = 3.0, 3.0, 20.0
FALSE_M, FALSE_RAD = 0.3, np.radians(2.0)


class Truth:
    """True path of a session."""

    def __init__(self, path):
        rows = np.loadtxt(path, comments="#")
        with open(path) as file:
            texts = [line.split()[0].partition(".") for line in file if not line.startswith("#")]
        self.stamps = np.array([int(seconds) * 10**9 + int((rest + "0" * 9)[:9]) for seconds, _, rest in texts])
        self.places, self.turns = rows[:, 1:4], rows[:, 4:8]
        self.paths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(self.places, axis=0), axis=1))])

    def index(self, stamp):
        return int(np.clip(np.searchsorted(self.stamps, stamp), 0, len(self.stamps) - 1))

    def pose(self, stamp):
        i = self.index(stamp)
        x, y, z, w = self.turns[i]
        pose = np.eye(4)
        pose[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
        pose[:3, 3] = self.places[i]
        return pose

    def heading(self, i):
        x, y, z, w = self.turns[i]
        return np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def revisits(truths):
    """Returns (session, path, is in the opposite direction) of each revisited place."""
    before, found = [], []
    for session, truth in enumerate(truths):
        for path in np.arange(0.0, truth.paths[-1], SPACING_M):
            i = min(int(np.searchsorted(truth.paths, path)), len(truth.paths) - 1)
            near = [(np.linalg.norm(truth.places[i] - place), abs(np.angle(np.exp(1j * (heading - truth.heading(i))))))
                    for other, there, place, heading in before if other != session or path - there >= APART_M]
            near = [turn for distance, turn in near if distance <= NEAR_M]
            if near:
                found.append((session, path, min(near) > np.pi / 2))
            before.append((session, path, truth.places[i], truth.heading(i)))
    return found


def error_of(row, truths, names):
    a, b = (truths[names.index(row[f"session_{end}"])].pose(int(row[f"stamp_{end}_ns"])) for end in "ab")
    x, y, z, w = (float(row[key]) for key in ("qx", "qy", "qz", "qw"))
    measured = np.eye(4)
    measured[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    measured[:3, 3] = [float(row[key]) for key in "xyz"]
    off = np.linalg.inv(np.linalg.inv(a) @ b) @ measured
    return np.linalg.norm(off[:3, 3]), np.arccos(np.clip((np.trace(off[:3, :3]) - 1) / 2, -1, 1))


def row_of(case, rings, folder):
    bags = driven(folder / rings, case, "lidar3d", "--lidar", rings)
    out = folder / rings / case.replace(":", "_").replace("/", "_")
    urban_nav("map", *bags, "--stages", "lo,loops,graph", "--overwrite", "--out", out)
    truths, names = [Truth(bag.with_suffix(".truth") / "trajectory.tum") for bag in bags], [bag.stem for bag in bags]
    with (out / "closures.csv").open() as file:
        rows = list(csv.DictReader(file))
    accepted = [row for row in rows if row["verdict"] == "accepted"]
    errors = np.array([error_of(row, truths, names) for row in accepted]).reshape(-1, 2)
    false = np.logical_or(errors[:, 0] > FALSE_M, errors[:, 1] > FALSE_RAD)
    ends = {}
    for row in (row for row, is_false in zip(accepted, false) if not is_false):
        for end in "ab":
            session = names.index(row[f"session_{end}"])
            ends.setdefault(session, []).append(truths[session].paths[truths[session].index(int(row[f"stamp_{end}_ns"]))])
    found = revisits(truths)
    closed = [any(abs(path - end) <= SPACING_M for end in ends.get(session, [])) for session, path, _ in found]
    opposite = [is_closed for is_closed, (*_, is_opposite) in zip(closed, found) if is_opposite]
    summary = json.loads((out / "summary.json").read_text())
    true = 1e3 * errors[~false, 0]
    figures = [f"{np.median(true):.1f}", f"{np.quantile(true, 0.95):.1f}", f"{true.max():.1f}"] if len(true) else [""] * 3
    return [case, rings, str(len(found)), str(len(opposite)), str(sum(closed)), str(sum(opposite)), str(len(rows)), str(len(accepted)), str(int(false.sum())), *figures,
            f"{summary['pose_graph']['sessions_joined']} of {len(bags)}", f"{summary['loop_metric']['ms_median']:.0f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of simulated sessions; existing ones are used")
    parser.add_argument("--case", action="append", help="WORLD:SEED:SECONDS[/ROUTE][:SECONDS[/ROUTE]]..., repeatable (default quad:7:60/return:60)")
    parser.add_argument("--rings", default="16", help="rings of the LiDAR (default 16)")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    measured = commit()
    rows = []
    for case in arguments.case or ["quad:7:60/return:60"]:
        (arguments.folder / arguments.rings).mkdir(parents=True, exist_ok=True)
        rows.append(row_of(case, arguments.rings, arguments.folder))
        print(" | ".join(rows[-1]), flush=True)
    show(COLUMNS, rows, ["A 3D LiDAR alone, without given candidates. Places each 3 m of path; closed: an accepted, true closure within 3 m of path."], measured, arguments.output)


if __name__ == "__main__":
    main()
