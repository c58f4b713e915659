# SPDX-License-Identifier: BSD-3-Clause
"""Faults of the rig in simulated sessions: tests that `trust` names each of them, and that fault-free sessions have no failed test.

  trust_faults.py [-o FILE.json] [--reliability FILE.json] [--work DIR] [--only WORDS] [--sound N] [CASE...]

CASE: WORLD:SEED of the simulator (default quad:41 street:42 begbroke:43), 30 s with stereo, lasers, IMU and wheels. Each fault has three sizes; it
begins in the middle of the session or holds from its start. --sound N: maps N fault-free sessions of each case, with the next seeds.
--reliability: shares of the frames of all runs that are within a radius, by the probability stated for it. Needs
python3-rosbag and python3-opencv.
"""
import argparse
import csv
import json
import re
import shutil
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import cv2
import numpy as np

from driver_faults import IMAGES, IMU, INFOS, LASERS, LEFT, STEREO, WHEELS, Change
from recording_faults import command, dressed
from support import commit, show, simulated_bag

try:
    import rosbag
    import rospy
except ImportError:
    rosbag = None

SECONDS = 30
MIDDLE = SECONDS / 2
SENSORS = "stereo,lasers,imu,wheels"
STAGES = "vo,stereo,graph,lasers,trust"
FAR = 0.5  # m: a frame further off must not be KNOWN
RADII = 0.1, 0.5, 2.0  # m, of the stated probabilities
BINS = 0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 0.99, 1.0  # edges, of probabilities
LATE = 5.0  # s: a change is named this long after it at most


@dataclass(frozen=True)
class Fault:
    """`words`: a regular expression that a failed test fits which names the cause. `make(size)`: the change of the messages. `begins`: s."""
    name: str
    unit: str
    sizes: tuple
    topics: tuple
    words: str
    make: Callable
    begins: float = 0.0


def camera_of(message):
    """Returns the camera matrix of the simulated stereo cameras for an image, whose width determines the focal length."""
    scale = message.width / 512
    return np.array([[389.956 * scale, 0, 254.904 * scale], [0, 389.956 * scale, 201.899 * scale], [0, 0, 1]])


def turned(axis, degrees):
    """The image of a camera turned about its x, y or z axis."""
    vector = np.zeros(3)
    vector["xyz".index(axis)] = np.radians(degrees)
    rotation = cv2.Rodrigues(vector)[0]

    def alter(message):
        grey = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)[:, :message.width]
        k = camera_of(message)
        image = cv2.warpPerspective(grey, k @ rotation @ np.linalg.inv(k), (message.width, message.height), borderMode=cv2.BORDER_REPLICATE)
        message.step, message.data = message.width, image.tobytes()
    return alter


def blurred(sigma):
    def alter(message):
        grey = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)[:, :message.width]
        message.step, message.data = message.width, cv2.GaussianBlur(grey, (0, 0), sigma).tobytes()
    return alter


def zoomed(percent):
    """The image of a lens whose focal length grew."""
    def alter(message):
        grey = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)[:, :message.width]
        x, y = message.width / 2, message.height / 2
        image = cv2.warpAffine(grey, cv2.getRotationMatrix2D((x, y), 0, 1 + percent / 100), (message.width, message.height), borderMode=cv2.BORDER_REPLICATE)
        message.step, message.data = message.width, image.tobytes()
    return alter


def late(seconds):
    def alter(message):
        message.header.stamp += rospy.Duration.from_sec(seconds)
    return alter


def info(change):
    def alter(message):
        k, p = list(message.K), list(message.P)
        change(k, p)
        message.K, message.P = k, p
    return alter


def focal(percent):
    def change(k, p):
        for values, places in ((k, (0, 4)), (p, (0, 5, 3))):
            for i in places:
                values[i] *= 1 + percent / 100
    return info(change)


def rate_bias(radians):
    def alter(message):
        message.angular_velocity.z += radians
    return alter


def larger_wheels(percent):
    """Steps and speeds that become larger at the middle of the session."""
    last = {}

    def alter(_, message, t):
        factor = 1 + percent / 100 if t >= MIDDLE else 1.0
        place = message.pose.pose.position
        here = np.array([place.x, place.y])
        if last:
            last["stated"] = last["stated"] + factor * (here - last["true"])
        last.update(true=here, stated=last.get("stated", here))
        place.x, place.y = last["stated"]
        message.twist.twist.linear.x *= factor
    return Change((WHEELS,), alter)


def range_scale(percent):
    def alter(message):
        message.ranges = [r * (1 + percent / 100) for r in message.ranges]
    return alter


def scan_turn(degrees):
    def alter(message):
        message.angle_min += np.radians(degrees)
        message.angle_max += np.radians(degrees)
    return alter


def after(begins, alter):
    """`alter` of messages received after a time in s."""
    return lambda _, message, t: alter(message) if t >= begins else None


def changed(topics, make, begins):
    return lambda size: Change(topics, after(begins, make(size)))


def drifting(topics, seconds):
    """Stamps that become later by a time over the session."""
    return Change(topics, lambda _, message, t: late(seconds * t / SECONDS)(message))


def frozen(topics, seconds):
    """Repeats the image at the middle of the session with new stamps."""
    kept = {}

    def alter(topic, message, t):
        if t >= MIDDLE and topic not in kept:
            kept[topic] = message.data
        if MIDDLE <= t < MIDDLE + seconds:
            message.data = kept[topic]
    return Change(topics, alter)


def knock(name, topics, axis, sizes, words):
    return Fault(name, "deg", sizes, topics, words, changed(topics, lambda size: turned(axis, size), MIDDLE), MIDDLE)


PAIR = r"camera|stereo pair|disparity"
HEAD = r"head|mount"
FAULTS = (
    knock("left camera yawed", IMAGES[:1], "y", (0.05, 0.2, 0.5), PAIR),
    knock("right camera pitched", IMAGES[1:], "x", (0.1, 0.3, 1.0), PAIR),
    knock("right camera rolled", IMAGES[1:], "z", (0.2, 0.5, 1.5), PAIR),
    knock("stereo head pitched", IMAGES, "x", (0.5, 2.0, 5.0), HEAD),
    knock("stereo head rolled", IMAGES, "z", (0.5, 2.0, 5.0), HEAD),
    Fault("focal length too long", "%", (0.5, 1.0, 3.0), INFOS, r"focal|scale|baseline|lengths?", changed(INFOS, focal, 0.0)),
    Fault("clock of the cameras late", "s", (0.05, 0.1, 0.3), STEREO, r"clock|delay|stamp", changed(STEREO, late, 0.0)),
    Fault("clock of the IMU drifts", "s", (0.05, 0.1, 0.3), (IMU,), r"clock|delay|stamp", lambda size: drifting((IMU,), size)),
    Fault("clock of the lasers drifts", "s", (0.05, 0.1, 0.3), LASERS, r"laser", lambda size: drifting(LASERS, size)),
    Fault("gyroscope gets a bias", "rad/s", (0.01, 0.03, 0.1), (IMU,), r"gyroscope", changed((IMU,), rate_bias, MIDDLE), MIDDLE),
    Fault("wheels get larger", "%", (2.0, 5.0, 20.0), (WHEELS,), r"wheel", larger_wheels, MIDDLE),
    Fault("ranges of the lasers too long", "%", (1.0, 3.0, 10.0), LASERS, r"laser|lengths|scale", changed(LASERS, range_scale, 0.0)),
    Fault("a laser turned on its mount", "deg", (1.0, 3.0, 10.0), (LEFT,), r"laser", changed((LEFT,), scan_turn, MIDDLE), MIDDLE),
    Fault("right camera frozen", "s", (0.3, 1.0, 3.0), IMAGES[1:], PAIR, lambda size: frozen(IMAGES[1:], size), MIDDLE),
    Fault("lens of the right camera zooms", "%", (0.3, 1.0, 3.0), IMAGES[1:], PAIR, changed(IMAGES[1:], zoomed, MIDDLE), MIDDLE),
    Fault("lenses out of focus", "px", (1.0, 2.0, 4.0), IMAGES, PAIR, changed(IMAGES, blurred, MIDDLE), MIDDLE),
)


class Run:
    """Result of `map` for a session, with the errors of its positions relative to the first one."""

    def __init__(self, bags, out, truth):
        shutil.rmtree(out, ignore_errors=True)
        self.status, self.text = command("map", *bags, "--stages", STAGES, "--out", out)
        if self.status != 0:
            return
        self.trust = json.loads((out / "summary.json").read_text())["trust"]
        self.failed = [test for test in self.trust["tests"] if test["verdict"] == "failed"]
        path, true = np.loadtxt(out / "trajectory.tum"), np.loadtxt(truth)
        first, begin = path[0], [np.interp(path[0, 0], true[:, 0], true[:, i]) for i in (1, 2, 3)]
        nearest = true[np.abs(true[:, 0] - first[0]).argmin()]
        turn = rotation(nearest[4:8]) @ rotation(first[4:8]).T
        there = np.stack([np.interp(path[:, 0], true[:, 0], true[:, i]) for i in (1, 2, 3)], 1) - begin
        self.off = np.linalg.norm((path[:, 1:4] - first[1:4]) @ turn.T - there, axis=1)
        self.percent = 100 * self.off.max() / np.linalg.norm(np.diff(there, axis=0), axis=1).sum()
        frames = list(csv.DictReader(open(out / "trust.csv")))
        states = [frame["state"] for frame in frames]
        self.stated = np.array([[float(frame[f"p_{radius:g}m"]) for radius in RADII] for frame in frames])
        self.wrong = sum(state == "KNOWN" and off > FAR for state, off in zip(states, self.off))
        self.begin = path[0, 0]

    def names(self, fault):
        """Returns whether a failed test names the cause, within the time allowed."""
        middle = self.begin + fault.begins
        return any(re.search(fault.words, f"{t['name']} {t['sentence']} {t['remedy']}", re.I) and (not fault.begins or abs(1e-9 * t["from_ns"] - middle) < LATE)
                   for t in self.failed)


def rotation(quaternion):
    x, y, z, w = quaternion / np.linalg.norm(quaternion)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def session(folder, world, seed):
    bag = simulated_bag(folder / f"{world}{seed}.bag", world, seed, SECONDS, "--sensors", SENSORS)
    return bag, folder / f"{world}{seed}.truth" / "trajectory.tum"


def reliability_of(runs):
    """Returns rows: stated probability, and for each radius the number of frames and their mean probability and share within it."""
    stated = np.concatenate([run.stated for run in runs])
    inside = np.concatenate([run.off[:, None] < np.array(RADII) for run in runs])
    rows = []
    for low, high in zip(BINS, BINS[1:]):
        row = [f"{low:g} to {high:g}"]
        for k in range(len(RADII)):
            chosen = (stated[:, k] >= low) & ((stated[:, k] < high) | (high == 1.0))
            row += [str(int(chosen.sum())), *(f"{values[chosen, k].mean():.3f}" if chosen.any() else "" for values in (stated, inside))]
        rows.append(row)
    errors = [sum(abs((stated[c, k] - inside[c, k]).mean()) * c.sum() for low, high in zip(BINS, BINS[1:])
                  for c in [(stated[:, k] >= low) & ((stated[:, k] < high) | (high == 1.0))] if c.any()) / len(stated) for k in range(len(RADII))]
    return rows, ["Expected calibration error: " + ", ".join(f"{error:.3f} ({radius:g} m)" for error, radius in zip(errors, RADII)) + f"; {len(stated)} frames of {len(runs)} runs."]


def row_of(name, fault, size, run):
    if run.status != 0:
        return [name, fault, size, "exit status 1", "", "", run.text.strip().splitlines()[-1][:80]]
    tests = ", ".join(sorted({test["name"] for test in run.failed})) or "none"
    return [name, fault, size, f"{run.percent:.2f}", run.trust["state"], str(run.wrong), tests]


def measure(case, folder, arguments):
    """Returns rows (session, fault, size, error, state, frames wrongly KNOWN, failed tests, named) and runs."""
    world, seed = case.split(":")
    rows, runs = [], []
    for number in range(arguments.sound):
        bag, truth = session(folder, world, int(seed) + number)
        run = Run([bag], folder / "out", truth)
        runs.append(run)
        rows.append([*row_of(bag.stem, "sound", "", run), "nothing" if run.status == 0 and not run.failed else "false alarm"])
        print("  ".join(rows[-1]), file=sys.stderr)
        if number > 0:
            bag.unlink()
    bag, truth = session(folder, world, int(seed))
    for fault in FAULTS:
        if arguments.only and not re.search(arguments.only, fault.name):
            continue
        for size in fault.sizes:
            run = Run(dressed(bag, fault.make(size), folder / "in"), folder / "out", truth)
            runs.append(run)
            named = run.status == 0 and run.names(fault)
            rows.append([*row_of(bag.stem, fault.name, f"{size} {fault.unit}", run), "yes" if named else "no"])
            print("  ".join(rows[-1]), file=sys.stderr)
    return rows, [run for run in runs if run.status == 0]


def notes_of(rows):
    faults = [row for row in rows if row[1] != "sound"]
    sound = [row for row in rows if row[1] == "sound"]

    def share(least, most):
        chosen = [row for row in faults if row[4] and least <= float(row[3]) < most]
        return f"{sum(row[7] == 'yes' for row in chosen)} of {len(chosen)}"
    return [f"Named: {share(5, np.inf)} faults that move the path by 5 % or more, {share(1, 5)} by 1 to 5 %, {share(0, 1)} by less. "
            f"{sum(row[7] != 'nothing' for row in sound)} of {len(sound)} fault-free sessions have a failed test. "
            f"{sum(int(row[5] or 0) > 0 for row in rows)} of {len(rows)} runs have frames that are KNOWN and more than {FAR} m off."]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE", default=["quad:41", "street:42", "begbroke:43"])
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--reliability", type=Path, help="output table of the stated probabilities")
    parser.add_argument("--work", type=Path)
    parser.add_argument("--only", help="faults whose names match this regular expression")
    parser.add_argument("--sound", type=int, default=1, help="number of fault-free sessions of each case (default 1)")
    arguments = parser.parse_args()
    if rosbag is None:
        sys.exit("there is no rosbag here")
    measured = commit()
    folder = arguments.work or Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    rows, runs = [], []
    for case in arguments.cases:
        more, of_case = measure(case, folder, arguments)
        rows += more
        runs += of_case
    show(("session", "fault", "size", "path off by, %", "state", "frames KNOWN and wrong", "failed tests", "named"), rows, notes_of(rows), measured, arguments.output)
    show(("stated", *(f"{what}, {radius:g} m" for radius in RADII for what in ("frames", "mean", "within"))), *reliability_of(runs), measured, arguments.reliability)


if __name__ == "__main__":
    main()
