#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Distances of map points to the true surfaces in simulated sessions, for the true trajectory, odometry, and the relaxed one.

A case is WORLD:SEED:DAY:SECONDS. Distances are those of laser_mapper/bench/distance_to_truth.py; along the truth, a copy of the store is rendered by
laser_mapper/bench/render_store.cpp. What is simulated and mapped stays in the folder.
"""
import argparse
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
from support import SENSORS, TOP, commit, show, simulated_bag, urban_nav

sys.path.insert(0, str(TOP / "laser_mapper" / "bench"))
from distance_to_truth import measure  # noqa: E402

COLUMNS = ("session", "trajectory", "median, mm", "95 %, cm", "99 %, cm", "error over sigma, median", "mixed pixels dropped")
RENDER = TOP / "build" / "ws" / "devel" / "lib" / "laser_mapper" / "laser_mapper-bench-render_store"


def figures(map_ply, truth, trajectory=None):
    distance, sigma = measure(map_ply, truth, trajectory)["lasers"]
    return [f"{1e3 * np.median(distance):.1f}", f"{100 * np.quantile(distance, .95):.1f}", f"{100 * np.quantile(distance, .99):.1f}",
            f"{np.median(distance / sigma):.2f}"]


def mapped(bag, out, stages):
    """Runs the stages on a bag; returns the error of the trajectory and the figures of the row."""
    urban_nav("map", bag, "--out", out, "--overwrite", "--stages", stages, "--set", "laser_mapper.stereo=false")
    found = json.loads((out / "summary.json").read_text())
    lasers = found["laser_mapper"]
    return (f"ATE {100 * found['ate_m']:.1f} cm",
            [*figures(out / "map.ply", bag.with_suffix(".truth"), out / "trajectory.tum"), f"{100 * lasers['beams_mixed'] / lasers['beams']:.2f} %"])


def rows(folder, case):
    world, seed, day, duration = case.split(":")
    bag = simulated_bag(folder / f"{world}{seed}_day{day}_{duration}.bag", world, seed, duration, "--day", day, "--sensors", SENSORS)
    truth = bag.with_suffix(".truth")
    name = f"{world}, day {day}, {duration} s"
    along_odometry, relaxed = folder / f"{bag.stem}_odometry", folder / f"{bag.stem}_relaxed"
    made = []
    for way, out, stages in (("odometry", along_odometry, "vo,graph,lasers"), ("relaxed", relaxed, "vo,places,loops,graph,lasers")):
        ate, row = mapped(bag, out, stages)
        made.append([name, f"{way}, {ate}", *row])
    store, true_map = folder / f"{bag.stem}_true.db", folder / f"{bag.stem}_true.ply"
    shutil.copy(along_odometry / "session.db", store)
    told = subprocess.run([RENDER, store, truth / "trajectory.tum", true_map], capture_output=True, text=True, check=True).stdout
    return [[name, "true", *figures(true_map, truth), f"{re.search(r'mixed ([0-9.]+) %', told)[1]} %"], *made]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of simulated sessions and maps; existing sessions are used")
    parser.add_argument("cases", nargs="+", metavar="WORLD:SEED:DAY:SECONDS")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    before = commit()
    table = [row for case in arguments.cases for row in rows(arguments.folder, case)]
    note = ("Points nearer than 20 m to the laser, leaves excluded; maps along estimates are moved by the rigid motion that aligns the poses. Error over "
            "sigma: 0.67 is expected; along the truth the poses have no covariance.")
    show(COLUMNS, table, [note], before, arguments.output)


if __name__ == "__main__":
    main()
