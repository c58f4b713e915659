# SPDX-License-Identifier: BSD-3-Clause
"""Live faults: tests that /diagnostics names each fault with its cause, that odometry recovers, and what is lost.

  live_faults.py BAG [--only NAME]... [-o FILE.json] [--work DIR]

BAG: of `urban_nav simulate`, with stereo camera, lasers, IMU and wheels, at least 22 s; its truth in the folder BAG_STEM.truth. Each fault runs by itself in
real time for about 40 s, in the stages of support/live_faults.xml. Needs a sourced workspace (. build/ws/devel/setup.bash), and root for the full disk.
"""
import argparse
import copy
import json
import math
import os
import random
import re
import signal
import sqlite3
import subprocess
import sys
import threading
import time
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable

import live_graph
import numpy as np
import bags
from live_player import IMAGES, INFOS, Player, Recorder, rosbag, rospy
from support import commit, session_parser, show, wait_until, work_folder
from truth import Truth, inverse

DURATION, BEGIN, END = 22.0, 5.0, 9.0  # s of the drive; a fault lasts from BEGIN to END unless it names other times; rates are over 10 s
CADENCE = 0.25  # s; a longer pause between frames is not normal operation
DUTY = (0.02, 0.08)  # s of running and of standstill of a process that has a fifth of a processor
COLUMNS = ("fault", "named as", "level", "after, s", "odometry normal again after, s", "level 0 again after, s", "pairs not measured", "poses not in the store",
           "sessions", "error of position, m")
HERE = Path(__file__).resolve().parent


def unchanged(topic, message, at):
    return message


@dataclass
class Fault:
    """`names`: regular expression of the cause in /diagnostics. `change`, `clock_step`: as in Player. `act(rig)`: runs in a thread from `begin` on."""
    names: str
    change: Callable = unchanged
    clock_step: Callable = lambda at: 0.0
    act: Callable = None
    begin: float = BEGIN
    end: float = END
    arguments: dict = field(default_factory=dict)
    is_small_disk: bool = False
    is_recording: bool = False  # bag.launch plays the bag, to its end or until an interrupt at BEGIN
    tf_at: float = 0.0  # s, when /tf_static is published


def within(at):
    return BEGIN <= at < END


def lose(topics, share):
    """Loses a share of the messages from BEGIN to END, by chance."""
    chance = random.Random(1)
    return lambda topic, message, at: None if topic in topics and within(at) and chance.random() < share else message


def hold_back(topics, until):
    """Withholds the topics until then."""
    return lambda topic, message, at: None if topic in topics and at < until else message


def other_camera(topic, message, at):
    """Changes the focal length by 1 % from BEGIN on."""
    if topic not in INFOS or at < BEGIN:
        return message
    changed = copy.deepcopy(message)
    changed.K = [1.01 * v if i in (0, 4) else v for i, v in enumerate(message.K)]
    changed.P = [1.01 * v if i in (0, 3, 5) else v for i, v in enumerate(message.P)]
    return changed


def not_finite(topics):
    """Three of four messages without finite values from BEGIN to END."""
    count = [0]

    def change(topic, message, at):
        if topic not in topics or not within(at):
            return message
        count[0] += 1
        if count[0] % 4 == 0:
            return message
        changed = copy.deepcopy(message)
        if hasattr(changed, "ranges"):
            changed.ranges = [math.nan] * len(changed.ranges)
        else:
            changed.angular_velocity.z = changed.linear_acceleration.x = math.nan
        return changed
    return change


def process_of(node):
    """Returns the process id of a node on this master."""
    mine, name = f"ROS_MASTER_URI={os.environ['ROS_MASTER_URI']}".encode(), f"__name:={node}".encode()
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if name in (folder / "cmdline").read_bytes().split(b"\0") and mine in (folder / "environ").read_bytes().split(b"\0"):
                return int(folder.name)
        except OSError:
            continue
    return None


def kill(node):
    def act(rig):
        os.kill(process_of(node), signal.SIGKILL)
    return act


def slow_down(rig):
    """Gives the stages of the camera a fifth of a processor."""
    pid, end = process_of("stereo_manager"), time.monotonic() + END - BEGIN
    while time.monotonic() < end:
        os.kill(pid, signal.SIGSTOP)
        time.sleep(DUTY[1])
        os.kill(pid, signal.SIGCONT)
        time.sleep(DUTY[0])


def start_graph(rig):
    rig.processes.append(live_graph.quietly("roslaunch", "urban_nav_launch", "pose_graph.launch", f"store:={rig.store}"))


def slow_subscribers(rig):
    from nav_msgs.msg import Odometry
    from sensor_msgs.msg import Image
    for topic, kind in (("vo/odometry", Odometry), ("stereo/left/image_rect", Image), ("vo/tracks", Image)):
        rospy.Subscriber(topic, kind, lambda message: time.sleep(1.0), queue_size=1)


def free_disk(rig):
    """Enlarges the small disk at END."""
    time.sleep(END)
    subprocess.run(["mount", "-o", "remount,size=200m", rig.folder], check=True)


FAULTS = {
    "no fault": Fault(""),
    "a fifth of a processor": Fault("skipped|dropped", act=slow_down),
    "1 % of the images lost": Fault("lacked an image|missing", lose(IMAGES, 0.01)),
    "10 % of the images lost": Fault("lacked an image", lose(IMAGES, 0.1)),
    "30 % of the images lost": Fault("lacked an image", lose(IMAGES, 0.3)),
    "clock 10 s back": Fault("time went back", clock_step=lambda at: -10.0 + 1e-6 if at >= BEGIN else 0.0, end=BEGIN),
    "tf 5 s late": Fault("no static tf", begin=0.0, end=BEGIN, tf_at=BEGIN),
    "camera_info 5 s late": Fault("camera_info", hold_back(INFOS, BEGIN), begin=0.0, end=BEGIN),
    "right camera_info 5 s late": Fault("right/camera_info", hold_back(INFOS[1:], BEGIN), begin=0.0, end=BEGIN),
    "camera_info changes": Fault("the calibration changed", other_camera, end=BEGIN),
    "right camera dead": Fault("right/image_r", lose(IMAGES[1:], 1.1)),
    "both cameras dead": Fault("image_r.* silent", lose(IMAGES, 1.1)),
    "IMU not finite": Fault("damaged|not finite", not_finite(("/imu/data",))),
    "laser not finite": Fault("ranges were not numbers", not_finite(("/laser_left/scan",))),
    "stereo_manager killed": Fault("odometry|silent|vo/", act=kill("stereo_manager"), end=BEGIN),
    "pose_graph killed": Fault("odometry has gaps", act=kill("pose_graph"), end=BEGIN),
    "pose_graph 5 s late": Fault("lacks the first", act=start_graph, end=BEGIN, arguments={"graph": "false"}),
    "slow subscribers": Fault("", act=slow_subscribers, end=DURATION),
    "Ctrl-C": Fault("", is_recording=True),
    "end of the bag": Fault("", is_recording=True, arguments={"exit": "true"}),
    "disk full": Fault("disk is full", act=free_disk, begin=0.0, is_small_disk=True),
}


class Rig:
    """The stages with a store, the player and the recorder; `run` plays the bag with the fault."""

    def __init__(self, bag, folder, fault):
        self.fault, self.store = fault, folder / "store.db"
        for name in folder.glob("store.db*"):
            name.unlink()
        self.is_mounted = fault.is_small_disk and subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", folder]).returncode == 0
        self.folder, self.player, self.recorder = folder, Player(bag, DURATION, fault.tf_at), Recorder()
        arguments = {"store": self.store, **fault.arguments}
        words = [HERE / "support" / "live_faults.xml"]
        if fault.is_recording:
            words = ["urban_nav_launch", "bag.launch"]
            arguments.update(bag=bag, rviz="false")
        self.log = open(folder.parent / "launch.log", "w")
        self.processes = [subprocess.Popen(["roslaunch", *words, *(f"{k}:={v}" for k, v in arguments.items())],
                                           stdout=self.log, stderr=subprocess.STDOUT, start_new_session=True)]

    def run(self):
        if self.fault.is_recording:
            return self.run_recording()
        if not wait_until(self.player.connected, 60):
            sys.exit(f"the stages do not subscribe: {self.log.name}")
        time.sleep(3.0)
        if self.fault.act:
            threading.Timer(self.fault.begin, self.fault.act, [self]).start()
        self.player.play(self.fault.change, self.fault.clock_step)
        self.over = time.monotonic()
        time.sleep(1.0)  # s, for the last frames

    def run_recording(self):
        if not wait_until(lambda: self.recorder.frames, 60):
            sys.exit(f"no frames: {self.log.name}")
        self.player.begin = self.recorder.frames[0][0]
        self.processes[0].wait(60) if "exit" in self.fault.arguments else time.sleep(BEGIN)
        self.over = time.monotonic()

    def end(self):
        for process in reversed(self.processes):
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGINT)
        for process in self.processes:
            process.wait()
        time.sleep(0.5)
        poses = poses_in(self.store)
        if self.is_mounted:
            subprocess.run(["umount", self.folder])
        return poses


def poses_in(store):
    """Returns {session: number of poses} of a store."""
    if not store.exists():
        return {}
    with closing(sqlite3.connect(f"file:{store}?mode=ro", uri=True)) as file:
        return dict(file.execute("SELECT session, COUNT(*) FROM node GROUP BY session"))


def errors_of(recorder, player, truth):
    """Returns for each session the error of the motion from its first to its last pose, m."""
    starts = {frame.header.stamp.to_nsec() for _, frame in recorder.frames if frame.frame == 0}
    sessions = []
    for _, message in recorder.odometry:
        stamp = message.header.stamp.to_nsec()
        if stamp in starts or not sessions:
            sessions.append([])
        p, q = message.pose.pose.position, message.pose.pose.orientation
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = bags.rotation(np.array([[q.x, q.y, q.z, q.w]]))[0], (p.x, p.y, p.z)
        if stamp in player.original:
            sessions[-1].append((player.original[stamp], pose))
    errors = []
    for poses in filter(None, sessions):
        true = truth.at([poses[0][0], poses[-1][0]])
        errors.append(np.linalg.norm((inverse(inverse(true[0]) @ true[1]) @ inverse(poses[0][1]) @ poses[-1][1])[:3, 3]))
    return errors


def clause_of(message, cause):
    """Returns the part of a report with the cause, without the remedy."""
    parts = [part for clause in message.split("; ") for part in clause.split(": ")]
    return next((part for part in parts if re.search(cause, part)), parts[0])


def named(fault, reports, begin):
    """Returns the stage with its words, the level and the delay of the first report after `begin` that names the cause. Without one: of the first with a level
    above 0, in parentheses."""
    after = [(when - begin, status) for when, status in reports if when >= begin and status.level > 0]
    right = [(delay, status) for delay, status in after if fault.names and re.search(fault.names, status.message)]
    if not (right or after):
        return "", "", ""
    delay, status = (right or after)[0]
    words = f"{status.name.split(':')[0].lstrip('/')}: {clause_of(status.message, fault.names) if right else status.message}"
    return words if right else f"({words})", str(max(status.level for _, status in right or after)), f"{delay:.1f}"


def normal_after(times, end):
    """Returns the s from `end` to the first good frame from which on no pause is longer than CADENCE."""
    later = [t for t in times if t >= end]
    for i in range(len(later) - 1, 0, -1):
        if later[i] - later[i - 1] > CADENCE:
            return f"{later[i] - end:.1f}"
    return f"{later[0] - end:.1f}" if later else "never"


def quiet_after(reports, end):
    """Returns the s from `end` to the last report with a level above 0."""
    loud = [when for when, status in reports if status.level > 0 and when > end]
    return f"{max(loud) - end:.0f}" if loud else "0"


def measure(name, bag, folder):
    fault = FAULTS[name]
    place = folder / "disk"
    place.mkdir(exist_ok=True)
    rig = Rig(bag, place, fault)
    rig.run()
    recorder, begin = rig.recorder, rig.player.begin
    reports = [(when, status) for when, status in recorder.reports if when < rig.over]
    good = recorder.good_frames()
    poses = rig.end()
    frames = len(recorder.frames)  # with those of the end
    errors = errors_of(recorder, rig.player, Truth(bag.with_suffix(".truth") / "trajectory.tum"))
    log = folder / (re.sub(r"\W+", "_", name) + ".log")
    log.write_text("".join(f"{when - begin:.2f} {status.level} {status.name}: {status.message}\n" for when, status in reports))
    row = [name, *named(fault, reports, begin + fault.begin), normal_after(good, begin + fault.end), quiet_after(reports, begin + fault.end),
           f"{rig.player.pairs - len(good)} of {rig.player.pairs}", f"{frames - sum(poses.values())} of {frames}", str(len(poses)),
           f"{max(errors):.3f}" if errors else ""]
    if fault.is_recording:
        row[1:7] = [""] * 6
    return row


def one(bag, name, folder):
    """Runs one fault in a process and on a master of its own."""
    live_graph.begin_master()
    (folder / "row.json").write_text(json.dumps(measure(name, bag, folder)))


def main():
    parser = session_parser(__doc__)
    parser.add_argument("--only", action="append", choices=list(FAULTS), help="this fault (repeatable)")
    parser.add_argument("--one", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if rosbag is None:
        sys.exit("there is no rosbag here")
    folder, bag = work_folder(arguments).resolve(), arguments.bag.resolve()
    if arguments.one:
        return one(bag, arguments.one, folder)
    measured, rows = commit(), []
    for name in arguments.only or FAULTS:
        subprocess.run([sys.executable, __file__, bag, "--one", name, "--work", folder], check=True)
        rows.append(json.loads((folder / "row.json").read_text()))
        print("  ".join(rows[-1]), file=sys.stderr)
    show(COLUMNS, rows, [], measured, arguments.output)


if __name__ == "__main__":
    main()
