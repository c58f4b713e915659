# SPDX-License-Identifier: BSD-3-Clause
"""Features, tracks and residuals of visual odometry in the simulated worlds, compared with real sequences and Tables 2 and 3 of the paper.

    python3 tracks.py WORLDS [REAL...] [-o tracks.json]

WORLDS: folder with what bars.py or worlds.py simulated; REAL: KITTI folders.
"""
import argparse
import csv
from pathlib import Path

import numpy as np

from support import WORLDS, commit, mapped, show, simulated

SEED, LENGTH = 7, 20  # s
PAPER = {"frames a second": "20", "velocity (m/s)": "0.56 ... 0.94", "way between frames (m)": "0.03 ... 0.05",
         "features per frame": "91 ... 95 (37 ... 146)", "feature track length (frames)": "11.6 ... 27.8 (2 ... 1363)",
         "reprojection error (px)": "0.10 ... 0.17 (0.003 ... 1.01)"}


def spread(values, form):
    return f"{np.mean(values):{form}} ({np.min(values):{form}} ... {np.max(values):{form}})"


def column(folder, out):
    """Returns a cell for each row of the table."""
    summary = mapped(folder, out)
    with open(out / "stats.csv", newline="") as file:
        frames = [row for row in csv.DictReader(file) if row["accepted"] == "1"]
    stamps = 1e-9 * np.array([int(row["stamp_ns"]) for row in frames])
    places = np.loadtxt(folder / "poses.txt").reshape(-1, 3, 4)[:, :, 3]
    step = np.linalg.norm(np.diff(places, axis=0), axis=1).mean()
    rate = (len(stamps) - 1) / (stamps[-1] - stamps[0])

    def of(name):
        return np.array([float(row[name]) for row in frames[1:]])
    born = float(frames[0]["features"]) + (of("features") - of("tracked")).sum()
    length = (float(frames[0]["features"]) + of("features").sum()) / born
    return {"frames a second": f"{rate:.0f}", "velocity (m/s)": f"{step * rate:.2f}", "way between frames (m)": f"{step:.2f}",
            "features per frame": spread(of("features"), ".0f"),
            "... of them seen before": spread(of("tracked"), ".0f"),
            "feature track length (frames)": f"{length:.1f}",
            "... of those in view, so far": spread(of("track_length_mean"), ".1f"),
            "reprojection error (px)": spread(of("reprojection_px"), ".3f"),
            "frames not OK": str(sum(n for status, n in summary["swf_vo"]["status_counts"].items() if status != "OK"))}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("worlds", type=Path)
    parser.add_argument("real", type=Path, nargs="*")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    before = commit()
    folders = [simulated(arguments.worlds / f"{world}{SEED}", world, SEED, LENGTH) for world in WORLDS] + arguments.real
    columns = [column(folder, arguments.worlds / f"tracks_{folder.name}") for folder in folders]
    rows = [[name, PAPER.get(name, ""), *(each[name] for each in columns)] for name in columns[0]]
    notes = ["Mean (least ... most) over frames; for the paper means of four sessions (least ... most of all). Track length: features of all frames "
             "over tracks begun."]
    show(("", "paper, Tables 2 and 3", *WORLDS, *(folder.name for folder in arguments.real)), rows, notes, before, arguments.output)


if __name__ == "__main__":
    main()
