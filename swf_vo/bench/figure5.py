#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Trajectories from above, as in Fig. 5 of the paper:
python3 figure5.py OUT_FOLDER_OF_MAP[=TRUTH.txt[=NAME]]... -o PICTURE.png

TRUTH is a KITTI file of left camera poses; needs python3-matplotlib.
"""
import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def kitti(path):
    """Returns coordinates ahead and to the left of the first camera, m."""
    rows = [[float(word) for word in line.split()] for line in Path(path).read_text().splitlines() if line.strip()]
    return [row[11] for row in rows], [-row[3] for row in rows]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+")
    parser.add_argument("-o", "--output", required=True)
    arguments = parser.parse_args()
    figure, axes = plt.subplots(1, len(arguments.runs), figsize=(4.2 * len(arguments.runs), 3.8), squeeze=False)
    for axis, run in zip(axes[0], arguments.runs):
        folder, truth, name = (run.split("=") + ["", ""])[:3]
        ahead, left = kitti(Path(folder) / "trajectory.kitti")
        if truth:
            axis.plot(*kitti(truth), color="#d9480f", linewidth=2.6, alpha=0.55, label="truth")
        axis.plot(ahead, left, color="#1f4e9e", linewidth=1.2, label="swf_vo")
        axis.plot(ahead[:1], left[:1], "o", color="#1f4e9e", markersize=4)
        axis.set_title(name or Path(folder).name, fontsize=10)
        axis.set_xlabel("forward at the start (m)", fontsize=8)
        axis.set_ylabel("left (m)", fontsize=8)
        axis.set_aspect("equal", "datalim")
        axis.tick_params(labelsize=8)
        axis.grid(color="#e6e6e6", linewidth=0.6)
        axis.legend(fontsize=8, frameon=False)
    figure.tight_layout()
    figure.savefig(arguments.output, dpi=110)


if __name__ == "__main__":
    main()
