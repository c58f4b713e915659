# SPDX-License-Identifier: BSD-3-Clause
"""Compares the results of five commands for images of a real drive at other grey depths with those at 8 bits.

  grey_depths.py FOLDER [-o FILE.json] [--work DIR]

FOLDER: of KITTI, 8 bits, with calib.txt and times.txt.
"""
import json
import shutil
import sys
from pathlib import Path

import cv2
import numpy as np

from support import commit, session_parser, show, urban_nav, work_folder


def hot(grey):
    deep = 16 * grey
    deep[7, 11] = 65535
    return deep


FRAMES = 40
DEPTHS = {  # from 8 bits
    "10 bits": lambda grey: 4 * grey, "12 bits": lambda grey: 16 * grey, "14 bits": lambda grey: 64 * grey, "16 bits": lambda grey: 257 * grey,
    "12 bits, highest first": lambda grey: 256 * grey, "12 bits, a hot pixel": hot, "thermal, 7000 to 7510": lambda grey: 7000 + 2 * grey,
}


def deepened(source, folder, depth):
    """Writes the drive at another depth."""
    shutil.rmtree(folder, ignore_errors=True)
    for camera in ("image_0", "image_1"):
        (folder / camera).mkdir(parents=True)
        for path in sorted((source / camera).glob("*.png"))[:FRAMES]:
            grey = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
            cv2.imwrite(str(folder / camera / path.name), depth(grey.astype(np.uint16)) if depth else grey)
    shutil.copy(source / "calib.txt", folder)
    (folder / "times.txt").write_text("".join((source / "times.txt").read_text().splitlines(True)[:FRAMES]))
    return folder


def path_length(source, out):
    shutil.rmtree(out, ignore_errors=True)
    urban_nav("map", source, "--stages", "vo", "--out", out)
    places = np.loadtxt(out / "trajectory.tum")[:, 1:4]
    return float(np.linalg.norm(np.diff(places, axis=0), axis=1).sum())


def rectification(folder, out):
    """Returns findings of `doctor` and its number of complete pairs."""
    urban_nav("doctor", folder, "--json", out)
    read = json.loads(out.read_text())
    return len(read["findings"]), sum(each["complete"] for each in read["sessions"])


def results(folder, work):
    """Returns the results of the five commands for a drive: (name, number or array)."""
    first = sorted((folder / "image_0").glob("*.png"))[0].name
    urban_nav("disparity", folder / "image_0" / first, folder / "image_1" / first, "--calibration", folder / "calib.txt", "-o", work / "disparity.pfm")
    disparity = cv2.imread(str(work / "disparity.pfm"), cv2.IMREAD_UNCHANGED)
    urban_nav("places", "query", "default", folder / "image_0", "--mask", "0.5", "-o", work / "closures.csv")
    rows = [line.split(",") for line in (work / "closures.csv").read_text().splitlines()[1:]]
    urban_nav("convert", "kitti", folder, "-o", work / "drive.bag")
    return {"map": path_length(folder, work / "out"), "convert, map": path_length(work / "drive.bag", work / "out"), "disparity": disparity,
            "places query": [row[1] for row in rows], "doctor": rectification(folder, work / "doctor.json")}


def deviation(result, sound):
    """Returns the relative difference, the largest over the parts of a result."""
    if isinstance(result, np.ndarray):
        both = np.isfinite(result) & np.isfinite(sound)
        return max(abs(np.isfinite(result).mean() / np.isfinite(sound).mean() - 1), float(np.median(np.abs(result - sound)[both]) / np.mean(sound[both])))
    if isinstance(result, list):
        return 1 - sum(a == b for a, b in zip(result, sound)) / max(len(result), len(sound), 1)
    if isinstance(result, tuple):
        return max(abs(result[0] - sound[0]), abs(result[1] / sound[1] - 1))
    return abs(result / sound - 1)


def main():
    parser = session_parser(__doc__)
    arguments = parser.parse_args()
    measured, work = commit(), work_folder(arguments)
    sound = results(deepened(arguments.bag, work / "drive", None), work)
    rows, most = [], 0.0
    for name, depth in DEPTHS.items():
        other = results(deepened(arguments.bag, work / "drive", depth), work)
        differences = [deviation(other[command], sound[command]) for command in sound]
        most = max(most, *differences)
        rows.append([name, *(f"{100 * each:.2f}" for each in differences)])
        print("  ".join(rows[-1]), file=sys.stderr)
    notes = [f"Largest difference from 8 bits: {100 * most:.2f} %. `map`: length of the path; `disparity`: share of pixels with a disparity, and median difference by the mean; `places "
             "query`: images with another likeliest place; `doctor`: findings and complete pairs."]
    show(("depth of grey", *(f"{command}, %" for command in sound)), rows, notes, measured, arguments.output)


if __name__ == "__main__":
    main()
