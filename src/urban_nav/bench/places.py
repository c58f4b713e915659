# SPDX-License-Identifier: BSD-3-Clause
"""What the default model of places claims between days and among strangers, in simulated worlds that it was neither trained nor calibrated with.

A site is driven on two days: the second one is looked for in the first, panoramas alone. Strangers drive through other sites of the same world, one after the other: each is looked for in all
before it, and every match is wrong. A match within 7.5 m is right, beyond 10 m wrong. Matches within one drive do not count.
"""
import argparse
import csv
from pathlib import Path

import numpy as np

from localisation import places_at, trajectory
from support import commit, show, simulated_bag, urban_nav

COLUMNS = ("world", "drives", "evidence", "compared", "revisits", "right place first", "recall at 100 % precision", "above 0.99", "right", "0.9 to 0.99", "right", "0.05 to 0.9", "right")
CASES = ("quad:930001:40", "street:930002:40", "begbroke:930003:30")
STRANGERS = ("quad:930001:40,930004:20,930007:20", "street:930002:40,930005:20,930008:20", "begbroke:930003:30,930006:20,930009:20")
EVIDENCE = {"words alone": ("--second-look", "off", "--sequence", "off"), "+ sequence": ("--second-look", "off"), "+ second look": ()}  # the last one is how it is by default
SAME_M, ELSEWHERE_M, REVISIT_M = 7.5, 10.0, 2.0


def matches(model, bags, csv_path, options):
    """Matches with another drive: (drive, stamp) of the earlier place and of the query, and the probability."""
    urban_nav("places", "query", model, *bags, *options, "-o", csv_path)
    drives = {bag.stem: k for k, bag in enumerate(bags)}
    with csv_path.open() as file:
        rows = [(drives[r["session_a"]], int(r["stamp_a_ns"]), drives[r["session_b"]], int(r["stamp_b_ns"]), float(r["probability"])) for r in csv.DictReader(file)]
    return [row for row in rows if row[0] != row[2]]


def drive(folder, world, seed, duration, day=1):
    return simulated_bag(folder / f"{world}_{seed}_{day}.bag", world, seed, duration, "--day", day, "--sensors", "ladybug")


def judged(rows, bags, one_site):
    """Of each match whether it is right (None: neither), and whether its query is at a place of the map."""
    truths = [trajectory(bag.with_suffix(".truth") / "trajectory.tum") for bag in bags]
    off = [np.linalg.norm(places_at(truths[a], [stamp_a]) - places_at(truths[b], [stamp_b])) if one_site else np.inf for a, stamp_a, b, stamp_b, _ in rows]
    right = [True if d <= SAME_M else False if d > ELSEWHERE_M else None for d in off]
    revisit = [one_site and np.linalg.norm(truths[a][1] - places_at(truths[b], [stamp_b]), axis=1).min() <= REVISIT_M for a, _, b, stamp_b, _ in rows]
    return np.array([row[4] for row in rows]), right, np.array(revisit, bool)


def summary(name, p, right, revisit):
    wrong_most = max((value for value, good in zip(p, right) if good is False), default=-1.0)
    is_right = np.array([good is True for good in right])
    counts = []
    for low, high in ((0.99, 1.0), (0.9, 0.99), (0.05, 0.9)):
        claims = [good for value, good in zip(p, right) if low < value <= high and good is not None]
        counts += [str(len(claims)), str(sum(claims))]
    at_place = f"{(is_right & revisit & (p > wrong_most)).sum() / revisit.sum():.0%}" if revisit.any() else ""
    return [*name, str(len(p)), str(revisit.sum()), str((is_right & revisit).sum()), at_place, *counts]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="for what is simulated; bags that are there already are taken")
    parser.add_argument("--model", default="default")
    parser.add_argument("-o", "--output", type=Path, help="the table, for a README")
    arguments = parser.parse_args()
    measured = commit()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    rows, pooled = [], []

    def add(name, bags, one_site):
        for evidence, options in EVIDENCE.items():
            found = judged(matches(arguments.model, bags, arguments.folder / "matches.csv", options), bags, one_site)
            rows.append(summary((*name, evidence), *found))
        pooled.append(found)

    for case in CASES:
        world, seed, duration = case.split(":")
        add((world, "two days"), [drive(arguments.folder, world, seed, duration, day) for day in (1, 2)], True)
    for case in STRANGERS:
        world, drives = case.split(":", 1)
        bags = [drive(arguments.folder, world, *each.split(":")) for each in drives.split(",")]
        add((world, "strangers"), bags, False)
    p, right, revisit = (sum((list(each[k]) for each in pooled), []) for k in range(3))
    rows.append(summary(("all", "", "+ second look"), np.array(p), right, np.array(revisit, bool)))
    show(COLUMNS, rows, ["Panoramas. Right within 7.5 m, wrong beyond 10 m, between not counted; of strangers every match is wrong. Mask and parameters as they are by default."], measured, arguments.output)


if __name__ == "__main__":
    main()
