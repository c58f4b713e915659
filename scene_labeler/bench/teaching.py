#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Retrains a model of two simulated worlds with 20 corrected superpixels of the third, drawn from the wrong returns of two of its drives, and
evaluates both models on its other drives: prints the table of README.md.

    teaching.py FOLDER     # for the bags and models; existing ones are reused
"""
import csv
import random
import sys
import tempfile
from pathlib import Path

import simulated

CLICKS = 20
NEIGHBOURS = 3  # beams from a clicked return to adjacent ones that must be wrong as well
TEACHING_DRIVES = 2  # of each world; the others are for evaluation


def wrong_returns(model, bag, names):
    """Returns bag, side, stamp, beam and true class of wrong returns between wrong ones of the same class, which a person would notice."""
    seen = []
    with tempfile.TemporaryDirectory() as out:
        simulated.urban_nav("labels", "apply", model, *simulated.with_poses([bag]), "-o", out)
        for side in ("left", "right"):
            with open(simulated.truth(bag) / f"laser_{side}.csv") as file:
                true = {(row["stamp_ns"], row["beam"]): row["class"] for row in csv.DictReader(file) if row["class"]}
            with open(Path(out) / f"laser_{side}_labels.csv") as file:
                wrong = {(row["stamp_ns"], int(row["beam"])): true[row["stamp_ns"], row["beam"]] for row in csv.DictReader(file)
                         if row["label"] != true.get((row["stamp_ns"], row["beam"]), row["label"])}
            for (stamp, beam), label in wrong.items():
                if all(wrong.get((stamp, beam + step)) == label for step in (-NEIGHBOURS, -1, 1, NEIGHBOURS)):
                    seen.append((bag, side, stamp, beam, names[int(label)]))
    return seen


def taught(folder, world, model, bags, names):
    """Returns the model retrained with the corrections."""
    wrong = [one for bag in bags for one in wrong_returns(model, bag, names)]
    clicks = Path(folder) / f"clicks_{world}.csv"
    with open(clicks, "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["bag", "side", "stamp_ns", "beam", "class", "trajectory"])
        for bag, *one in random.Random(1).sample(wrong, CLICKS):
            rows.writerow([bag.resolve(), *one, (simulated.truth(bag) / "trajectory.tum").resolve()])
    out = Path(folder) / f"taught_{world}.labels"
    simulated.urban_nav("labels", "train", "--add", model, "--corrections", clicks, "-o", out)
    return out


def main():
    folder = sys.argv[1]
    print("| taught | mean F1 before, % | after, % | by class |\n|---|---|---|---|")
    for world in simulated.WORLDS:
        bags, model = simulated.training_drives(folder, world), simulated.model_without(folder, world)
        tried = bags[TEACHING_DRIVES:]
        before = simulated.evaluated(model, tried)
        names, scored = before["confusion"]["names"], simulated.scored_classes(before)
        after = simulated.evaluated(taught(folder, world, model, bags[:TEACHING_DRIVES], names), tried)
        f1 = {name: [simulated.f1_of(one["confusion"]["rows"], names.index(name)) for one in (before, after)] for name in scored}
        means = [sum(pair[i] for pair in f1.values()) / len(f1) for i in (0, 1)]
        print(f"| {world} | {means[0]:.0f} | {means[1]:.0f} | " + ", ".join(f"{name} {a:.0f} to {b:.0f}" for name, (a, b) in f1.items()) + " |", flush=True)


if __name__ == "__main__":
    main()
