#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Sums up the XML files of gtest, rosunit and rostest, names what failed and what compiled and ran slowest, and ends with the one line that counts.

Exit status 0 if something passed and nothing failed.
"""
import argparse
import sys
import xml.etree.ElementTree as xml
from pathlib import Path


def why(case):
    """What a failed case said, a few lines of it."""
    said = [child.text or child.get("message") or "" for child in case if child.tag in ("failure", "error")]
    lines = [line.rstrip()[:300] for text in said[:3] for line in text.strip().splitlines()]
    return "".join(f"\n    {line}" for line in lines[:20])


def read(path):
    """(passed, failed, skipped, [what failed]) of one file; a file that cannot be read is a failure."""
    try:
        root = xml.parse(path).getroot()
    except (xml.ParseError, OSError) as error:
        return 0, 1, 0, [f"{path.name}: {error}"]
    cases = list(root.iter("testcase"))
    failed = [c for c in cases if c.find("failure") is not None or c.find("error") is not None]
    skipped = [c for c in cases if c not in failed and (c.find("skipped") is not None or c.get("status") == "notrun")]
    names = [f"{path.parent.name}: {c.get('classname', '')}.{c.get('name', '')}{why(c)}" for c in failed]
    passed = len(cases) - len(failed) - len(skipped)
    if path.name.startswith("rostest-"):  # it only says that a test ran, whose cases stand in a rosunit file of their own
        passed = 0
    outside = int(root.get("errors", 0)) + int(root.get("failures", 0)) - len(failed)  # in the set-up that cases share
    if outside > 0:
        names.append(f"{path.parent.name}: {path.name}: {outside} outside its cases")
    return passed, len(failed) + max(outside, 0), len(skipped), names


def compile_times(log):
    """{object file: seconds} of a ninja log, the last entry of each file."""
    times = {}
    if log.exists():
        for line in log.read_text().splitlines()[1:]:
            start, end, _, output, *_ = line.split("\t")
            if output.endswith(".o"):
                times[output.replace("CMakeFiles/", "")] = (int(end) - int(start)) / 1000
    return times


def test_times(path):
    """{test: seconds} of one file."""
    try:
        root = xml.parse(path).getroot()
    except (xml.ParseError, OSError):
        return {}
    times = {}
    for case in root.iter("testcase"):
        try:
            times[f"{path.parent.name}: {case.get('classname', '')}.{case.get('name', '')}"] = float(case.get("time") or 0)
        except ValueError:
            pass
    return times


def print_slowest(title, times):
    """The ten largest of {name: seconds}."""
    slowest = sorted(times.items(), key=lambda item: -item[1])[:10]
    if slowest:
        print(title)
    for name, seconds in slowest:
        print(f"  {seconds:6.1f}  {name}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--failed-steps", type=int, default=0)
    parser.add_argument("--ninja-log", type=Path, action="append", default=[])
    parser.add_argument("folders", type=Path, nargs="*")
    arguments = parser.parse_args()

    for log in arguments.ninja_log:
        print_slowest(f"The slowest files of {log.parent.parent.name}, s:", compile_times(log))
    files = sorted(p for folder in arguments.folders for p in folder.rglob("*.xml"))
    print_slowest("The slowest tests, s:", {name: s for path in files for name, s in test_times(path).items()})

    passed, failed, skipped = 0, arguments.failed_steps, 0
    for path in files:
        counts = read(path)
        passed, failed, skipped = passed + counts[0], failed + counts[1], skipped + counts[2]
        for name in counts[3]:
            print(f"FAILED {name}")
    print(f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
    return 0 if passed and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
