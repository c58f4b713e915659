# SPDX-License-Identifier: BSD-3-Clause
import unittest
from types import SimpleNamespace

from case import run
import live_faults
from live_faults import Fault


def report(level, message, name="/swf_vo: odometry"):
    return SimpleNamespace(level=level, message=message, name=name)


class Names(unittest.TestCase):
    REPORTS = [(4.0, report(1, "30 % of the pairs lacked an image in the last 10 s: one camera loses images")),
               (6.0, report(0, "pairs lacked an image")),
               (7.0, report(1, "OK; 5 % of the frames have a pose by prediction only: too few features; 3 % of the pairs lacked an image: check it")),
               (8.0, report(2, "OK: 25 % of the pairs lacked an image", "/trust: trust"))]

    def test_the_first_report_with_the_cause_after_the_start_and_the_highest_level(self):
        self.assertEqual(live_faults.named(Fault("lacked an image"), self.REPORTS, 5.0), ("swf_vo: 3 % of the pairs lacked an image", "2", "2.0"))

    def test_a_wrong_cause_is_in_parentheses(self):
        words, level, delay = live_faults.named(Fault("time went back"), self.REPORTS, 7.5)
        self.assertEqual((words, level, delay), ("(trust: OK: 25 % of the pairs lacked an image)", "2", "0.5"))

    def test_nothing_above_level_0_is_no_name(self):
        self.assertEqual(live_faults.named(Fault("lacked an image"), self.REPORTS[:2], 5.0), ("", "", ""))


class Recovery(unittest.TestCase):
    def test_is_the_first_frame_without_a_later_pause(self):
        self.assertEqual(live_faults.normal_after([0.1 * i for i in range(100)], 5.05), "0.1")
        self.assertEqual(live_faults.normal_after([5.1, 5.2, 6.0, 6.1], 5.0), "1.0")
        self.assertEqual(live_faults.normal_after([4.0], 5.0), "never")

    def test_level_0_begins_after_the_last_report_above_it(self):
        self.assertEqual(live_faults.quiet_after(Names.REPORTS, 5.0), "3")
        self.assertEqual(live_faults.quiet_after(Names.REPORTS, 9.0), "0")


class Changes(unittest.TestCase):
    def test_lose_the_stated_share_during_the_fault_alone(self):
        change = live_faults.lose(("/a",), 0.3)
        kept = sum(change("/a", "m", 6.0) is not None for _ in range(10000))
        self.assertAlmostEqual(kept / 10000, 0.7, delta=0.02)
        for topic, at in (("/b", 6.0), ("/a", live_faults.BEGIN - 0.1), ("/a", live_faults.END)):
            self.assertTrue(all(change(topic, "m", at) == "m" for _ in range(100)))

    def test_hold_back_until_the_time(self):
        change = live_faults.hold_back(("/a",), 5.0)
        self.assertIsNone(change("/a", "m", 4.9))
        self.assertEqual(change("/a", "m", 5.0), "m")
        self.assertEqual(change("/b", "m", 1.0), "m")

    def test_a_changed_camera_leaves_the_message_of_the_bag_as_it_is(self):
        info = SimpleNamespace(K=[100.0, 0, 50, 0, 100.0, 40, 0, 0, 1], P=[100.0, 0, 50, -12.0, 0, 100.0, 40, 0, 0, 0, 1, 0])
        changed = live_faults.other_camera(live_faults.INFOS[1], info, live_faults.BEGIN)
        self.assertAlmostEqual(changed.P[3] / changed.P[0], info.P[3] / info.P[0])
        self.assertEqual((info.K[0], info.P[3]), (100.0, -12.0))
        self.assertIs(live_faults.other_camera(live_faults.INFOS[1], info, 1.0), info)


if __name__ == "__main__":
    run("bench_live_faults")
