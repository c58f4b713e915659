# SPDX-License-Identifier: BSD-3-Clause
"""Localisation from random starts on another day in a fixed map by `urban_nav map --localise`.

The first day of a simulated world is mapped; random segments of the second one, each its own recording, are localised in the map of the first.
Reported: the number that are KNOWN and correct (within 1 m) within 10 s of driving, errors above 1 m while KNOWN, and the accuracy. Starts outside the area of the
first day (more than 3 m from its path within the 10 s) are counted separately, since the map need not contain them. The map is aligned to the truth by one rigid
transform of the whole first day; the truth is used for nothing else. A stranger drives in another world, where every KNOWN is wrong.
"""
import argparse
import csv
import json
from pathlib import Path

import numpy as np
import rosbag

from support import SENSORS, commit, driven, show, urban_nav

COLUMNS = ("world, seed", "visitor", "starts in the map", "known and right within 10 s", "median time to KNOWN, s", "starts that leave it", "KNOWN", "of all, KNOWN and wrong", "KNOWN frames", "error, median, m", "95 %", "largest",
           "NEES of position (3 is right)", "sightings: views", "clouds")
SECONDS = 15.0  # of a segment: 10 s of driving and the window of odometry
RIGHT_S = 10.0
RIGHT_M = 1.0
IN_MAP_M = 3.0


def trajectory(path):
    rows = [line.split() for line in Path(path).read_text().splitlines() if not line.startswith("#")]
    whole = [row[0].partition(".") for row in rows]
    stamps = np.array([int(seconds) * 10**9 + int((rest + "0" * 9)[:9]) for seconds, _, rest in whole])
    return stamps, np.array([[float(value) for value in row[1:4]] for row in rows])


def places_at(track, stamps):
    return np.stack([np.interp(np.asarray(stamps, float) - track[0][0], (track[0] - track[0][0]).astype(float), track[1][:, i]) for i in range(3)], axis=1)


def onto(points, places):
    """Returns the rigid transform of the best alignment of `points` to `places` (Umeyama 1991)."""
    a, b = points.mean(axis=0), places.mean(axis=0)
    u, _, vt = np.linalg.svd((places - b).T @ (points - a))
    turn = u @ np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))]) @ vt
    return turn, b - turn @ a


def cut(bag, begin, seconds, path):
    with rosbag.Bag(str(bag)) as source, rosbag.Bag(str(path), "w") as piece:
        start = source.get_start_time() + begin
        for topic, message, stamp in source.read_messages(topics=["/tf_static"], raw=True):
            piece.write(topic, message, type(stamp).from_sec(start), raw=True)
        topics = [topic for topic in source.get_type_and_topic_info().topics if topic.startswith(("/stereo", "/imu", "/laser", "/points"))]
        for topic, message, stamp in source.read_messages(topics=topics, start_time=type(stamp).from_sec(start), end_time=type(stamp).from_sec(start + seconds), raw=True):
            piece.write(topic, message, stamp, raw=True)


def start(bag, begin, map_folder, motion, truth, folder):
    """Returns for one segment the time to KNOWN (s, None: never), errors (m) and squared normalised errors of KNOWN frames, and the summary."""
    piece, out = folder / "piece.bag", folder / "piece"
    cut(bag, begin, SECONDS, piece)
    urban_nav("map", piece, "--localise", map_folder / "session.db", "--overwrite", "--out", out)
    turn, shift = motion
    errors, squares, first, begun = [], [], None, None
    with (out / "localisation.csv").open() as file:
        for row in csv.DictReader(file):
            stamp = int(row["stamp_ns"])
            begun = stamp if begun is None else begun
            if row["knowledge"] != "KNOWN":
                continue
            first = (stamp - begun) * 1e-9 if first is None else first
            place = turn @ np.array([float(row[axis]) for axis in "xyz"]) + shift
            d = place - places_at(truth, [stamp])[0]
            covariance = turn @ np.array([[float(row[f"c{i}{j}"]) for j in range(3)] for i in range(3)]) @ turn.T
            errors.append(np.linalg.norm(d))
            squares.append(d @ np.linalg.solve(covariance, d))
    piece.unlink()
    return first, errors, squares, json.loads((out / "summary.json").read_text())["localisation"]


def stays_near(truth, begin, places):
    """Returns whether the drive remains in the mapped area for the evaluated time."""
    stamps = truth[0][0] + (begin + np.arange(0.0, RIGHT_S, 0.5)) * 1e9
    return all(np.linalg.norm(places - place, axis=1).min() <= IN_MAP_M for place in places_at(truth, stamps))


def error_columns(errors, squares):
    return [*(f"{value:.3f}" for value in (np.median(errors), np.quantile(errors, 0.95), errors.max())), f"{squares.mean():.2f}"]


def row_of(case, arguments):
    own, _, strange = case.partition("@")
    sensors = ("lidar3d", "--lidar", arguments.lidar) if arguments.lidar else (SENSORS,)
    bags = driven(arguments.folder, own, *sensors)
    bags[1:] = driven(arguments.folder, strange, *sensors) if strange else bags[1:]
    out = arguments.folder / f"{bags[0].stem}_frozen"
    if not (out / "summary.json").exists():
        urban_nav("map", bags[0], "--stages", "lo,loops,graph" if arguments.lidar else "vo,places,loops,graph",
                  "--closures", bags[0].with_suffix(".truth") / "closures_true.csv", "--out", out)
    mapped, truths = trajectory(out / "trajectory.tum"), [trajectory(bag.with_suffix(".truth") / "trajectory.tum") for bag in bags]
    motion = onto(mapped[1], places_at(truths[0], mapped[0]))
    dice = np.random.default_rng(arguments.seed)
    length = (truths[1][0][-1] - truths[1][0][0]) * 1e-9 - SECONDS - 1.0
    driven_first = places_at(truths[0], mapped[0])
    inside, outside = [], []
    counted = outside if strange else inside
    while len(counted) < arguments.starts and len(outside) < 10 * arguments.starts:
        begin = dice.uniform(0.0, length)
        made = start(bags[1], begin, out, motion, truths[1], arguments.folder)
        (inside if not strange and stays_near(truths[1], begin, driven_first) else outside).append(made)
    made = inside + outside
    errors = np.array([error for _, each, _, _ in made for error in each])
    squares = np.array([square for _, _, each, _ in made for square in each])
    times = [first for first, *_ in inside if first is not None]
    right = sum(first is not None and first <= RIGHT_S and max(each) <= RIGHT_M for first, each, *_ in inside)
    wrong = sum(bool(each) and (bool(strange) or max(each) > RIGHT_M) for _, each, *_ in made)
    said = [summary for *_, summary in made]
    world, seed, *days = own.split(":")
    visitor = "{} {}".format(*strange.split(":")) if strange else days[1].partition("/")[2] or "the same way"
    return [f"{world} {seed}", visitor, str(len(inside)), str(right), f"{np.median(times):.1f}" if times else "", str(len(outside)), str(sum(first is not None for first, *_ in outside)), str(wrong),
            str(len(errors)), *(error_columns(errors, squares) if len(errors) and not strange else [""] * 4),
            *(f"{sum(each[done] for each in said)} of {sum(each[looks] for each in said)}" for done, looks in (("sightings", "looks"), ("cloud_sightings", "cloud_looks")))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of simulated sessions and maps; existing ones are used")
    parser.add_argument("--case", action="append", help="WORLD:SEED:SECONDS[/ROUTE]:SECONDS[/ROUTE], or WORLD:SEED:SECONDS@WORLD:SEED:SECONDS with a stranger, repeatable (default quad:7:300:300)")
    parser.add_argument("--lidar", help="rings of a 3D LiDAR as the only sensor (default: stereo camera, lasers, IMU and wheels); use a folder of its own")
    parser.add_argument("--starts", type=int, default=50, help="number of starts within the map (default 50)")
    parser.add_argument("--seed", type=int, default=1, help="seed of the starts")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    measured = commit()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    rows = [row_of(case, arguments) for case in arguments.case or ["quad:7:300:300"]]
    show(COLUMNS, rows, ["Another day of the same world, by keyframes, or by clouds where these do not match; reversed: in the opposite direction. Starts that leave the map drive further than 3 m from its paths; those of a stranger, in another world, all do. The map of the first day is aligned to its truth by one rigid motion."], measured, arguments.output)


if __name__ == "__main__":
    main()
