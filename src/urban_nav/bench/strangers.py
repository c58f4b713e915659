# SPDX-License-Identifier: BSD-3-Clause
"""Different sites mapped together: tests for false closures between them by `urban_nav map`, which proposes closures by appearance.

Each case is WORLD:SEED:SECONDS, for each site one, driven with stereo and panoramas in the same light, but stamped a day apart. Every closure between two sites is false.
"""
import argparse
import csv
import json
from pathlib import Path

import rosbag

from support import commit, show, simulated_bag, urban_nav

COLUMNS = ("sites", "panoramas", "announced as KNOWN", "closures proposed between sites", "accepted by geometry and map", "sites in one map")
CASES = ("street:930002:15,street:930005:15", "begbroke:930003:15,begbroke:930006:15", "quad:930001:15,quad:930004:15")
SENSORS = "stereo,ladybug,imu,wheels"
DAY_S = 86400


def days_later(bag, days):
    """Writes a copy of a bag with stamps `days` later; an existing one is used. Simulated drives of one day overlap in time, unlike those of one robot."""
    copy = bag.with_name(f"{bag.stem}_{days}_days_later.bag")
    if days == 0 or copy.exists():
        return copy if days else bag
    with rosbag.Bag(str(bag)) as source, rosbag.Bag(str(copy), "w") as target:
        for topic, message, stamp in source.read_messages():
            if hasattr(message, "header"):
                message.header.stamp.secs += days * DAY_S
            target.write(topic, message, type(stamp)(stamp.secs + days * DAY_S, stamp.nsecs))
    return copy


def between_sites(path):
    """Returns the verdicts of closures between two sessions."""
    with path.open() as file:
        return [row["verdict"] for row in csv.DictReader(file) if row["session_a"] != row["session_b"]]


def row_of(folder, case):
    sites = [each.split(":") for each in case.split(",")]
    bags = [days_later(simulated_bag(folder / f"{world}_{seed}_{seconds}_stereo.bag", world, seed, seconds, "--sensors", SENSORS), k) for k, (world, seed, seconds) in enumerate(sites)]
    out = folder / ("_".join(bag.stem for bag in bags) + "_map")
    urban_nav("map", *bags, "--stages", "vo,places,loops,graph", "--overwrite", "--out", out)
    summary = json.loads((out / "summary.json").read_text())
    places, verdicts = summary["fabmap_node"], between_sites(out / "closures.csv")
    return [", ".join(f"{world} {seed}" for world, seed, _ in sites), str(places["panoramas"]), str(places["known"]), str(len(verdicts)), str(verdicts.count("accepted")),
            f"{summary['pose_graph']['sessions_joined']} of {len(bags)}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of simulated sessions and maps; existing bags are used")
    parser.add_argument("--case", action="append", help="repeatable (default: two sites of each world)")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    measured = commit()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    rows = [row_of(arguments.folder, case) for case in arguments.case or CASES]
    show(COLUMNS, rows, ["Default parameters; 15 s at each site."], measured, arguments.output)


if __name__ == "__main__":
    main()
