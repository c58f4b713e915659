#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Delays and mounting errors estimated by `urban_nav map --calibrate` in simulated sessions with known errors: along odometry's own trajectory, with
only the stated calibration known.

lasers        the left one late by 30 ms, the right one turned by 1, -0.5 and 0.3 deg about its axes: route `return` of `quad`
nothing       the same session without errors: no correction may be adopted
panoramas     late by 20 ms, the head turned by -1, 0.5 and 1.5 deg
straight      a straight street: unobservable terms

Truth is the correction of the stated value. Sessions and maps are kept in the folder.
"""
import argparse
import json
from pathlib import Path

import numpy as np
from support import SENSORS, commit, show, simulated_bag, urban_nav

COLUMNS = ("session", "device", "term", "truth", "found", "error over sigma", "in the map")
LASERS_WRONG = ("--lag", "laser_left:0.03", "--misplace", "laser_right:1,-0.5,0.3")
HEAD_WRONG = ("--lag", "panorama:0.02", "--misplace", "ladybug:-1,0.5,1.5")


def correcting_turns(device, roll, pitch, yaw):
    """Returns the truth of a device rotated by these angles (deg) in /tf_static: the rotation vector of the inverse."""
    (sr, cr), (sp, cp), (sy, cy) = [(np.sin(a), np.cos(a)) for a in np.radians((roll, pitch, yaw)) / 2]
    x, y, z, w = sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy
    vector = -np.degrees(2 * np.arctan2(np.linalg.norm((x, y, z)), w)) * np.array((x, y, z)) / np.linalg.norm((x, y, z))
    return dict(zip(((device, f"turn_{axis}_deg") for axis in "xyz"), vector))


# name: world, seed, route, seconds, sensors, simulated errors, {(device, term): truth}
CASES = {
    "lasers": ("quad", 40, "return", 70, SENSORS, LASERS_WRONG,
               {("laser_left", "delay_ms"): 30, **correcting_turns("laser_right", 1, -.5, .3)}),
    "nothing": ("quad", 40, "return", 70, SENSORS, (), {}),
    "panoramas": ("quad", 41, "return", 12, f"{SENSORS},ladybug", HEAD_WRONG,
                  {("panorama", "delay_ms"): 20, **correcting_turns("panorama", -1, .5, 1.5)}),
    "straight": ("street", 41, "straight300", 40, SENSORS, (), {}),
}
TERMS = {"delay_ms": ("delay", "ms"), "turn_x_deg": ("turn about x", "deg"), "turn_y_deg": ("turn about y", "deg"), "turn_z_deg": ("turn about z", "deg")}


def term_row(session, device, key, term, truth):
    name, unit = TERMS[key]
    known = [session, device, name, f"{truth:.3g} {unit}"]
    if not term["observable"]:
        return [*known, "not observable", "-", "as stated"]
    off = abs(term["found"] - truth) / term["sigma"]
    return [*known, f"{term['found']:.3g} +- {term['sigma']:.2g} {unit}", f"{off:.1f}", f"{term['adopted']:.3g} {unit}" if term["adopted"] else "as stated"]


def rows(folder, name):
    world, seed, route, duration, sensors, wrong, truths = CASES[name]
    bag = simulated_bag(folder / f"{name}.bag", world, seed, duration, "--route", route, "--sensors", sensors, *wrong)
    out = folder / f"{name}_map"
    stages = "vo,graph,lasers"
    urban_nav("map", bag, "--out", out, "--overwrite", "--stages", stages, "--calibrate")
    found = json.loads((out / "summary.json").read_text())["laser_mapper"]["calibration"][0]
    session = f"{name}: {world}, {route}, {duration} s"
    shown = found["devices"] if name != "panoramas" else {device: terms for device, terms in found["devices"].items() if device == "panorama"}
    return [term_row(session, device, key, terms[key], truths.get((device, key), 0)) for device, terms in shown.items() for key in TERMS]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of simulated sessions and maps; existing sessions are used")
    parser.add_argument("--case", action="append", choices=CASES, help="repeatable (default: all)")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    before = commit()
    table = [row for name in arguments.case or CASES for row in rows(arguments.folder, name)]
    show(COLUMNS, table, ["Turns are those of a laser about the axes of its frame, those of the panoramic head about the robot's."], before, arguments.output)


if __name__ == "__main__":
    main()
