#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Effect on a map of planes measured by several passes: a session that returns along its path, mapped with and without constraints from
them, by odometry alone and with all stages.

Distances are those of laser_mapper/bench/distance_to_truth.py. What is simulated and mapped stays in the folder.
"""
import argparse
import json
import sys
from pathlib import Path

import numpy as np
from support import TOP, commit, show, simulated_bag, urban_nav

sys.path.insert(0, str(TOP / "laser_mapper" / "bench"))
from distance_to_truth import measure  # noqa: E402

COLUMNS = ("stages", "constraints from planes", "closures", "ATE, cm", "NEES", "displacement of walls, mm", "distance to truth, median, mm",
           "95 %, cm", "99 %, cm", "error over sigma, median", "s of processor time")
STAGES = {"odometry": ("--stages", "vo,graph,lasers"), "all": ()}


def cell(value, scale, digits):
    """Returns a figure, or a dash if the run has none: no wall is observed twice."""
    return "-" if value is None else f"{scale * value:.{digits}f}"


def row(bag, name, planes):
    out = bag.parent / f"{bag.stem}_{name}_{'planes' if planes else 'plain'}"
    urban_nav("map", bag, "--out", out, "--overwrite", *STAGES[name], "--set", f"laser_mapper.constraints={str(planes).lower()}")
    found = json.loads((out / "summary.json").read_text())
    distance, sigma = measure(out / "map.ply", bag.parent / f"{bag.stem}.truth", out / "trajectory.tum")["lasers"]
    loops, lasers = found.get("loop_metric", {}), found["laser_mapper"]
    return [name, "yes" if planes else "no", str(loops.get("accepted_icp", 0) + loops.get("accepted_stereo", 0)), f"{100 * found['ate_m']:.1f}",
            f"{found['nees_mean']:.1f}", cell(lasers["displacement_m_mean"], 1e3, 0), f"{1e3 * np.median(distance):.1f}",
            f"{100 * np.quantile(distance, .95):.1f}", f"{100 * np.quantile(distance, .99):.1f}", f"{np.median(distance / sigma):.2f}",
            f"{found['cpu_s']:.1f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of simulated sessions and maps; existing sessions are used")
    parser.add_argument("--world", default="quad")
    parser.add_argument("--route", default="return")
    parser.add_argument("--seed", type=int, default=40)
    parser.add_argument("--duration", type=int, default=70, help="s (default 70)")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    before = commit()
    name = f"{arguments.world}{arguments.seed}_{arguments.route}{arguments.duration}"
    bag = simulated_bag(arguments.folder / f"{name}.bag", arguments.world, arguments.seed, arguments.duration, "--route", arguments.route,
                        "--sensors", "stereo,ladybug,lasers,imu,wheels")
    rows = [row(bag, stages, planes) for stages in STAGES for planes in (False, True)]
    note = f"{arguments.duration} s of route {arguments.route} in {arguments.world}, seed {arguments.seed}. Expected: 6 (NEES) and 0.67 (error over sigma)."
    show(COLUMNS, rows, [note], before, arguments.output)


if __name__ == "__main__":
    main()
