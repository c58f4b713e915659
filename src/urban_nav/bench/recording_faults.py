# SPDX-License-Identifier: BSD-3-Clause
"""Typical faults of recordings applied to fault-free sessions: tests that `doctor` reports each and that its command corrects `map`.

  recording_faults.py [-o FILE.json] [--work DIR] [--only WORDS] [CASE...]

CASE: WORLD:SEED of the simulator (default quad:5 street:6), 15 s with stereo, lasers, IMU, wheels and GPS: the trajectory and the points of the lasers
are compared with those of the sound session. Or a folder of KITTI's raw drives with oxts.csv.gz: images, IMU and GPS are examined alone. Needs
python3-rosbag and python3-opencv.
"""
import argparse
import csv
import gzip
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np

from driver_faults import FAULTS, STEREO
from support import TOP, commit, show, simulated_bag, urban_nav

try:
    import rosbag
    import rospy
    from geometry_msgs.msg import TransformStamped
    from sensor_msgs.msg import Imu, NavSatFix
    from std_msgs.msg import Header
    from tf2_msgs.msg import TFMessage
except ImportError:
    rosbag = None

PROGRAM = TOP / "urban_nav"
SECONDS = 15
SENSORS = "stereo,lasers,imu,wheels,gps"
NEAR = 0.01  # m: equal to the fault-free session
SAMPLE = 20000  # points of a map


def command(*words):
    """Returns exit status and output of the command, which may reject the session."""
    result = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    return result.returncode, result.stdout + result.stderr


def dressed(sound, change, folder):
    """Writes the recordings of a session with the messages of `change.topics` replaced by those of `change`."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    bags = {}
    with rosbag.Bag(str(sound)) as source:
        begin = source.get_start_time()
        for topic, raw, received in source.read_messages(raw=True):
            if topic.strip("/") in change.topics:
                message = raw[4]().deserialize(raw[1])
                entries = [(*entry, False) for entry in change(topic, message, received, received.to_sec() - begin)]
            else:
                entries = [(topic, raw, received, 0, True)]
            for name, entry, when, number, is_raw in entries:
                if number not in bags:
                    bags[number] = rosbag.Bag(str(folder / f"{number}.bag"), "w")
                bags[number].write(name, entry, when, raw=is_raw)
    for bag in bags.values():
        bag.close()
    return [folder / f"{number}.bag" for number in sorted(bags)]


def sound_session(folder, case):
    """Writes every second pair of a simulated session without its truth."""
    world, seed = case.split(":")
    sound = folder / f"{world}{seed}.bag"
    if sound.exists():
        return sound
    whole = simulated_bag(folder / f"{world}{seed}_whole.bag", world, seed, SECONDS, "--sensors", SENSORS)
    count = {}
    with rosbag.Bag(str(whole)) as source, rosbag.Bag(str(sound), "w") as out:
        for topic, raw, received in source.read_messages(raw=True):
            count[topic] = count.get(topic, 0) + 1
            if "ground_truth" not in topic and not ("stereo" in topic and count[topic] % 2 == 0):
                out.write(topic, raw, received, raw=True)
    whole.unlink()
    return sound


def real_session(folder, source):
    """Writes a drive of KITTI with its GPS/INS as an IMU and a GPS receiver, aligned with base_link within a degree."""
    bag = folder / f"{source.name}.bag"
    if bag.exists():
        return bag
    urban_nav("convert", "kitti", source, "-o", bag)
    frames = list(csv.DictReader(open(source / "image_timestamps.csv")))
    zero = seconds_of_day(frames[0]["image_00_utc"])
    with rosbag.Bag(str(bag), "a") as out:
        begin = next(message.header.stamp for _, message, _ in out.read_messages([*STEREO, *("/" + topic for topic in STEREO)]))
        places = TFMessage([TransformStamped() for _ in range(2)])
        for transform, frame in zip(places.transforms, ("imu_link", "gps_link")):
            transform.header.frame_id, transform.child_frame_id, transform.transform.rotation.w = "base_link", frame, 1.0
        out.write("/tf_static", places, begin)
        for row in csv.DictReader(gzip.open(source / "oxts.csv.gz", "rt")):
            header = Header(stamp=begin + rospy.Duration(seconds_of_day(row["utc"]) - zero), frame_id="imu_link")
            imu = Imu(header=header)
            for axis, name in zip("xyz", "flu"):
                setattr(imu.angular_velocity, axis, float(row[f"w{name}_rad_s"]))
                setattr(imu.linear_acceleration, axis, float(row[f"a{name}_m_s2"]))
            fix = NavSatFix(header=Header(stamp=header.stamp, frame_id="gps_link"), latitude=float(row["lat_deg"]), longitude=float(row["lon_deg"]), altitude=float(row["alt_m"]))
            out.write("/imu/data", imu, header.stamp)
            out.write("/gps/fix", fix, header.stamp)
    return bag


def seconds_of_day(utc):
    hours, minutes, seconds = utc.split(" ")[1].split(":")
    return 3600 * float(hours) + 60 * float(minutes) + float(seconds)


def cloud(path):
    """Returns points of a map, at most SAMPLE."""
    kinds = {"float": "<f4", "uchar": "u1", "ushort": "<u2", "double": "<f8"}
    header, body = path.read_bytes().split(b"end_header\n", 1)
    names = [line.split() for line in header.decode().splitlines() if line.startswith("property")]
    rows = np.frombuffer(body, [(name, kinds[kind]) for _, kind, name in names])
    points = np.stack([rows[axis] for axis in "xyz"], 1).astype(np.float32)
    return np.ascontiguousarray(points[::max(1, len(points) // SAMPLE)]), np.ascontiguousarray(points)


class Run:
    """Result of `map` for a session: trajectories, stamps relative to the first one, and points."""

    def __init__(self, bags, out, options):
        shutil.rmtree(out, ignore_errors=True)
        self.status, self.text = command("map", *bags, "--stages", "vo,graph,lasers", "--out", out, *options)
        self.poses = [np.loadtxt(path, ndmin=2) for path in sorted(out.glob("trajectory*.tum"))] if self.status == 0 else []
        self.some, self.points = cloud(out / "map.ply") if self.status == 0 and (out / "map.ply").exists() else (None, None)

    def apart(self, sound):
        """Returns the largest distance of the poses, and the 95 % quantile of that between the points of both maps, m; infinite if one is absent."""
        track = gap = float("inf")
        if self.poses and [len(p) for p in self.poses] == [len(p) for p in sound.poses]:
            track = max(float(np.linalg.norm(a[:, 1:4] - b[:, 1:4], axis=1).max()) for a, b in zip(self.poses, sound.poses))
        if self.points is not None and sound.points is not None:
            gap = max(nearest(self.some, sound.points), nearest(sound.some, self.points))
        return track, gap


def nearest(queries, points):
    index = cv2.flann_Index(points, {"algorithm": 4})  # a kd-tree, exact
    _, squares = index.knnSearch(queries, 1, params={"checks": -1})
    return float(np.quantile(np.sqrt(squares), 0.95))


def examined(bags, folder):
    """Returns the findings of `doctor` and its suggested arguments of `map`."""
    summary = folder / "doctor.json"
    summary.unlink(missing_ok=True)
    command("doctor", *bags, "--json", summary)
    findings = json.loads(summary.read_text())["findings"]
    options = list(dict.fromkeys(tuple(each["options"]) for each in findings if each["options"]))
    return findings, [word for each in options for word in each]


def centimetres(metres):
    return "absent" if metres == float("inf") else f"{100 * metres:.1f}"


def measure(case, folder, only):
    """Returns the rows of a session: fault, reported, options, distances before and after."""
    is_real = Path(case).is_dir()
    sound = real_session(folder, Path(case)) if is_real else sound_session(folder, case)
    name = sound.stem
    with rosbag.Bag(str(sound)) as bag:
        present = {topic.strip("/") for topic in bag.get_type_and_topic_info()[1]}
    rows, runs = [], {}

    def reference(options, change):
        key = (options, change)
        if key not in runs:
            runs[key] = Run(dressed(sound, change, folder / "in"), folder / "out", options)
        return runs[key]

    findings, _ = examined([sound], folder)
    rows.append([name, "sound", "nothing" if not findings else f"{len(findings)} findings", "", "", "", ""])
    for fault in FAULTS:
        if only and not re.search(only, fault.name) or not present.issuperset((*fault.topics, *fault.needs)):
            continue
        bags = dressed(sound, fault, folder / "in")
        findings, options = examined(bags, folder)
        is_named = any(re.search(fault.words, f"{each['text']} {each['remedy']}", re.I) for each in findings)
        named = ("yes" if is_named else "no") if fault.words else ""
        if is_real:
            rows.append([name, fault.name, named, " ".join(options), "", "", ""])
            continue
        runs_of = [Run(bags, folder / "out", (*fault.options, *more)) for more in ((), options)[:2 if options else 1]]
        distances = [run.apart(reference(fault.options, fault.sound)) for run in runs_of]
        is_right = max(distances[-1]) < NEAR
        rows.append([name, fault.name, named, " ".join(options), *(f"{centimetres(track)}, {centimetres(gap)}" for track, gap in (distances[0], distances[-1])),
                     "yes" if is_right else "no"])
        print("  ".join(rows[-1]), file=sys.stderr)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE", default=["quad:5", "street:6"])
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--work", type=Path)
    parser.add_argument("--only", help="faults whose names match this regular expression")
    arguments = parser.parse_args()
    if rosbag is None:
        sys.exit("there is no rosbag here")
    measured = commit()
    folder = arguments.work or Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    rows = [row for case in arguments.cases for row in measure(case, folder, arguments.only)]
    faults = [row for row in rows if row[1] != "sound"]
    mapped = [row for row in faults if row[6]]
    notes = [f"{sum(row[2] == 'yes' for row in faults)} of {sum(bool(row[2]) for row in faults)} faults are reported with their cause; {sum(row[6] == 'yes' for row in mapped)} of {len(mapped)} have the results "
             "of the session without faults to 1 cm with the options that `doctor` prints. Distances: the largest of the trajectory, and the 95 % quantile of the points of the map."]
    show(("session", "fault", "named", "options", "as it is, cm", "with options, cm", "as the sound session"), rows, notes, measured, arguments.output)


if __name__ == "__main__":
    main()
