# SPDX-License-Identifier: BSD-3-Clause
"""scripts/: what run_tests.sh believes of results, and what stands in the READMEs."""
import json
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[4] / "scripts"))
import results  # noqa: E402
import tables  # noqa: E402


class FolderCase(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)


class Results(FolderCase):
    def read(self, text, name="gtest-a.xml"):
        path = self.folder / name
        path.write_text(text)
        return results.read(path)

    def test_each_case_is_passed_failed_or_skipped(self):
        cases = ('<testcase classname="A" name="good"/><testcase classname="A" name="bad"><failure/></testcase>'
                 '<testcase classname="A" name="thrown"><error/></testcase><testcase name="s"><skipped/></testcase><testcase name="n" status="notrun"/>')
        passed, failed, skipped, names = self.read(f'<testsuites failures="1" errors="1"><testsuite>{cases}</testsuite></testsuites>')
        self.assertEqual((passed, failed, skipped), (1, 2, 2))
        self.assertEqual([name.split(": ")[1] for name in names], ["A.bad", "A.thrown"])

    def test_what_failed_before_the_cases_began_counts(self):
        passed, failed, _, names = self.read('<testsuite errors="1" failures="0"><testcase name="good"/></testsuite>')
        self.assertEqual((passed, failed), (1, 1))
        self.assertIn("1 outside its cases", names[0])

    def test_a_file_that_ends_too_early_is_a_failure(self):
        self.assertEqual(self.read("<testsuite><testcase")[:3], (0, 1, 0))
        self.assertEqual(results.read(self.folder / "nowhere.xml")[:3], (0, 1, 0))

    def test_that_a_rostest_ran_is_no_test(self):
        text = '<testsuite><testcase name="ran"/></testsuite>'
        self.assertEqual(self.read(text)[0], 1)
        self.assertEqual(self.read(text, "rostest-a.xml")[0], 0)

    def test_of_a_file_compiled_twice_the_last_time_counts(self):
        log = self.folder / ".ninja_log"
        log.write_text("# ninja log v5\n0\t9000\t0\tCMakeFiles/a.dir/b.cpp.o\tx\n500\t2000\t0\tCMakeFiles/a.dir/b.cpp.o\tx\n0\t1\t0\tliba.so\tx\n")
        self.assertEqual(results.compile_times(log), {"a.dir/b.cpp.o": 1.5})


class Tables(FolderCase):
    DATA = {"columns": ["a", "b"], "rows": [["1.50", 2.50], ["x", None]], "machine": "M", "commit": "c", "command": "p.py", "notes": ["One.", "Two."]}

    def render(self, selection="", **changes):
        (self.folder / "results").mkdir(exist_ok=True)
        (self.folder / "results" / "t.json").write_text(json.dumps(self.DATA | changes))
        with mock.patch.object(tables, "ROOT", self.folder):
            return tables.render("t", selection)

    def test_numbers_stand_as_the_file_has_them(self):
        self.assertEqual(self.render().splitlines(), ["| a | b |", "| --- | --- |", "| 1.50 | 2.5 |", "| x |  |", "", "One.", "Two.",
                                                      "<sub>`p.py` on M, commit c</sub>"])

    def test_a_selection_keeps_columns_and_rows(self):
        self.assertEqual(self.render("; columns: b | a; where: a = 1.50 | y").splitlines(),
                         ["| b | a |", "| --- | --- |", "| 2.5 | 1.50 |", "", "<sub>M, commit c</sub>"])

    def test_a_selection_of_what_is_not_there_is_an_error(self):
        for selection in ("; columns: c", "; where: c = 1", "; where: a = z", "; rows: a"):
            with self.assertRaisesRegex(ValueError, "selection"):
                self.render(selection)

    def test_a_marked_table_is_found_with_its_selection(self):
        found = tables.TABLE.search("<!-- table: a/b; columns: x, y | z -->\nold\n<!-- end -->")
        self.assertEqual((found[2], found[3], found[4]), ("a/b", "; columns: x, y | z", "old\n"))

    def test_a_row_too_short_is_named(self):
        with self.assertRaisesRegex(ValueError, r"results/t.json: 2 columns, but a row is \['x'\]"):
            self.render(rows=[["x"]])

    def test_a_file_that_is_not_there_is_named(self):
        with mock.patch.object(tables, "ROOT", self.folder), self.assertRaisesRegex(ValueError, "results/none.json does not exist"):
            tables.render("none")


if __name__ == "__main__":
    import rosunit
    rosunit.unitrun("urban_nav", "scripts", "__main__")
