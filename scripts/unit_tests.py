#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the tests of scripts/ and writes their results as gtest does.

    scripts/unit_tests.py FILE.xml

Exit status 0 if all passed.
"""
import sys
import time
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path


class Result(unittest.TextTestResult):
    """Keeps a testcase element for each test."""

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self.suite = xml.Element("testsuite", name="scripts")
        self.case = None
        self.start = 0.0

    def startTest(self, test):
        super().startTest(test)
        kind, name = test.id().rsplit(".", 1)
        self.case = xml.SubElement(self.suite, "testcase", classname=kind, name=name)
        self.start = time.monotonic()

    def stopTest(self, test):
        self.case.set("time", f"{time.monotonic() - self.start:.3f}")
        super().stopTest(test)

    def add(self, tag, text, test=None):
        """To the test that runs; to one of its own where the tests could not be loaded or set up."""
        if self.case is None or self.case.get("time"):
            self.case = xml.SubElement(self.suite, "testcase", classname="scripts", name=str(test), time="0")
        xml.SubElement(self.case, tag).text = text

    def addFailure(self, test, err):
        super().addFailure(test, err)
        self.add("failure", self.failures[-1][1], test)

    def addError(self, test, err):
        super().addError(test, err)
        self.add("error", self.errors[-1][1], test)

    def addSubTest(self, test, subtest, err):
        super().addSubTest(test, subtest, err)
        if err is not None:
            self.add("failure", self._exc_info_to_string(err, subtest), test)

    def addSkip(self, test, reason):
        super().addSkip(test, reason)
        self.add("skipped", reason, test)


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    tests = unittest.defaultTestLoader.discover(str(Path(__file__).resolve().parent), pattern="*_test.py")
    result = unittest.TextTestRunner(resultclass=Result).run(tests)
    path = Path(sys.argv[1])
    path.parent.mkdir(parents=True, exist_ok=True)
    xml.ElementTree(result.suite).write(path)
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
