#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints, for each package, which share of its lines and branches the tests of a build with counters ran (gcovr).

Counted are the libraries and commands: not tests, benches, code that the compiler generates, or nodelets, which ROS tests run.
"""
import argparse
import json
import os
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
APART = ("test", "testing", "bench", "nodelet", "reference", "tools")  # folders of a package
GOAL = 85.0  # % of the lines
WORKSPACE = "build/ws/src/urban_nav/"  # a link to the repository, by which the compiler knows most files


def package_of(path):
    """The package of a file, relative to the repository; None for files that are not counted."""
    parts = Path(path).parts
    if not parts or parts[0] in ("build", ".."):
        return None
    name = parts[1] if parts[0] == "src" and len(parts) > 1 else parts[0]
    inside = parts[2:] if parts[0] == "src" else parts[1:]
    return None if set(inside[:-1]) & set(APART) or not inside else name


def sums(files):
    """{package: [lines run, lines, branches run, branches]} of gcovr's summary."""
    by_name = {}
    for file in files:
        name = file["filename"].removeprefix(WORKSPACE)
        if name not in by_name or file["line_covered"] > by_name[name]["line_covered"]:
            by_name[name] = file
    counted = defaultdict(lambda: [0, 0, 0, 0])
    for name, file in by_name.items():
        package = package_of(name)
        if package is None:
            continue
        for i, key in enumerate(("line_covered", "line_total", "branch_covered", "branch_total")):
            counted[package][i] += file[key]
    return dict(counted)


def share(part, whole):
    return 100.0 * part / whole if whole else 100.0


def table(counted):
    total = [sum(values) for values in zip(*counted.values())]
    lines = [f"{'package':24} {'lines':>8} {'run, %':>7} {'branches':>9} {'run, %':>7}"]
    for name, row in [*sorted(counted.items()), ("all", total)]:
        low = "  below the goal" if share(row[0], row[1]) < GOAL else ""
        lines.append(f"{name:24} {row[1]:8} {share(row[0], row[1]):7.1f} {row[3]:9} {share(row[2], row[3]):7.1f}{low}")
    return "\n".join(lines)


def measure(build):
    command = ["gcovr", "--root", str(ROOT), "--object-directory", str(build), "--json-summary-pretty", "-j", str(os.cpu_count() or 1),
               "--exclude-throw-branches", "--exclude-unreachable-branches", "--gcov-ignore-parse-errors", str(build)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    if done.returncode != 0:
        sys.exit(f"gcovr: {done.stderr.strip()[-2000:]}")
    return json.loads(done.stdout)["files"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path, help="folder of a build with -DURBAN_NAV_COVERAGE=ON whose tests have run")
    counted = sums(measure(parser.parse_args().build.resolve()))
    if not counted:
        sys.exit("coverage: no counters; build with -DURBAN_NAV_COVERAGE=ON and run the tests first")
    print(table(counted))


if __name__ == "__main__":
    main()
