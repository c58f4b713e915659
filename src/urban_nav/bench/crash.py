# SPDX-License-Identifier: BSD-3-Clause
"""kill -9 at random times, and a full disk: tests that all committed rows exist and that a restarted run gives the bytes of an uninterrupted one.

    python3 crash.py FOLDER [map] [live] [disk] [places] [live_places] [--kills N] [-o crash.json]

`map`: the whole process group of `urban_nav map` over two small simulated sessions with closures. `live`: the process of the nodelet pose_graph, with a
recording at twenty times its speed and a store. Both are killed and restarted repeatedly until a run completes, which is compared with an uninterrupted one;
then everything is repeated. `places`, `live_places`: the same for `map` with place recognition in panoramas, without given closures, and for the nodelet
fabmap_node; their places are also compared. Committed rows are those that another process reads during writing. `disk`: both on a file system that is too small
and then grows (needs root: a tmpfs is mounted). `live`, `live_places` and the second half of `disk` need a sourced workspace.
"""
import argparse
import os
import random
import shutil
import sqlite3
import subprocess
import sys
import threading
import time
from pathlib import Path

import live_graph
import live_places
from live_graph import CLOSURES, RATE, STEPS, Feeder, begin_nodelet, quietly, stop
from support import TOP, commit, show, urban_nav, wait_until

COLUMNS = ("killed", "kills", "`info` opens", "less than was committed", "runs to the end", "with other bytes", "newest row older than, s (median, most)")
SAME = ("trajectory.tum", "trajectory.kitti", "covariance.csv", "relative_covariance.csv", "closures.csv", "graph.g2o")
PLACES = ("place", "keyframe_place")
PARTS = ("map", "live", "disk", "places", "live_places")
PROGRAM = TOP / "build/ws/devel/lib/urban_nav/urban_nav"  # started by the command at the top, without its check of the build
PERIOD = 0.05  # s between reads of a store that is being written
STARTUP = 1.5  # s, minimum time until a nodelet receives data


def rows(store):
    """Returns the number of rows of each table and session; None if there is no store yet."""
    try:
        with sqlite3.connect(f"file:{store}?mode=ro", uri=True, timeout=5) as file:
            return {(table, session): count for table, session, count in file.execute("SELECT name, session, count FROM tally")}
    except sqlite3.OperationalError:
        return None


class Watch:
    """Polls the committed rows continuously, as a reader."""

    def __init__(self, store):
        self.store, self.seen, self.ending = store, None, threading.Event()
        self.thread = threading.Thread(target=self.look, daemon=True)
        self.thread.start()

    def look(self):
        while not self.ending.wait(PERIOD):
            self.seen = rows(self.store) or self.seen

    def end(self):
        self.ending.set()
        self.thread.join()
        return self.seen or {}


class Count:
    def __init__(self, name):
        self.name, self.kills, self.opened, self.less, self.ends, self.other, self.ages = name, 0, 0, 0, 0, 0, []

    def killed(self, store, seen, age=None):
        self.kills += 1
        if self.kills % 10 == 0:
            print(f"{self.name}: {self.kills} kills", file=sys.stderr)
        if not store.exists():
            self.opened += 1
            self.less += bool(seen)
            return
        result = subprocess.run([PROGRAM, "info", store], capture_output=True, text=True)
        self.opened += result.returncode == 0
        if result.returncode != 0:
            print(f"{self.name}, kill {self.kills}: {result.stderr}", file=sys.stderr)
        there = rows(store) or {}
        fewer = {key: (count, there.get(key, 0)) for key, count in seen.items() if there.get(key, 0) < count}
        if fewer:
            print(f"{self.name}, kill {self.kills}: fewer rows than were committed: {fewer}", file=sys.stderr)
        self.less += bool(fewer)
        if age is not None:
            self.ages.append(age)

    def ended(self, same):
        self.ends += 1
        self.other += not same

    def row(self):
        ages = sorted(self.ages)
        age = f"{ages[len(ages) // 2]:.1f}, {ages[-1]:.1f}" if ages else ""
        return [self.name, *map(str, (self.kills, self.opened, self.less, self.ends, self.other)), age]

    def good(self):
        return self.opened == self.kills and self.less == 0 and self.other == 0 and self.ends > 0


def equal(a, b, names):
    other = [name for name in names if (a / name).read_bytes() != (b / name).read_bytes()]
    if other:
        print(f"other bytes in {b}: {', '.join(other)}", file=sys.stderr)
    return not other


def places(store):
    """Returns all rows of places with words, descriptors and thumbnails."""
    with sqlite3.connect(f"file:{store}?mode=ro", uri=True, timeout=5) as file:
        return [file.execute(f"SELECT * FROM {table} ORDER BY session, stamp_ns").fetchall() for table in PLACES]


class Inputs:
    """Two days of one short route, with the closures between them."""

    def __init__(self, folder, duration):
        self.bags = [folder / f"crash_day{day}.bag" for day in (1, 2)]
        for day, bag in enumerate(self.bags, 1):
            if not bag.exists():
                urban_nav("simulate", "--world", "quad", "--seed", 3, "--day", day, "--duration", duration, "--sensors", "stereo", "-o", bag)
        self.closures = folder / "crash_closures.csv"
        subprocess.run([sys.executable, Path(__file__).with_name("closures.py"), *self.bags, "-o", self.closures, "--false", "20"], check=True,
                       stdout=subprocess.DEVNULL)

    def words(self, out):
        return [str(word) for word in (PROGRAM, "map", *self.bags, "--stages", "vo,graph", "--closures", self.closures, "--out", out)]

    @staticmethod
    def equal(whole, cut):
        return equal(whole, cut, SAME)


class PlaceInputs:
    """Two days of the same short drive, with panoramas."""

    def __init__(self, folder, duration):
        self.bags = [folder / f"crash_panoramas{day}.bag" for day in (1, 2)]
        for day, bag in enumerate(self.bags, 1):
            if not bag.exists():
                urban_nav("simulate", "--world", "quad", "--seed", 3, "--day", day, "--duration", duration, "--sensors", "stereo,ladybug", "-o", bag)

    def words(self, out):
        return [str(word) for word in (PROGRAM, "map", *self.bags, "--stages", "vo,places,loops,graph", "--out", out)]

    @staticmethod
    def equal(whole, cut):
        same = places(whole / "session.db") == places(cut / "session.db")
        if not same:
            print(f"other places in {cut}", file=sys.stderr)
        return equal(whole, cut, SAME) and same


def whole_map(folder, inputs):
    whole = folder / "crash_whole"
    shutil.rmtree(whole, ignore_errors=True)
    begin = time.monotonic()
    subprocess.run(inputs.words(whole), check=True, capture_output=True)
    return whole, time.monotonic() - begin


def kill_map(folder, inputs, kills, chance, name="`urban_nav map`"):
    whole, took = whole_map(folder, inputs)
    count, cut = Count(name), folder / "crash_cut"
    while count.kills < kills:
        shutil.rmtree(cut, ignore_errors=True)
        ended = False
        while not ended and count.kills < kills:
            process, watch = quietly(*inputs.words(cut)), Watch(cut / "session.db")
            try:
                ended = process.wait(chance.uniform(0.0, 1.1 * took)) == 0
            except subprocess.TimeoutExpired:
                stop(process)
            seen = watch.end()
            if not ended:
                count.killed(cut / "session.db", seen)
        if not ended:
            subprocess.run(inputs.words(cut), check=True, capture_output=True)
        count.ended(inputs.equal(whole, cut))
    return count


def exported(store):
    folder = store.with_suffix("")
    folder.mkdir(exist_ok=True)
    urban_nav("export", store, "--tum", folder / "map.tum", "--g2o", folder / "map.g2o")
    return folder


def nodes(store):
    return sum(count for (table, _), count in (rows(store) or {}).items() if table == "node")


def finish(feeder, store, folder, name):
    """Returns the graph at the end of the recording as files of ~save."""
    if not wait_until(lambda: sum(count for (table, _), count in (rows(store) or {}).items() if table == "edge") == STEPS + CLOSURES):
        sys.exit(f"{store}: not all that was fed has come")
    feeder.optimized()
    copy = folder / f"{name}.db"
    copy.unlink(missing_ok=True)
    live_graph.save(copy)
    return exported(copy)


def age_of(store, feeder, now):
    """Returns the age at `now` of the first published step that is not in the store."""
    stored = nodes(store) - 1 if store.exists() else -1
    missing = feeder.fed[max(stored, 0):]
    return now - missing[0] if missing else 0.0


def remove(store):
    for path in store.parent.glob(store.name + "*"):
        path.unlink()


class GraphNodelet:
    """The nodelet pose_graph; compares the files of ~save."""

    name = "nodelet `pose_graph`"

    def __init__(self, folder):
        self.folder, self.store, self.feeder = folder, folder / "crash_live.db", Feeder()
        self.seconds = STEPS / RATE / live_graph.SPEED

    def begin(self):
        return begin_nodelet(self.store)

    def finish(self, is_whole):
        return finish(self.feeder, self.store, self.folder, "crash_live_whole" if is_whole else "crash_live_cut")

    def age(self, now):
        return age_of(self.store, self.feeder, now)

    @staticmethod
    def equal(whole, cut):
        return equal(whole, cut, ("map.tum", "map.g2o"))


class PlacesNodelet:
    """The nodelet fabmap_node; compares the places of its store."""

    name = "nodelet `fabmap_node`"

    def __init__(self, folder, bag):
        self.store, self.feeder = folder / "crash_live_places.db", live_places.PlaceFeeder(bag)
        self.seconds = self.feeder.seconds()

    def begin(self):
        return live_places.begin_nodelet(self.store)

    def finish(self, _):
        if not self.feeder.recognised():
            sys.exit(f"{self.store}: {self.feeder.beliefs} beliefs of {len(self.feeder.panoramas)} panoramas")
        print(live_places.save(self.store), file=sys.stderr)
        return places(self.store)

    def age(self, now):
        """Returns the age at `now` of the first published panorama that is not in the store; those of a previous run mask it."""
        with_places = sum(count for (table, _), count in (rows(self.store) or {}).items() if table == "place") if self.store.exists() else 0
        missing = self.feeder.fed[with_places:]
        return now - missing[0] if missing else 0.0

    @staticmethod
    def equal(whole, cut):
        return whole == cut


def kill_live(nodelet, kills, chance):
    feeder, store = nodelet.feeder, nodelet.store
    count, whole, startup = Count(nodelet.name), None, STARTUP
    while whole is None or count.kills < kills:
        remove(store)
        ended = False
        while not ended:
            begun, process, watch = time.monotonic(), nodelet.begin(), Watch(store)
            last = whole is None or count.kills >= kills
            moment = begun + (1e9 if last else chance.uniform(0.0, startup + nodelet.seconds))
            if feeder.feed(moment):
                ended = last or not wait_until(lambda m=moment: time.monotonic() > m, max(0.0, moment - time.monotonic()))
                if not ended:
                    ended = chance.random() < 0.3  # as if it was not killed
            if feeder.fed:  # a busy machine starts it more slowly
                startup = max(STARTUP, feeder.fed[0] - begun)
            if ended:
                result = nodelet.finish(whole is None)
            now = time.monotonic()
            stop(process)
            seen = watch.end()
            feeder.gone()
            if not ended:
                count.killed(store, seen, nodelet.age(now))
        if whole is None:
            whole = result
        else:
            count.ended(nodelet.equal(whole, result))
    return count


class SmallDisk:
    """Mounts a file system of a few MB; None without permission to mount."""

    def __init__(self, folder):
        self.folder = folder

    def __enter__(self):
        self.folder.mkdir(exist_ok=True)
        return self if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", self.folder], capture_output=True).returncode == 0 else None

    def size(self, megabytes):
        subprocess.run(["mount", "-o", f"remount,size={megabytes}m", self.folder], check=True)

    def __exit__(self, *_):
        subprocess.run(["umount", "-l", self.folder], capture_output=True)


def fill_map(folder, inputs):
    """Runs with several disk sizes, so that the disk becomes full at different times."""
    whole, _ = whole_map(folder, inputs)
    notes = []
    with SmallDisk(folder / "crash_disk") as disk:
        if disk is None:
            return ["Full disk: not tried, a tmpfs cannot be mounted here."], True
        out, named, opened = disk.folder / "out", 0, 0
        sizes = (1, 2, 3)
        for size in sizes:
            shutil.rmtree(out, ignore_errors=True)
            disk.size(size)
            result = subprocess.run(inputs.words(out), capture_output=True, text=True)
            words = result.stderr.strip().splitlines()
            named += result.returncode != 0 and ("full" in result.stderr or "No space" in result.stderr)
            print(f"{size} MB: exit {result.returncode}: {words[-1] if words else ''}", file=sys.stderr)
            store = out / "session.db"
            opened += not store.exists() or subprocess.run([PROGRAM, "info", store], capture_output=True).returncode == 0
        disk.size(64)
        subprocess.run(inputs.words(out), check=True, capture_output=True)
        good = named == len(sizes) and opened == len(sizes) and inputs.equal(whole, out)
        notes.append(f"Full disk, `map` with {', '.join(map(str, sizes))} MB: named {named} times of {len(sizes)}, `info` opens {opened}; after space is freed it ends "
                     f"with {'the same' if good else 'OTHER'} bytes.")
    return notes, good


def fill_live(folder):
    if live_graph.rospy is None:
        return ["Full disk, live: not tried without a sourced workspace."], True
    if "ROS_MASTER_URI" not in os.environ or not live_graph.rosgraph.is_master_online():
        live_graph.begin_master()
    feeder = Feeder()
    with SmallDisk(folder / "crash_disk") as disk:
        if disk is None:
            return [], True
        store = disk.folder / "live.db"
        nodelet = begin_nodelet(store)
        feeder.feed(time.monotonic() + 1e9)
        named = wait_until(lambda: feeder.status and feeder.status.reason_name == "NotStored" and "full" in feeder.status.message)
        before = nodes(store)
        disk.size(64)
        whole = wait_until(lambda: nodes(store) == STEPS + 1)
        healed = wait_until(lambda: feeder.status.reason_name != "NotStored")
        stop(nodelet)
        feeder.gone()
        opened = subprocess.run([PROGRAM, "info", store], capture_output=True).returncode == 0
    good = bool(named and whole and healed and opened)
    return [f"Full disk, live, 1 MB: {'named in the status' if named else 'NOT named'} at {before} of {STEPS + 1} poses; after space is freed "
            f"{'all are' if whole else 'NOT all are'} stored without a restart."], good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of simulated sessions and maps; existing bags are used")
    parser.add_argument("part", nargs="*", help=f"{', '.join(PARTS)} (default: all)")
    parser.add_argument("--kills", type=int, default=100, help="number of kills of each part (default 100)")
    parser.add_argument("--duration", type=int, default=10, help="s, duration of each simulated session (default 10)")
    parser.add_argument("--seed", type=int, default=1, help="seed of the times of kills")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    urban_nav("--help")  # builds it if it is missing
    parts = arguments.part or PARTS
    if set(parts) - set(PARTS):
        parser.error(f"the parts are {', '.join(PARTS)}")
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    measured, chance, counts, notes, good = commit(), random.Random(arguments.seed), [], [], True
    inputs = Inputs(folder, arguments.duration) if {"map", "disk"} & set(parts) else None
    if "map" in parts:
        counts.append(kill_map(folder, inputs, arguments.kills, chance))
        notes.append(f"`map`: two sessions of {arguments.duration} s with closures.")
    place_inputs = PlaceInputs(folder, arguments.duration) if {"places", "live_places"} & set(parts) else None
    if "places" in parts:
        counts.append(kill_map(folder, place_inputs, arguments.kills, chance, "`urban_nav map`, places"))
        notes.append(f"`map` with places: two days of {arguments.duration} s with panoramas, no closures given.")
    if {"live", "live_places"} & set(parts):
        live_graph.begin_master()
    if "live_places" in parts:
        nodelet = PlacesNodelet(folder, place_inputs.bags[0])
        counts.append(kill_live(nodelet, arguments.kills, chance))
        notes.append(f"Nodelet `fabmap_node`: {len(nodelet.feeder.panoramas)} panoramas, played at {live_places.SPEED} times the speed, from the beginning each time.")
    if "live" in parts:
        counts.append(kill_live(GraphNodelet(folder), arguments.kills, chance))
        notes.append(f"Nodelet: {STEPS // RATE} s of odometry with a closure a second, played at {live_graph.SPEED} times the speed, from the beginning each time.")
    if "disk" in parts:
        for said, fine in (fill_map(folder, inputs), fill_live(folder)):
            notes += said
            good = good and fine
    show(COLUMNS, [count.row() for count in counts], notes, measured, arguments.output)
    sys.exit(0 if good and all(count.good() for count in counts) else 1)


if __name__ == "__main__":
    main()
