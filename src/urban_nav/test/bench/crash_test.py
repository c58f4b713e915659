# SPDX-License-Identifier: BSD-3-Clause
import contextlib
import io
import math
import sqlite3
import unittest
from unittest import mock

from case import FolderCase, run
import crash
import live_graph


class Stores(FolderCase):
    def store(self, nodes):
        path = self.folder / "s.db"
        with sqlite3.connect(path) as file:
            file.execute("CREATE TABLE IF NOT EXISTS tally(name, session, count)")
            file.execute("DELETE FROM tally")
            file.execute("INSERT INTO tally VALUES('node', 'a', ?)", (nodes,))
        return path

    def counted(self, opened=True):
        count = crash.Count("it")
        return count, mock.patch.object(crash.subprocess, "run", return_value=mock.Mock(returncode=0 if opened else 1, stderr="damaged"))

    def test_rows_are_those_of_the_tally_and_none_where_there_is_no_store(self):
        self.assertEqual(crash.rows(self.store(7)), {("node", "a"): 7})
        self.assertIsNone(crash.rows(self.folder / "no.db"))
        self.assertFalse((self.folder / "no.db").exists())

    def test_less_than_was_committed_is_counted(self):
        count, run = self.counted()
        with run, contextlib.redirect_stderr(io.StringIO()) as said:
            count.killed(self.store(7), {("node", "a"): 7})
            self.assertEqual((count.kills, count.opened, count.less), (1, 1, 0))
            count.killed(self.store(6), {("node", "a"): 7})
            count.killed(self.folder / "gone.db", {("node", "a"): 7})
        self.assertEqual((count.kills, count.opened, count.less), (3, 3, 2))
        self.assertIn("fewer rows", said.getvalue())
        self.assertFalse(count.good())

    def test_a_store_that_does_not_open_is_counted(self):
        count, run = self.counted(opened=False)
        with run, contextlib.redirect_stderr(io.StringIO()):
            count.killed(self.store(7), {})
        count.ended(True)
        self.assertEqual(count.opened, 0)
        self.assertFalse(count.good())

    def test_the_watch_keeps_the_last_it_saw(self):
        watch = crash.Watch(self.store(3))
        while watch.seen is None:
            pass
        self.store(3).unlink()
        self.assertEqual(watch.end(), {("node", "a"): 3})

    def test_other_bytes_are_named(self):
        for name, text in (("a", "1"), ("b", "1"), ("c", "2")):
            (self.folder / name).mkdir()
            (self.folder / name / "graph.g2o").write_text(text)
        self.assertTrue(crash.equal(self.folder / "a", self.folder / "b", ["graph.g2o"]))
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertFalse(crash.equal(self.folder / "a", self.folder / "c", ["graph.g2o"]))
        self.assertIn("graph.g2o", said.getvalue())

    def mapped(self, name, words):
        (self.folder / name).mkdir()
        for file in crash.SAME:
            (self.folder / name / file).write_text("1")
        with sqlite3.connect(self.folder / name / "session.db") as file:
            for table in crash.PLACES:
                file.execute(f"CREATE TABLE {table}(session, stamp_ns, words)")
            file.executemany("INSERT INTO keyframe_place VALUES(?, ?, ?)", [("a", 2, words), ("a", 1, b"x")])
        return self.folder / name

    def test_other_places_are_named(self):
        whole, same, other = (self.mapped(name, words) for name, words in (("whole", b"y"), ("same", b"y"), ("other", b"z")))
        self.assertTrue(crash.PlaceInputs.equal(whole, same))
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertFalse(crash.PlaceInputs.equal(whole, other))
        self.assertIn("other places", said.getvalue())


@unittest.skipIf(live_graph.rospy is None, "no sourced workspace")
class Recording(unittest.TestCase):
    def test_is_a_chain_that_comes_back_after_a_lap(self):
        x = y = yaw = 0.0
        for i in range(live_graph.LAP):
            step = live_graph.step(i)
            self.assertEqual(step.to_stamp, live_graph.step(i + 1).from_stamp)
            turn = 2 * math.atan2(step.T_from_to.orientation.z, step.T_from_to.orientation.w)
            x, y, yaw = x + 0.1 * math.cos(yaw), y + 0.1 * math.sin(yaw), yaw + turn
        self.assertLess(math.hypot(x, y), 0.2)
        self.assertGreater(math.hypot(x, y), 0.001)
        self.assertEqual(live_graph.closure(live_graph.LAP).a.stamp, live_graph.stamp(0))


if __name__ == "__main__":
    run("bench_crash")
