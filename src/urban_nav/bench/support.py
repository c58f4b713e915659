# SPDX-License-Identifier: BSD-3-Clause
"""Shared functions of this folder: the command, and tables for READMEs (scripts/tables.py)."""
import argparse
import json
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

TOP = Path(__file__).resolve().parents[3]
SENSORS = "stereo,lasers,imu,wheels"
WORLDS = ("quad", "begbroke", "street")
IS_CASE = re.compile(r"\w+:\d")  # of a world, optionally followed by a slash and a route


def urban_nav(*arguments):
    """Runs the command; exits with its error."""
    result = subprocess.run([TOP / "urban_nav", *map(str, arguments)], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"urban_nav {' '.join(map(str, arguments))}:\n{result.stderr[-2000:]}")


def simulated_bag(bag, world, seed, duration, *options):
    """Simulates a session as a bag; an existing one is used."""
    if not bag.exists():
        print(f"drives {bag.stem} for {duration} s", file=sys.stderr)
        urban_nav("simulate", "--world", world, "--seed", seed, "--duration", duration, *options, "-o", bag)
    return bag


def driven(folder, case, sensors=SENSORS, *more):
    """Returns the bags of all days with a duration; existing ones are used. `more`: further options of `simulate`."""
    world, seed, *days = case.split(":")
    bags = []
    for day, (duration, _, route) in enumerate((each.partition("/") for each in days), 1):
        if not duration:
            continue
        options = ("--day", day, "--sensors", sensors, *(("--route", route) if route else ()), *more)
        name = "_".join((f"{world}{seed}_day{day}", *((route,) if route else ())))
        bags.append(simulated_bag(folder / f"{name}.bag", world, seed, duration, *options))
    return bags


def simulated(folder, world, seed, duration, *options):
    """Returns the stereo stream of a session as a KITTI folder; an existing one is used."""
    if not (folder / "poses.txt").exists():
        print(f"drives {folder.name} for {duration} s", file=sys.stderr)
        urban_nav("simulate", "--world", world, "--seed", seed, "--duration", duration, "--sensors", "stereo", *options, "--folder", folder,
                  "-o", f"{folder}.bag")
        Path(f"{folder}.bag").unlink()  # the folder contains all of it
    return folder


def mapped(folder, out, *settings):
    """Returns the summary of visual odometry on a folder, compared with the truth in the folder."""
    urban_nav("map", folder, "--stages", "vo", "--out", out, *(word for each in settings for word in ("--set", each)))
    return json.loads((out / "summary.json").read_text())


def session_parser(text):
    """Parses the arguments of a program for the bag of one session: bag, output table, and folder of intermediate files (`work_folder`)."""
    parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bag", type=Path)
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--work", type=Path)
    return parser


def work_folder(arguments):
    folder = arguments.work or Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def wait_until(so, seconds=30):
    """Returns whether the condition becomes true within the time."""
    end = time.monotonic() + seconds
    while not so() and time.monotonic() < end:
        time.sleep(0.05)
    return so()


def machine():
    info = Path("/proc/cpuinfo").read_text().splitlines()
    names = [line.split(":", 1)[1].strip() for line in info if line.startswith("model name")]
    return f"{names[0] if names else 'unknown'} ({len(names)} cores)"


def commit():
    """Returns the commit of the measured code, with a + if files are changed. Must be called before files are written."""
    def git(*words):
        return subprocess.run(["git", "-C", TOP, *words], capture_output=True, text=True).stdout.strip()
    return git("rev-parse", "--short", "HEAD") + ("+" if git("status", "--porcelain") else "")


def show(columns, rows, notes, measured, output):
    """Prints a table; `output`: file for it, or None. `measured`: commit(). Local paths are omitted."""
    lines = [columns, *rows]
    widths = [max(len(line[i]) for line in lines) for i in range(len(columns))]
    for line in lines:
        print("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip())
    for note in notes:
        print(note)
    if output:
        command = " ".join(word if IS_CASE.match(word) else re.sub(r"[^=]*/", "", word) for word in sys.argv)
        table = {"machine": machine(), "commit": measured, "command": command, "columns": list(columns), "rows": rows, "notes": notes}
        output.write_text(json.dumps(table, indent=1, ensure_ascii=False) + "\n")
