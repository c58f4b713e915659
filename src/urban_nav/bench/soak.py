# SPDX-License-Identifier: BSD-3-Clause
"""A long drive with a fault in every period: tests that the final error of visual odometry is consistent with its covariance.

Every 20 s another fault of the stereo camera, by chance: which, how long, and the seed are printed. The last pose is compared with the truth, and with its
own covariance: with six degrees of freedom a right one leaves a normalised squared error above 16.8 once in a hundred times. What each fault leaves behind
is said as well, beside spans as long in which nothing goes wrong.
"""
import argparse
import json
import random
import sys
from pathlib import Path

import numpy as np

import bags
from support import commit, show, urban_nav
from truth import Truth, angle, inverse

EVERY = 20  # s
AFTER = 1.0  # s after the end of a fault until its span ends: tracking has recovered
PEACE = 15.0  # s after the start of a period: the faults of some_fault and their effects have ended
LITTLE = (0.04, 0.3)  # m, deg: smaller errors are not distinguishable from fault-free odometry
WORST = 16.81  # chi-square, 6 degrees of freedom, 99 %
COLUMNS = ("world", "faults", "length, m", "status at the end", "frames not OK", "position off at the end, m", "NEES at the end", "mean NEES")


def some_fault(chance, start):
    """Returns the fault of the 20 s from `start`; it ends before the next."""
    kind = chance.choice(("drop", "freeze", "swap", "corrupt", "unplug", "nan"))
    begin, duration = start + chance.uniform(2.0, 10.0), chance.uniform(0.2, 3.0)
    share = f":{chance.uniform(0.1, 0.5):.2f}" if kind in ("drop", "corrupt") else ""
    return f"{kind}:stereo:{begin:.2f}:{duration:.2f}{share}"


def poses_of(path):
    """Returns stamps (s) and poses of a TUM file."""
    rows = np.loadtxt(path)
    poses = np.tile(np.eye(4), (len(rows), 1, 1))
    poses[:, :3, :3], poses[:, :3, 3] = bags.rotation(rows[:, 4:8]), rows[:, 1:4]
    return rows[:, 0], poses


def span_of(fault):
    """Returns start and end of a fault, s from the start of the session."""
    begin, duration = (float(word) for word in fault.split(":")[2:4])
    return begin, begin + duration


def left_behind(spans, stamps, poses, truth):
    """Returns the error (m, deg) of the motion from the last frame before each span (s from the start of the session) to the first frame AFTER its end."""
    found = []
    for begin, end in spans:
        first = max(np.searchsorted(stamps, truth.stamps[0] + begin) - 1, 0)
        last = min(np.searchsorted(stamps, truth.stamps[0] + end + AFTER), len(stamps) - 1)
        true = truth.at(stamps[[first, last]])
        off = inverse(inverse(true[0]) @ true[1]) @ inverse(poses[first]) @ poses[last]
        found.append((np.linalg.norm(off[:3, 3]), angle(off[:3, :3])))
    return np.array(found)


def costs(faults, stamps, poses, truth):
    """Returns the effect of the faults as text."""
    spans = [span_of(fault) for fault in faults]
    cost = left_behind(spans, stamps, poses, truth)
    peace = left_behind([(begin - begin % EVERY + PEACE, begin - begin % EVERY + PEACE + end - begin) for begin, end in spans], stamps, poses, truth)
    little = (cost <= LITTLE).all(1)
    words = [f"{fault} {metres:.3f} m {degrees:.2f} deg" for fault, (metres, degrees) in zip(faults, cost)]
    ordinary, most = np.median(peace, 0), cost.max(0)
    return [f"Left behind by each (the way from the last frame before it to the first one {AFTER:.0f} s after its end, off by): {', '.join(words)}.",
            f"{little.sum()} of the {len(faults)} leave at most {100 * LITTLE[0]:.0f} cm and {LITTLE[1]} deg behind, the worst {most[0]:.2f} m, "
            f"{most[1]:.2f} deg; spans as long without a fault {100 * ordinary[0]:.1f} cm and {ordinary[1]:.2f} deg (median), "
            f"at most {100 * peace[:, 0].max():.1f} cm and {peace[:, 1].max():.2f} deg."]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of simulated sessions and maps")
    parser.add_argument("--world", default="quad")
    parser.add_argument("--route", default="loops")
    parser.add_argument("--seed", type=int, default=1, help="seed of world and faults")
    parser.add_argument("--duration", type=int, default=600, help="s (default 600)")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    measured, chance = commit(), random.Random(arguments.seed)
    faults = [some_fault(chance, start) for start in range(EVERY, arguments.duration - EVERY // 2, EVERY)]
    print(f"seed {arguments.seed}: {', '.join(faults)}")

    arguments.folder.mkdir(parents=True, exist_ok=True)
    bag = arguments.folder / f"soak_{arguments.world}{arguments.seed}.bag"
    out = bag.with_suffix("")
    if not bag.exists():
        urban_nav("simulate", "--world", arguments.world, "--route", arguments.route, "--seed", arguments.seed, "--duration", arguments.duration,
                  "--sensors", "stereo", *(word for fault in faults for word in ("--fault", fault)), "-o", bag)
    urban_nav("map", bag, "--stages", "vo", "--out", out)
    # Last pose and its covariance compared with the truth.
    urban_nav("evaluate", "--truth", bag.with_suffix(".truth") / "trajectory.tum", "--estimate", out / "trajectory.tum", "--json", out / "errors.json")
    summary, errors = json.loads((out / "summary.json").read_text()), json.loads((out / "errors.json").read_text())
    end = errors["end"]
    statuses = summary["swf_vo"]["status_counts"]
    last = (out / "stats.csv").read_text().splitlines()
    status = last[-1].split(",")[last[0].split(",").index("status")]
    row = [arguments.world, str(len(faults)), f"{errors['length_truth_m']:.0f}", status, str(sum(n for s, n in statuses.items() if s != "OK")),
           f"{end['error_m']:.3f}", f"{end['nees']:.1f}", f"{errors['nees_mean']:.1f}"]
    notes = [f"{arguments.duration} s, seed {arguments.seed}, a fault every {EVERY} s.",
             *costs(faults, *poses_of(out / "trajectory.tum"), Truth(bag.with_suffix(".truth") / "trajectory.tum"))]
    show(COLUMNS, [row], notes, measured, arguments.output)
    sys.exit(0 if status == "OK" and end["nees"] < WORST else 1)


if __name__ == "__main__":
    main()
