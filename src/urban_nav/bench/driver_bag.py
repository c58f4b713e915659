# SPDX-License-Identifier: BSD-3-Clause
"""Compares recorded messages of the drivers on simulated devices with the bag of the session: messages, values, stamps, and odometry.

  driver_bag.py BAG [-o FILE.json] [--work DIR]

BAG: of `urban_nav simulate`, with stereo, lasers, imu, wheels and gps. Needs a sourced workspace (. build/ws/devel/setup.bash). Runs in real time.
"""
import json
import os
import signal
import sys
import time
from pathlib import Path

import live_graph
from support import commit, session_parser, show, urban_nav, work_folder

try:
    import numpy as np
    import rosbag
except ImportError:
    rosbag = None

TOPICS = ("/laser_left/scan", "/laser_right/scan", "/imu/data", "/wheel_odom", "/gps/fix", "/stereo/left/image_raw", "/stereo/right/image_raw")
INFOS = ("/stereo/left/camera_info", "/stereo/right/camera_info")
LEAD, PATIENCE = 8, 12  # s until the start of the session, and after its end
SIZE = 384, 512  # rows and columns of the images of the session
MOST_RMS = 5.0  # grey levels, limit of equal images


def value(topic, message):
    """Returns the key of a measurement."""
    if topic.endswith("scan"):
        return tuple(np.round(message.ranges, 3)), tuple(message.intensities)
    if topic == "/imu/data":
        return tuple(round(float(np.float32(x)), 4) for x in (message.angular_velocity.x, message.angular_velocity.y, message.linear_acceleration.x))
    if topic == "/gps/fix":
        return (round(message.latitude, 6), round(message.longitude, 6)) if message.status.status >= 0 else None
    return None


def grey(message):
    """Returns the image at the size of those of the session."""
    image = np.frombuffer(message.data, np.uint8).reshape(message.height, -1)[:, :message.width].astype(np.float32)
    if image.shape == SIZE:
        return image
    rows, columns = ((np.arange(n) + 0.5) * m / n - 0.5 for n, m in zip(SIZE, image.shape))
    r, c = np.clip(rows, 0, image.shape[0] - 1.001), np.clip(columns, 0, image.shape[1] - 1.001)
    i, j = r.astype(int), c.astype(int)
    a, b = (r - i)[:, None], (c - j)[None]
    return ((1 - a) * (1 - b) * image[np.ix_(i, j)] + (1 - a) * b * image[np.ix_(i, j + 1)] + a * (1 - b) * image[np.ix_(i + 1, j)]
            + a * b * image[np.ix_(i + 1, j + 1)])


def read(path):
    """Returns {topic: [(stamp s, value)]}; images unchanged."""
    messages = {topic: [] for topic in TOPICS}
    with rosbag.Bag(str(path)) as bag:
        for topic, message, _ in bag.read_messages(["/" + t.strip("/") for t in TOPICS] + [t.strip("/") for t in TOPICS]):
            name = "/" + topic.strip("/")
            kept = grey(message) if name.endswith("image_raw") else value(name, message)
            messages[name].append((message.header.stamp.to_sec(), kept))
    return messages


def record(session, recorded, duration):
    """Runs drivers on simulated devices in real time, and a recorder."""
    live_graph.begin_master()
    recorder = live_graph.quietly("rosbag", "record", "--buffsize=1024", "-O", str(recorded), *TOPICS, *INFOS)
    launch = live_graph.quietly("roslaunch", "urban_nav_launch", "drivers.launch", f"simulated:={session}", f"ports:={recorded.parent}/ports", "ladybug:=false")
    time.sleep(LEAD + duration + PATIENCE)
    for process in (recorder, launch):
        os.killpg(process.pid, signal.SIGINT)
        process.wait()
    add_mounting(session, recorded)


def add_mounting(session, recorded):
    """Publishes the poses of the sensors, as the robot description does."""
    with rosbag.Bag(str(session)) as bag, rosbag.Bag(str(recorded), "a") as out:
        begin = out.get_start_time()
        for topic, message, time_ in bag.read_messages(["/tf_static"]):
            out.write(topic, message, type(time_).from_sec(begin))


def match(theirs, ours, topic):
    """(number matched, stamps of each less the median offset, worst rms of images) of what was recorded in the session."""
    if topic.endswith("image_raw"):
        at = np.array([stamp for stamp, _ in theirs])
        best, pairs = None, []
        for start in range(min(40, len(theirs))):  # the first pairs arrive while the camera starts
            difference = float(np.sqrt(np.mean(np.square(theirs[start][1] - ours[0][1]))))
            if best is None or difference < best[0]:
                best = difference, start
        offset = ours[0][0] - at[best[1]]
        for stamp, image in ours:
            i = int(np.argmin(np.abs(at + offset - stamp)))
            pairs.append((stamp - at[i], float(np.sqrt(np.mean(np.square(theirs[i][1] - image))))))
        return sum(rms < MOST_RMS for _, rms in pairs), np.array([d for d, _ in pairs]), max(rms for _, rms in pairs)
    if topic == "/wheel_odom":
        return None, np.array([]), None  # at the rate of the base, not of the session
    known = {v: stamp for stamp, v in theirs if v is not None}
    offsets = [stamp - known[v] for stamp, v in ours if v in known]
    return len(offsets), np.array(offsets), None


def odometry_error(bag, session, folder, shift):
    """Returns the absolute error of visual odometry, m, with stamps of the truth shifted by a number of seconds."""
    urban_nav("map", bag, "--stages", "vo", "--out", folder)
    truth = np.loadtxt(session.with_suffix(".truth") / "trajectory.tum")
    truth[:, 0] += shift
    np.savetxt(folder / "truth.tum", truth, fmt="%.9f")
    urban_nav("evaluate", "--truth", folder / "truth.tum", "--estimate", folder / "trajectory.tum", "--json", folder / "errors.json")
    return json.loads((folder / "errors.json").read_text())["ate_se3_m"]


def main():
    arguments = session_parser(__doc__).parse_args()
    if rosbag is None:
        sys.exit("there is no rosbag here")
    measured = commit()
    folder = work_folder(arguments)
    recorded = folder / "drivers.bag"
    session = arguments.bag.resolve()
    with rosbag.Bag(str(session)) as bag:
        duration = bag.get_end_time() - bag.get_start_time()
    if not recorded.exists():
        record(session, recorded, duration)
    theirs, ours = read(session), read(recorded)
    rows, medians = [], []
    for topic in TOPICS:
        if not ours[topic]:
            rows.append([topic, str(len(theirs[topic])), "0", "", "", ""])
            continue
        matched, offsets, worst = match(theirs[topic], ours[topic], topic)
        spread = np.abs(offsets - np.median(offsets)) if len(offsets) else np.array([])
        settled = spread[len(spread) // 5:]
        medians += [np.median(offsets)] if len(offsets) else []
        rows.append([topic, str(len(theirs[topic])), str(len(ours[topic])), "" if matched is None else str(matched), f"{1e3 * settled.max():.2f}" if len(settled) else "",
                     "" if worst is None else f"{worst:.2f}"])
    notes = ["Equal: messages of the drivers whose values are those of a message of the session; images if they differ by less than 5 grey levels rms. Stamps: largest difference from the "
             "median offset between both, after the first fifth.",
             f"Offsets of the topics agree to {1e3 * (max(medians) - min(medians)):.1f} ms; the latencies of the simulated devices are the defaults of their drivers."]
    shift = np.median(match(theirs["/stereo/left/image_raw"], ours["/stereo/left/image_raw"], "/stereo/left/image_raw")[1])
    errors = [odometry_error(bag, session, folder / name, by) for name, bag, by in (("session", session, 0.0), ("drivers", recorded, shift))]
    notes.append(f"Visual odometry, absolute error: {errors[0]:.3f} m on the session, {errors[1]:.3f} m on the output of the drivers.")
    show(("topic", "in the session", "of the drivers", "equal", "stamps, ms", "images, rms grey levels"), rows, notes, measured, arguments.output)


if __name__ == "__main__":
    main()
