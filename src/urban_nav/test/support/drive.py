#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The simulated drive that tests share: all sensors in the quad, recorded once by the `urban_nav` program and kept while that program stays the same.

    drive.py PROGRAM     prints the path of the bag; the truth is in the folder of the same name, *.truth, with what each beam met
"""
import fcntl
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SECONDS = 24
OPTIONS = ["--seed", "5", "--duration", str(SECONDS), "--views", "lasers"]
TOPICS = {  # of a sensor: how their names begin
    "stereo": ("/stereo/",),
    "ladybug": ("/ladybug/",),
    "lasers": ("/laser_left/", "/laser_right/"),
    "imu": ("/imu/",),
    "wheels": ("/wheel_odom",),
    "gps": ("/gps/",),
}
ALWAYS = ("/tf_static", "/ground_truth/")


def fingerprint(program):
    """Changes with the program, with its libraries of this suite, and with the options of the recording."""
    linked = subprocess.run(["ldd", str(program)], capture_output=True, text=True).stdout.split()  # fails for a script
    digest = hashlib.sha256(" ".join(OPTIONS).encode())
    for path in [str(program), *sorted({word for word in linked if word.startswith("/") and "urban_nav" in Path(word).name})]:
        digest.update(Path(path).read_bytes())
    return digest.hexdigest()[:16]


def record(program):
    """The path of the bag. Tests that run at the same time wait for the first of them, which records it."""
    program = Path(program).resolve()
    top = program.parents[2] / "share" / "urban_nav" / "test_drive"  # of the devel space
    top.mkdir(parents=True, exist_ok=True)
    with open(top / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        folder = top / fingerprint(program)
        if not folder.is_dir():
            for outdated in top.iterdir():
                if outdated.is_dir():
                    shutil.rmtree(outdated)
            unfinished = Path(tempfile.mkdtemp(prefix="unfinished_", dir=top))
            with open(unfinished / "log", "w") as log:
                done = subprocess.run([str(program), "simulate", *OPTIONS, "-o", str(unfinished / "drive.bag")], stdout=log, stderr=log)
            if done.returncode != 0:
                raise RuntimeError("no drive could be simulated: " + (unfinished / "log").read_text(errors="replace")[-2000:])
            os.rename(unfinished, folder)
    return folder / "drive.bag"


def cut(source, target, seconds, sensors):
    """Writes the first seconds of these sensors to another bag: the messages of a session of that length with these sensors alone.
    Returns the path of the truth's trajectory."""
    import rosbag
    kept = tuple(name for sensor in sensors for name in TOPICS[sensor]) + ALWAYS
    with rosbag.Bag(str(source)) as whole, rosbag.Bag(str(target), "w") as part:
        end = None
        for topic, message, stamp in whole.read_messages(raw=True):
            end = end or stamp.to_nsec() + round(1e9 * seconds)
            if stamp.to_nsec() >= end:
                break
            if topic.startswith(kept):
                part.write(topic, message, stamp, raw=True)
    return Path(source).with_suffix(".truth") / "trajectory.tum"


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    print(record(sys.argv[1]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
