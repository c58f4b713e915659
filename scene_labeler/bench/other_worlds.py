#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Trains on the drives of two simulated worlds and evaluates on the third, for each of the three: prints the table of README.md.

    other_worlds.py FOLDER     # for the bags and models; existing ones are reused
"""
import sys

import simulated


def main():
    folder = sys.argv[1]
    print("| tried on | frames of a new place, % | mean F1, % | F1 by class, % | not unsure, % | of these right, % | wrong and not unsure, % of all |\n|---|---|---|---|---|---|---|")
    for world in simulated.WORLDS:
        result = simulated.evaluated(simulated.model_without(folder, world), simulated.training_drives(folder, world))
        names, rows, sure = result["confusion"]["names"], result["confusion"]["rows"], result["sure_confusion"]["rows"]
        known = {name for k, name in enumerate(names) if sum(row[k] for row in rows)}
        scored = simulated.scored_classes(result)
        f1 = {name: simulated.f1_of(rows, names.index(name)) for name in scored}
        known_rows = [k for k in range(len(rows)) if names[k] in known]
        returns, sure_returns = sum(sum(rows[k]) for k in known_rows), sum(sum(sure[k]) for k in known_rows)
        right = sum(sure[k][k] for k in known_rows)
        fresh = result["new_place_frames"] / result["frames"]
        print(f"| {world} | {100 * fresh:.0f} | {sum(f1.values()) / len(f1):.0f} | " + ", ".join(f"{name} {value:.0f}" for name, value in f1.items())
              + f" | {100 * sure_returns / returns:.0f} | {100 * right / max(1, sure_returns):.0f} | {100 * (sure_returns - right) / returns:.0f} |", flush=True)


if __name__ == "__main__":
    main()
