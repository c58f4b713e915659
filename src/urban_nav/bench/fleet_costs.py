# SPDX-License-Identifier: BSD-3-Clause
"""What a fleet costs: processor time and bytes of each step from recordings to a release, and of localisation with and without one.

Days of one simulated world are mapped, joined in pieces, frozen, added one by one to a release, and the last day is localised in the joined store and in the
release. Processor time counts all threads, so that other work on the machine matters little. docs/guides/fleet.md multiplies these costs.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from support import TOP, commit, show

COLUMNS = ("step", "processor time, s", "a minute driven, s", "MB", "MB a minute driven", "")
SENSORS = "stereo,ladybug,lasers,imu"
MEGABYTE = 1e6


class Steps:
    """Runs commands of one program and keeps a row for each step."""

    def __init__(self, program):
        self.program, self.rows = program, []

    def run(self, *words):
        """Returns the processor time of the command, s."""
        command = [str(self.program), *map(str, words)]
        with tempfile.TemporaryFile("w+") as log:
            process = subprocess.Popen(command, stdout=log, stderr=log)
            _, status, usage = os.wait4(process.pid, 0)
            log.seek(0)
            if status:
                sys.exit(f"{' '.join(command)}:\n{log.read()[-2000:]}")
        return usage.ru_utime + usage.ru_stime

    def add(self, name, seconds, minutes=None, size=None, note=""):
        """Adds a row. `minutes`: of driving that the step processed; `size`: bytes of its result."""
        per_minute = f"{seconds / minutes:.2f}" if minutes else ""
        megabytes = f"{size / MEGABYTE:.2f}" if size else ""
        megabytes_a_minute = f"{size / MEGABYTE / minutes:.1f}" if size and minutes else ""
        self.rows.append([name, f"{seconds:.2f}", per_minute, megabytes, megabytes_a_minute, note])
        print(" ".join(self.rows[-1]), file=sys.stderr)


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def record(steps, folder, world, seed, days, seconds):
    bags = [folder / f"day{day}.bag" for day in range(1, days + 1)]
    for day, bag in enumerate(bags, 1):
        if not bag.exists():
            steps.run("simulate", "--world", world, "--seed", seed, "--duration", seconds, "--day", day, "--sensors", SENSORS, "-o", bag)
    return bags


def map_days(steps, bags, folder):
    """Returns the stores of the days and the minutes driven in each."""
    stores = [folder / bag.stem / "session.db" for bag in bags]
    seconds = sum(steps.run("doctor", bag, "--json", folder / f"{bag.stem}.json") for bag in bags)
    mapped = sum(steps.run("map", bag, "--out", store.parent, "--overwrite", "--threads", 1) for bag, store in zip(bags, stores))
    summaries = [summary(store.parent) for store in stores]
    minutes = [each["duration_s"] / 60.0 for each in summaries]
    peak = max(each["peak_rss_bytes"] for each in summaries) / MEGABYTE
    metres = sum(each["distance_m"] for each in summaries)
    size = sum(bag.stat().st_size for bag in bags)
    steps.add("recordings", 0.0, sum(minutes), size, f"{len(bags)} of {60.0 * sum(minutes) / len(bags):.0f} s, {metres:.0f} m")
    steps.add("doctor", seconds, sum(minutes))
    steps.add("map", mapped, sum(minutes), sum(store.stat().st_size for store in stores), f"at most {peak:.0f} MB of memory; size: of the stores")
    return stores, minutes


def join(steps, stores, minutes, folder):
    """Joins the stores in pieces; returns the joined store."""
    plan, joined = folder / "plan", folder / "fleet.db"
    planning = steps.run("join", *stores, "--plan", plan, "--threads", 1)
    content = json.loads((plan / "plan.json").read_text())
    places = len(content["candidates"]) if "candidates" in content else 0
    measuring = sum(steps.run("join", "--piece", plan / piece, "--threads", 1) for piece in content["pieces"])
    joined.unlink(missing_ok=True)
    finishing = steps.run("join", "--finish", plan, "-o", joined, "--threads", 1, "--json", folder / "join.json")
    steps.add("join --plan", planning, sum(minutes), None, f"{places} candidates")
    per_candidate = f"{measuring / places:.2f} s a candidate" if places else ""
    steps.add("join --piece, all", measuring, sum(minutes), None, per_candidate)
    maps = len(json.loads((folder / "join.json").read_text())["maps"])
    steps.add("join --finish", finishing, sum(minutes), joined.stat().st_size, f"{maps} map{'' if maps == 1 else 's'}")
    return joined


def freeze(steps, joined, stores, minutes, folder):
    """Freezes the joined store, and adds the days one by one to the release of the first; returns the frozen store."""
    whole = folder / "fleet.release"
    whole.unlink(missing_ok=True)
    steps.add("release", steps.run("release", joined, "-o", whole), sum(minutes), whole.stat().st_size)
    grown = folder / "grown1.release"
    grown.unlink(missing_ok=True)
    seconds = steps.run("release", stores[0], "-o", grown)
    steps.add("release of day 1", seconds, minutes[0], grown.stat().st_size)
    for day, store in enumerate(stores[1:], 2):
        following = folder / f"grown{day}.release"
        following.unlink(missing_ok=True)
        seconds = steps.run("join", store, "--onto", grown, "-o", following, "--threads", 1)
        steps.add(f"join --onto, day {day}", seconds, minutes[day - 1], following.stat().st_size)
        grown = following
    return whole


def localise(steps, bag, minutes, places, folder):
    """Localises a day in each of the named maps."""
    for name, place in places.items():
        out = folder / f"where_{place.stem}"
        seconds = steps.run("map", bag, "--localise", place, "--out", out, "--overwrite", "--threads", 1)
        found = summary(out)["localisation"]
        steps.add(f"map --localise, {name}", seconds, minutes, None, f"{found['known_share']:.0%} of the frames KNOWN")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="of recordings and results; existing recordings are used")
    parser.add_argument("--world", default="quad")
    parser.add_argument("--seed", default="7")
    parser.add_argument("--days", type=int, default=4)
    parser.add_argument("--seconds", type=int, default=30)
    parser.add_argument("--program", type=Path, default=TOP / "urban_nav")
    parser.add_argument("-o", "--output", type=Path)
    arguments = parser.parse_args()
    measured = commit()
    folder, steps = arguments.folder, Steps(arguments.program)
    folder.mkdir(parents=True, exist_ok=True)
    bags = record(steps, folder, arguments.world, arguments.seed, arguments.days, arguments.seconds)
    stores, minutes = map_days(steps, bags, folder)
    joined = join(steps, stores, minutes, folder)
    steps.add("info --report", steps.run("info", folder, "--report", folder / "fleet.html"), sum(minutes))
    whole = freeze(steps, joined, stores, minutes, folder)
    localise(steps, bags[-1], minutes[-1], {"the store": joined, "the release": whole}, folder)
    show(COLUMNS, steps.rows, ["One thread; processor time of all threads of a command, reading included."], measured, arguments.output)


if __name__ == "__main__":
    main()
