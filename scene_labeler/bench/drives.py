#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Evaluates the default model on simulated drives with other seeds than its training data: prints the tables of README.md, with Table 5 of
Newman et al. 2009.

    drives.py FOLDER     # for the bags; existing ones are reused
"""
import sys

import simulated

# World, seed, route, day, seconds. Days 3 (wet) and 4 (winter) visit the places of day 1.
DRIVES = (("quad", 7, "loops", 1, 60), ("quad", 7, "loops", 3, 60), ("quad", 8, "gardens", 2, 60), ("begbroke", 7, "loops", 1, 60),
          ("begbroke", 7, "loops", 4, 60), ("street", 7, "loops", 1, 60), ("street", 8, "reversed", 2, 60))
PAPER = {"grass": 97.3, "paved": 93.1, "dirt_path": 60.0, "textured_wall": 77.8, "smooth_wall": 60.4, "foliage": 61.7, "vehicle": 56.5}


def main():
    results = [simulated.evaluated("default", [simulated.simulated(sys.argv[1], *drive)]) for drive in DRIVES]
    names = results[0]["confusion"]["names"]
    total = [[sum(r["confusion"]["rows"][i][k] for r in results) for k in range(len(names))] for i in range(len(names) - 1)]
    print("| class | returns | F1, % | Table 5, % | " + " | ".join(f"{world} {seed}, day {day}" for world, seed, _, day, _ in DRIVES) + " |")
    print("|---|" + "---|" * (3 + len(DRIVES)))
    scored = [simulated.scored_classes(r) for r in results]
    for name, paper in PAPER.items():
        k = names.index(name)
        parts = [f"{simulated.f1_of(r['confusion']['rows'], k):.1f}" if name in scored[i] else "" for i, r in enumerate(results)]
        print(f"| {name} | {sum(total[k])} | {simulated.f1_of(total, k):.1f} | {paper} | " + " | ".join(parts) + " |")
    means = [sum(simulated.f1_of(r["confusion"]["rows"], names.index(name)) for name in scored[i]) / len(scored[i]) for i, r in enumerate(results)]
    print("| mean F1 | | | | " + " | ".join(f"{mean:.1f}" for mean in means) + " |")
    for title, key in (("accuracy", "accuracy"), ("calibration error", "calibration_error"), ("unsure", "unsure_share")):
        print(f"| {title} | | | | " + " | ".join(f"{100 * r[key]:.1f}" for r in results) + " |")
    print("\n| stated probability | returns | right, % |\n|---|---|---|")
    for i in range(10):
        bins = [r["reliability"][i] for r in results]
        count = sum(b["points"] for b in bins)
        if count:
            print(f"| {100 * sum(b['stated'] * b['points'] for b in bins) / count:.0f} | {count} | {100 * sum(b['right'] * b['points'] for b in bins) / count:.0f} |")


if __name__ == "__main__":
    main()
