#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the default model with true poses and with visual odometry, on simulated stereo drives of 20 s: prints the figures of README.md.

    odometry.py FOLDER     # for the bags; existing ones are reused
"""
import json
import sys
import tempfile
from pathlib import Path

import simulated


def mean_f1(bag, *words):
    """Returns the mean F1 of the default model on a bag, %."""
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        simulated.urban_nav("labels", "evaluate", "default", bag, *words, "--json", out.name)
        result = json.loads(Path(out.name).read_text())
    names, rows = result["confusion"]["names"], result["confusion"]["rows"]
    scored = simulated.scored_classes(result)
    return sum(simulated.f1_of(rows, names.index(name)) for name in scored) / len(scored)


def main():
    print("| mean F1, % | " + " | ".join(simulated.WORLDS) + " |\n|---|" + "---|" * len(simulated.WORLDS))
    bags = [Path(sys.argv[1]) / f"stereo_{world}.bag" for world in simulated.WORLDS]
    for world, bag in zip(simulated.WORLDS, bags):
        if not bag.exists():
            simulated.urban_nav("simulate", "--world", world, "--seed", 7, "--route", "loops", "--day", 1, "--duration", 20, "--views", "lasers", "-o", bag)
    print("| true poses | " + " | ".join(f"{mean_f1(bag, '--trajectory', simulated.truth(bag) / 'trajectory.tum'):.0f}" for bag in bags) + " |")
    print("| visual odometry | " + " | ".join(f"{mean_f1(bag):.0f}" for bag in bags) + " |")


if __name__ == "__main__":
    main()
