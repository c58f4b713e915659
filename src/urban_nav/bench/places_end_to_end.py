# SPDX-License-Identifier: BSD-3-Clause
"""From recordings to one map: `urban_nav map` recognises places and measures closures without given ones.

Each case is WORLD:SEED:SECONDS[/ROUTE] of the first day[:SECONDS[/ROUTE] of the second one]; a day without SECONDS is omitted. Ways to map it:
  found     as shipped, with stereo and panoramas: stages vo, places, loops, graph
  stereo    the same with only stereo images, IMU and wheels: places from the left images
  given     the closures of the truth are candidates (closures.py) instead of the stage places
  odometry  without closures: stages vo, graph

A stretch of 10 m of a drive is connected to a session if an accepted closure links them; counted are stretches linked by the truth. A revisited pose is near a
closure if an accepted one of the same session starts within 2 m of it. False: an accepted closure of places more than 10 m apart, or a transform more than 0.5 m off.
FOLDER/NAME/stretches.csv lists the proposed and accepted closures of each stretch.
"""
import argparse
import csv
import json
from collections import Counter, defaultdict
from pathlib import Path

import numpy as np
import rosbag

import closures
from end_to_end import both_truths, root_mean_square
from support import commit, driven, show, urban_nav
from truth import inverse

SENSORS = "stereo,ladybug,lasers,imu,wheels"
FOUND = ("--stages", "vo,places,loops,graph")
WAYS = {"found": FOUND, "stereo": FOUND, "given": ("--stages", "vo,loops,graph"), "odometry": ("--stages", "vo,graph")}
COLUMNS = ("world, seed", "days", "way", "driven, m", "sessions in one map", "closures accepted", "false ones", "largest error, m", "stretches connected", "revisited poses near one", "odometry, rms, m",
           "relaxed, rms, m", "processor, ms for each s of data")
STRETCH_COLUMNS = ("session", "stretch", "to_session", "looks", "proposed_right", "proposed_wrong", "accepted", "false")
STEREO_TOPICS = ("/stereo", "/imu", "/wheel_odom", "/tf_static", "/ground_truth")
STRETCH_M = 10.0
NEAR_M = 2.0
FALSE_M = 0.5


def by_stereo(bag, folder):
    """Writes a copy without panoramas and lasers; an existing one is used."""
    copy = folder / f"{bag.stem}_stereo.bag"
    if not copy.exists():
        with rosbag.Bag(str(bag)) as source, rosbag.Bag(str(copy), "w") as target:
            topics = [topic for topic in source.get_type_and_topic_info().topics if topic.startswith(STEREO_TOPICS)]
            for topic, message, stamp in source.read_messages(topics=topics, raw=True):
                target.write(topic, message, stamp, raw=True)
        copy.with_suffix(".truth").symlink_to(bag.with_suffix(".truth").resolve())
    return copy


class Drive(closures.Session):
    def __init__(self, bag):
        super().__init__(bag)
        self.travelled = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(self.places, axis=0), axis=1))])

    def stretch(self, stamp):
        return int(np.interp(stamp - self.looks[0], self.looks - self.looks[0], self.travelled) / STRETCH_M)


class Candidate:
    """Compares a row of closures.csv with the truth."""

    def __init__(self, row, drives):
        names = [drive.name for drive in drives]
        self.i, self.j = names.index(row["session_a"]), names.index(row["session_b"])
        a, b = int(row["stamp_a_ns"]), int(row["stamp_b_ns"])
        if (self.i, a) > (self.j, b):
            raise ValueError(f"closure to {row['stamp_a_ns']} begins before its end")
        self.stamp, self.accepted = b, row["verdict"] == "accepted"
        true = inverse(drives[self.i].at([a])[0]) @ drives[self.j].at([b])[0]
        self.right = np.linalg.norm(true[:3, 3]) <= closures.OTHER_PLACE
        self.error = np.linalg.norm([float(row[axis]) - true[k, 3] for k, axis in enumerate("xyz")]) if self.accepted else 0.0
        self.is_false = self.accepted and (not self.right or self.error > FALSE_M)
        self.stretch = (self.j, drives[self.j].stretch(b), self.i)


def candidates(path, drives):
    with path.open() as file:
        return [Candidate(row, drives) for row in csv.DictReader(file)]


def stretch_rows(true, found, drives):
    """Returns a row for each stretch connected by the truth."""
    looks = Counter((j, drives[j].stretch(b), i) for i, _, j, b in true)
    of_stretch = defaultdict(list)
    for each in found:
        of_stretch[each.stretch].append(each)
    rows = []
    for (j, stretch, i), count in sorted(looks.items()):
        here = of_stretch[j, stretch, i]
        rows.append((drives[j].name, stretch, drives[i].name, count, sum(each.right for each in here), sum(not each.right for each in here),
                     sum(each.accepted and not each.is_false for each in here), sum(each.is_false for each in here)))
    return rows


def near_closures(true, found, drives):
    """Returns the numbers of revisited poses and of those near an accepted closure between the same sessions."""
    near = []
    for i, j in sorted({(i, j) for i, _, j, _ in true}):
        poses = drives[j].at(sorted({b for k, _, l, b in true if (k, l) == (i, j)}))[:, :3, 3]
        begins = [each.stamp for each in found if each.accepted and not each.is_false and (each.i, each.j) == (i, j)]
        at = drives[j].at(begins)[:, :3, 3] if begins else np.full((1, 3), np.inf)
        near += [bool(np.linalg.norm(at - pose, axis=1).min() <= NEAR_M) for pose in poses]
    return sum(near), len(near)


def offered(true, drives, path):
    rows = [(drives[i].name, a, drives[j].name, b, 0.99) for i, a, j, b in true]
    path.write_text("\n".join(",".join(map(str, row)) for row in (closures.COLUMNS[:5], *rows)) + "\n")
    return path


def mapped(case, way, bags, true, drives, work):
    """Returns the folder of a map; an existing one is used."""
    world, seed, *days = case.split(":")
    out = work / "_".join((world + seed, *(day.replace("/", "_") for day in days), way))
    if not (out / "summary.json").exists():
        options = ("--closures", offered(true, drives, out.with_suffix(".csv"))) if way == "given" else ()
        urban_nav("map", *bags, *WAYS[way], *options, "--out", out)
    urban_nav("evaluate", "--truth", both_truths(bags, out.with_suffix(".tum")), "--estimate", out / "trajectory.tum", "--json", out / "errors.json")
    return out


def errors_m(out, graph, joined):
    """Returns errors of odometry, each day relative to its first pose, and after relaxation: in one frame if there is one."""
    days = graph["per_session"]
    odometry, relaxed = (root_mean_square([day[key] for day in days], [day["frames"] for day in days]) for key in ("ate_m_odometry", "ate_m"))
    if joined:
        return f"{odometry:.3f}", f"{json.loads((out / 'errors.json').read_text())['ate_m']:.3f}"
    return f"{odometry:.3f}", f"{relaxed:.3f} ({len(days)} frames)"


def day_names(case):
    parts = [(number, *day.partition("/")) for number, day in enumerate(case.split(":")[2:], 1) if day]
    return " + ".join(f"day {number}, {duration} s" + (f" {route}" if route else "") for number, duration, _, route in parts)


def row_of(case, way, arguments):
    bags = driven(arguments.folder, case, SENSORS)
    if way == "stereo":
        bags = [by_stereo(bag, arguments.work) for bag in bags]
    drives = [Drive(bag) for bag in bags]
    true = closures.true_pairs(drives)
    out = mapped(case, way, bags, true, drives, arguments.work)
    summary = json.loads((out / "summary.json").read_text())
    graph = summary["pose_graph"]
    found = candidates(out / "closures.csv", drives) if (out / "closures.csv").exists() else []
    rows = stretch_rows(true, found, drives)
    with (out / "stretches.csv").open("w", newline="") as file:
        csv.writer(file).writerows((STRETCH_COLUMNS, *rows))
    near, poses = near_closures(true, found, drives)
    seconds = sum(drive.truth.stamps[-1] - drive.truth.stamps[0] for drive in drives)
    return [" ".join(case.split(":")[:2]), day_names(case), way, f"{sum(drive.travelled[-1] for drive in drives):.0f}", f"{graph['sessions_joined']} of {len(drives)}",
            f"{sum(each.accepted for each in found)} of {len(found)}", str(sum(each.is_false for each in found)), f"{max((each.error for each in found), default=0.0):.2f}",
            f"{sum(row[-2] > 0 for row in rows)} of {len(rows)}", f"{near / poses:.0%} of {poses}" if poses else "", *errors_m(out, graph, graph["sessions_joined"] == len(drives)),
            f"{1e3 * summary['cpu_s'] / seconds:.0f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of simulated sessions; existing sessions are used")
    parser.add_argument("work", type=Path, help="folder of maps and copies; existing ones are used")
    parser.add_argument("--case", action="append", help="WORLD:SEED:SECONDS[/ROUTE]:SECONDS[/ROUTE], repeatable (default quad:7:300:300)")
    parser.add_argument("--way", action="append", choices=WAYS, help="repeatable (default: found, given)")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    measured = commit()
    for folder in (arguments.folder, arguments.work):
        folder.mkdir(parents=True, exist_ok=True)
    rows = [row_of(case, way, arguments) for case in arguments.case or ["quad:7:300:300"] for way in arguments.way or ("found", "given")]
    notes = ["Stretches of 10 m, and poses each 0.5 s, at the same place by the truth, within a drive or between two. False: places more than 10 m apart, or a transform more than 0.5 m off. Processor: the whole run, reading "
             "included."]
    show(COLUMNS, rows, notes, measured, arguments.output)


if __name__ == "__main__":
    main()
