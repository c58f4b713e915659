# SPDX-License-Identifier: BSD-3-Clause
"""robot.launch on simulated devices at full rate, in real time, with odometry and pose graph in the loop: tests for loss between the devices and the bag of record.launch.

  full_rate.py BAG [--times N] [-o FILE.json] [--work DIR]

BAG: of `urban_nav simulate`, with all sensors. --times: repetitions in one session, separated by a pause of a second, which counts as missing. Needs a sourced workspace (. build/ws/devel/setup.bash).
"""
import os
import signal
import sys
import time
from collections import Counter
from pathlib import Path

import live_graph
from support import commit, session_parser, show, work_folder

try:
    import genpy
    import numpy as np
    import rosbag
except ImportError:
    rosbag = None

# Hz, of the devices; 0: the rate of the session.
RATES = {"/laser_left/scan": 74.97, "/laser_right/scan": 74.97, "/imu/data": 100.0, "/wheel_odom": 100.0, "/gps/fix": 1.0, "/stereo/left/image_raw": 0.0,
         "/stereo/right/image_raw": 0.0, "/ladybug/raw": 0.0, "/vo/statistics": 0.0, "/vo/relative_pose": 0.0}
LOSSES = {"gaps", "messages dropped", "bad checksums", "stalls", "timeouts"}  # counted by the drivers
PATIENCE = 20  # s until the start of the session, and after its end
TICKS = os.sysconf("SC_CLK_TCK")


def repeated(session, times, target):
    """Writes a bag with repetitions of the session, separated by a period of its slowest topic."""
    with rosbag.Bag(str(session)) as bag, rosbag.Bag(str(target), "w") as out:
        begin, end = bag.get_start_time(), bag.get_end_time()
        for k in range(times):
            shift = genpy.Duration.from_sec(k * (end - begin + 1.0))
            for topic, message, received in bag.read_messages():
                if topic.endswith("tf_static"):
                    if k == 0:
                        out.write(topic, message, received)
                    continue
                if hasattr(message, "header"):
                    message.header.stamp += shift
                out.write(topic, message, received + shift)
    return target


def processor_seconds():
    """Returns {name: processor time, s} of the programs on this master."""
    mine = f"ROS_MASTER_URI={os.environ['ROS_MASTER_URI']}".encode()
    found = Counter()
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if mine not in (folder / "environ").read_bytes().split(b"\0"):
                continue
            words = (folder / "cmdline").read_bytes().decode().split("\0")
            name = next((word[len("__name:="):] for word in words if word.startswith("__name:=")), None)
            fields = (folder / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if name:
            found[name] += (int(fields[11]) + int(fields[12])) / TICKS
    return found


def run(session, folder, duration):
    """Drives and records; returns the bags and the processor load of each program."""
    live_graph.begin_master()
    topics = " ".join([*RATES, "/stereo/left/camera_info", "/stereo/right/camera_info", "/tf_static", "/diagnostics"])
    recorder = live_graph.quietly("roslaunch", "urban_nav_launch", "record.launch", f"output:={folder}/recorded", f"topics:={topics}")
    time.sleep(5.0)
    launch = live_graph.quietly("roslaunch", "urban_nav_launch", "robot.launch", f"simulated:={session}", f"ports:={folder}/ports", "loops:=false", "laser_map:=false")
    time.sleep(PATIENCE)
    before, begin = processor_seconds(), time.monotonic()
    time.sleep(max(duration - PATIENCE, 1.0))
    after, seconds = processor_seconds(), time.monotonic() - begin
    time.sleep(PATIENCE)
    for process in (launch, recorder):
        os.killpg(process.pid, signal.SIGINT)
        process.wait()
    return sorted(folder.glob("recorded*.bag")), {name: 100.0 * (after[name] - before[name]) / seconds for name in after}


def stamps_and_losses(bags):
    """Returns {topic: sorted stamps, s}, the status of the frames of odometry, and the last counters of the drivers."""
    stamps, frames, losses = {topic: [] for topic in RATES}, Counter(), {}
    for path in bags:
        with rosbag.Bag(str(path)) as bag:
            for topic, message, _ in bag.read_messages([*RATES, "/diagnostics"]):
                if topic == "/diagnostics":
                    for status in message.status:
                        for item in status.values:
                            if item.key in LOSSES:
                                losses[status.name.lstrip("/").partition(":")[0], item.key] = int(float(item.value))
                    continue
                stamps[topic].append(message.header.stamp.to_sec())
                if topic == "/vo/statistics":
                    frames[message.status] += 1
    return {topic: np.sort(list_) for topic, list_ in stamps.items()}, frames, losses


def missing(stamps, rate):
    """Returns the number of missing messages between the first and the last."""
    steps = np.diff(stamps)
    period = 1.0 / rate if rate else np.median(steps)
    return int(np.sum(np.maximum(np.round(steps / period) - 1, 0)))


def main():
    parser = session_parser(__doc__)
    parser.add_argument("--times", type=int, default=1)
    arguments = parser.parse_args()
    if rosbag is None:
        sys.exit("there is no rosbag here")
    measured = commit()
    folder = work_folder(arguments)
    session = arguments.bag.resolve()
    if arguments.times > 1:
        session = repeated(session, arguments.times, folder / "session.bag")
    with rosbag.Bag(str(session)) as bag:
        duration = bag.get_end_time() - bag.get_start_time()
    bags, shares = run(session, folder, duration)
    if not bags:
        sys.exit(f"nothing was recorded in {folder}")
    stamps, frames, losses = stamps_and_losses(bags)
    rows = [[topic, str(len(s)), f"{(len(s) - 1) / (s[-1] - s[0]):.2f}" if len(s) > 1 else "", f"{s[-1] - s[0]:.1f}" if len(s) > 1 else "",
             str(missing(s, RATES[topic])) if len(s) > 1 else ""] for topic, s in stamps.items()]
    pairs, seen = set(stamps["/stereo/left/image_raw"]), set(stamps["/vo/statistics"])
    counted = {f"{name}, {key}": n for (name, key), n in sorted(losses.items()) if n}
    notes = ["Missing: steps between stamps that contain further periods of the topic. Seconds from the first stamp to the last.",
             f"Stereo pairs, after the first one used by odometry, that it did not use: {sum(stamp > min(seen, default=0) for stamp in pairs - seen)}; "
             f"frames by prediction only: {frames[2]}.",
             "Losses that the drivers counted: " + (", ".join(f"{name} {n}" for name, n in counted.items()) or "none") + ".",
             "Share of a core, %: " + ", ".join(f"{name} {share:.0f}" for name, share in sorted(shares.items()) if share >= 0.5) + f"; all {sum(shares.values()):.0f}."]
    show(("topic", "messages", "Hz", "s", "missing"), rows, notes, measured, arguments.output)


if __name__ == "__main__":
    main()
