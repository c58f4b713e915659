# SPDX-License-Identifier: BSD-3-Clause
"""A long ride on which something goes wrong all the time: does visual odometry end where it says it does?

Every 20 s another fault of the stereo camera, by chance: which, how long, and the seed are printed. The last pose is compared with the truth, and with its
own covariance: with six degrees of freedom a right one leaves a normalised squared error above 16.8 once in a hundred times.
"""
import argparse
import json
import random
import sys
from pathlib import Path

from support import commit, show, urban_nav

EVERY = 20  # s
WORST = 16.81  # chi-square, 6 degrees of freedom, 99 %
COLUMNS = ("world", "faults", "length, m", "status at the end", "frames not OK", "position off at the end, m", "NEES at the end", "mean NEES")


def some_fault(chance, start):
    """The fault that begins within the 20 s from `start`; over before the next."""
    kind = chance.choice(("drop", "freeze", "swap", "corrupt", "unplug", "nan"))
    begin, duration = start + chance.uniform(2.0, 10.0), chance.uniform(0.2, 3.0)
    share = f":{chance.uniform(0.1, 0.5):.2f}" if kind in ("drop", "corrupt") else ""
    return f"{kind}:stereo:{begin:.2f}:{duration:.2f}{share}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="for what is simulated and mapped")
    parser.add_argument("--world", default="quad")
    parser.add_argument("--route", default="loops")
    parser.add_argument("--seed", type=int, default=1, help="of the world and of the faults")
    parser.add_argument("--duration", type=int, default=600, help="s (default 600)")
    parser.add_argument("-o", "--output", type=Path, help="the table, for a README")
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
    # The end alone: the last pose and its covariance, beside the whole truth.
    urban_nav("evaluate", "--truth", bag.with_suffix(".truth") / "trajectory.tum", "--estimate", out / "trajectory.tum", "--json", out / "errors.json")
    summary, errors = json.loads((out / "summary.json").read_text()), json.loads((out / "errors.json").read_text())
    end = errors["end"]
    statuses = summary["swf_vo"]["status_counts"]
    last = (out / "stats.csv").read_text().splitlines()
    status = last[-1].split(",")[last[0].split(",").index("status")]
    row = [arguments.world, str(len(faults)), f"{errors['length_truth_m']:.0f}", status, str(sum(n for s, n in statuses.items() if s != "OK")),
           f"{end['error_m']:.3f}", f"{end['nees']:.1f}", f"{errors['nees_mean']:.1f}"]
    show(COLUMNS, [row], [f"{arguments.duration} s, seed {arguments.seed}, a fault every {EVERY} s: {', '.join(faults)}."], measured, arguments.output)
    sys.exit(0 if status == "OK" and end["nees"] < WORST else 1)


if __name__ == "__main__":
    main()
