# SPDX-License-Identifier: BSD-3-Clause
"""From two days in a simulated world to one map by `urban_nav map`: odometry, closures of which some are false, and relaxation.

Each case is WORLD:SEED:SECONDS of the first day:SECONDS of the second one. The closures come from the truth (closures.py): 0.05 m and 0.5 deg of noise about
each axis, and false ones that state that two places nearly coincide. Four ways to map them:
  relaxed    as shipped
  leaning    pose_graph.gravity=false: roll and pitch are those of odometry and closures
  trusting   pose_graph.robust=false: every closure is accepted
  apart      between the days only the false closures: the result must be two maps

The error is that of all poses of both days in one frame, aligned at the first pose of the first day. Odometry has no such frame: its error is that of each day
relative to its first pose, which is favourable to it.
"""
import argparse
import json
from pathlib import Path

import numpy as np

import closures
from support import commit, show, simulated_bag, urban_nav

WAYS = {"relaxed": (), "leaning": ("--set", "pose_graph.gravity=false"), "trusting": ("--set", "pose_graph.robust=false"), "apart": ()}
COLUMNS = ("world, seed", "way", "driven, m", "true closures kept", "false ones kept", "sessions in one map", "odometry, rms, m", "relaxed, rms, m",
           "of the way", "times better", "NEES, odometry", "NEES, relaxed", "level off, deg", "stated, deg", "relaxation, ms", "covariances, ms")
SENSORS = "stereo,imu,wheels"


def driven(folder, case):
    """Returns the bags of both days; existing ones are used."""
    world, seed, *durations = case.split(":")
    bags = []
    for day, duration in enumerate(durations, 1):
        bags.append(simulated_bag(folder / f"{world}{seed}_day{day}.bag", world, seed, duration, "--day", day, "--sensors", SENSORS))
    return bags


def offered(bags, way, arguments, path):
    """Writes the closures; returns their rows and whether each is true."""
    sessions = [closures.Session(bag) for bag in bags]
    rows, true = closures.rows_of(sessions, arguments.false, arguments.sigma_m, float(np.radians(arguments.sigma_deg)), arguments.seed)
    if way == "apart":
        kept = [i for i, (row, right) in enumerate(zip(rows, true)) if not right or row[0] == row[2]]
        rows, true = [rows[i] for i in kept], [true[i] for i in kept]
    path.write_text("\n".join(",".join(map(str, row)) for row in (closures.COLUMNS, *rows)) + "\n")
    return rows, true


def both_truths(bags, path):
    path.write_text("".join(line + "\n" for bag in bags for line in bag.with_suffix(".truth").joinpath("trajectory.tum").read_text().splitlines()
                            if not line.startswith("#")))
    return path


def root_mean_square(values, weights):
    return float(np.sqrt(np.average(np.square(values), weights=weights)))


def up_of_first_pose(trajectory):
    """Returns the direction of z in the axes of the first pose of a file in TUM format."""
    line = next(line for line in Path(trajectory).read_text().splitlines() if not line.startswith("#"))
    x, y, z, w = map(float, line.split()[4:8])
    return np.array([2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)])


def level_off_deg(bag, trajectory):
    a, b = up_of_first_pose(bag.with_suffix(".truth") / "trajectory.tum"), up_of_first_pose(trajectory)
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b)))


def row_of(case, way, bags, arguments):
    name = f"{bags[0].stem.rsplit('_', 1)[0]}_{way}"
    out = arguments.folder / name
    rows, true = offered(bags, way, arguments, arguments.folder / f"{name}.csv")
    urban_nav("map", *bags, "--stages", "vo,graph", "--closures", arguments.folder / f"{name}.csv", "--out", out, *WAYS[way])
    summary = json.loads((out / "summary.json").read_text())
    urban_nav("evaluate", "--truth", both_truths(bags, arguments.folder / "truth.tum"), "--estimate", out / "trajectory.tum", "--json", out / "errors.json")
    errors, graph = json.loads((out / "errors.json").read_text()), summary["pose_graph"]
    found = closures.outcomes(out / "closures.csv", rows, true)
    right, wrong = ([row["verdict"] == "accepted" for row, right in found if right == which] for which in (True, False))
    days = graph["per_session"]
    frames = [day["frames"] for day in days]
    before = root_mean_square([day["ate_m_odometry"] for day in days], frames)
    lengths = [np.linalg.norm(np.diff(closures.Session(bag).places, axis=0), axis=1).sum() for bag in bags]
    driven_m = sum(lengths)
    cells = [case.replace(":", " ").rsplit(" ", 2)[0], way, " + ".join(f"{length:.0f}" for length in lengths), f"{sum(right)} of {len(right)}",
             f"{sum(wrong)} of {len(wrong)}", f"{graph['sessions_joined']} of {len(days)}", f"{before:.3f}"]
    if graph["sessions_joined"] == len(days):
        cells += [f"{errors['ate_m']:.3f}", f"{100 * errors['ate_m'] / driven_m:.3f} %", f"{before / errors['ate_m']:.1f}"]
    else:  # no common frame: each in its own
        after = root_mean_square([day["ate_m"] for day in days], frames)
        cells += [f"{after:.3f} (two frames)", f"{100 * after / driven_m:.3f} %", f"{before / after:.1f}"]
    return [*cells, *(f"{np.average([day[key] for day in days], weights=frames):.1f}" for key in ("nees_odometry", "nees")),
            f"{level_off_deg(bags[0], out / 'trajectory.tum'):.3f}", f"{graph['level']['sigma_deg']:.3f}" if graph["level"]["known"] else "not known",
            f"{graph['ms_batch']:.0f}", f"{graph['ms_covariances']:.0f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of simulated sessions and maps; existing sessions are used")
    parser.add_argument("--case", action="append", help="WORLD:SEED:SECONDS:SECONDS, repeatable (default quad:7:300:300)")
    parser.add_argument("--way", action="append", choices=WAYS, help="repeatable (default: all)")
    parser.add_argument("--false", type=float, default=20.0, metavar="PERCENT", help="false closures, relative to the number of true ones (default 20)")
    parser.add_argument("--sigma-m", type=float, default=0.05, help="standard deviation of x, y and z of true closures (default 0.05)")
    parser.add_argument("--sigma-deg", type=float, default=0.5, help="standard deviation of rotation about x, y and z (default 0.5)")
    parser.add_argument("--seed", type=int, default=1, help="seed of the closures")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    measured = commit()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    rows = []
    for case in arguments.case or ["quad:7:300:300"]:
        bags = driven(arguments.folder, case)
        rows += [row_of(case, way, bags, arguments) for way in arguments.way or WAYS]
    notes = [f"Closures with {arguments.sigma_m} m and {arguments.sigma_deg} deg of noise about each axis, {arguments.false:.0f} % as many false ones, "
             f"seed {arguments.seed}. NEES: 6 is expected."]
    show(COLUMNS, rows, notes, measured, arguments.output)


if __name__ == "__main__":
    main()
