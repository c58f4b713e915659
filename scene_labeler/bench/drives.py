#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The default model on simulated drives whose seeds it was not made from, beside Table 5 of Newman et al. 2009: prints the table of README.md.

    drives.py FOLDER     # for the bags: those that are there are not simulated again
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

COMMAND = Path(__file__).resolve().parents[2] / "urban_nav"
DRIVES = (("quad", 7, "loops", 1), ("begbroke", 7, "loops", 1), ("street", 7, "loops", 3))  # world, seed, route, day
PAPER = {"grass": 97.3, "paved": 93.1, "dirt_path": 60.0, "textured_wall": 77.8, "smooth_wall": 60.4, "foliage": 61.7, "vehicle": 56.5}


def evaluate(folder, world, seed, route, day):
    bag = folder / f"{world}_{seed}_{day}.bag"
    if not bag.exists():
        subprocess.run([COMMAND, "simulate", "--world", world, "--seed", str(seed), "--route", route, "--duration", "30", "--day", str(day),
                        "--sensors", "ladybug,lasers", "--views", "lasers", "-o", bag], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        subprocess.run([COMMAND, "labels", "evaluate", "default", bag, "--trajectory", bag.with_suffix(".truth") / "trajectory.tum", "--threads", "1",
                        "--json", out.name], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return json.loads(Path(out.name).read_text())


def f1(rows, k):
    hits, stated, true = rows[k][k], sum(row[k] for row in rows), sum(rows[k])
    return 200 * hits / max(1, stated + true)


def main():
    folder = Path(sys.argv[1])
    results = [evaluate(folder, *drive) for drive in DRIVES]
    names = results[0]["confusion"]["names"]
    total = [[sum(r["confusion"]["rows"][i][k] for r in results) for k in range(len(names))] for i in range(len(names) - 1)]
    print("| class | returns | F1, % | Table 5, % | " + " | ".join(f"{world}, day {day}" for world, _, _, day in DRIVES) + " |")
    print("|---|" + "---|" * (3 + len(DRIVES)))
    for name, paper in PAPER.items():
        k = names.index(name)
        parts = [f"{f1(r['confusion']['rows'], k):.1f}" if sum(r["confusion"]["rows"][k]) >= 500 else "" for r in results]
        print(f"| {name} | {sum(total[k])} | {f1(total, k):.1f} | {paper} | " + " | ".join(parts) + " |")
    print("| accuracy | | | | " + " | ".join(f"{100 * r['accuracy']:.1f}" for r in results) + " |")
    print("| calibration error | | | | " + " | ".join(f"{100 * r['calibration_error']:.1f}" for r in results) + " |")


if __name__ == "__main__":
    main()
