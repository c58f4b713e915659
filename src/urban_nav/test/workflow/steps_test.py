# SPDX-License-Identifier: BSD-3-Clause
"""workflow/: which recordings there are, what a step of a job does, and the list of sessions. Needs no engine."""
import fcntl
import json
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

WORKFLOW = Path(__file__).resolve().parents[4] / "workflow"
sys.path.insert(0, str(WORKFLOW))
from fleet import recordings, sessions  # noqa: E402


class FolderCase(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, content=b""):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        return path


class Recordings(FolderCase):
    def names(self):
        return list(recordings.find_recordings(self.folder))

    def sqlite(self, name, *tables):
        path = self.folder / name
        with sqlite3.connect(path) as database:
            for table in tables:
                database.execute(f"CREATE TABLE {table}(id)")

    def test_are_recognised_by_content_or_by_their_ending(self):
        self.write("monday.bag", b"#ROSBAG V2.0\n...")
        self.write("tuesday.of.may.mcap.zst", b"\x28\xb5\x2f\xfd...")
        self.write("without_ending", b"\x89MCAP0\r\n...")
        self.write("empty.bag")
        self.sqlite("thursday.db3", "topics", "messages")
        self.write("notes.txt", b"driven by ...")
        self.sqlite("session.db", "session", "node")
        self.assertEqual(self.names(), ["empty", "monday", "thursday", "tuesday.of.may", "without_ending"])

    def test_may_be_folders(self):
        self.write("kitti/image_0/000000.png")
        self.write("euroc/mav0/cam0/data.csv")
        self.write("rosbag2/metadata.yaml")
        self.write("one/part.mcap", b"\x89MCAP0\r\n")
        self.write("drive.truth/trajectory.tum")
        self.write("pictures/a.png")
        self.assertEqual(self.names(), ["euroc", "kitti", "one", "rosbag2"])

    def test_have_names_of_their_own(self):
        self.write("monday.bag")
        self.write("monday.mcap")
        with self.assertRaisesRegex(ValueError, "monday.mcap: expected a name of its own.*monday.bag"):
            self.names()

    def test_that_are_missing_are_an_error(self):
        with self.assertRaisesRegex(ValueError, "expected recordings in it, found none"):
            self.names()
        with self.assertRaisesRegex(ValueError, "expected a folder"):
            recordings.find_recordings(self.folder / "nowhere")


class Steps(FolderCase):
    def step(self, name, script, output="summary.json"):
        command = ["python3", str(WORKFLOW / "step.py"), name, "--output", str(self.folder / output), "--log",
                   str(self.folder / "log"), "--", "sh", "-c", script]
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False).returncode

    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())

    def test_a_recording_that_cannot_be_mapped_is_a_result(self):
        self.assertEqual(self.step("map", "echo warning; echo error: no images: expected some >&2; exit 1"), 0)
        self.assertEqual(self.summary(), {"failed": "no images: expected some", "exit_status": 1})

    def test_a_map_whose_tests_failed_keeps_its_summary(self):
        self.assertEqual(self.step("map", "echo '{}' >summary.json; exit 1"), 0)
        self.assertEqual(self.summary(), {})

    def test_a_killed_command_fails_and_leaves_no_output(self):
        self.write("summary.json", b"{}")
        self.assertEqual(self.step("map", "kill -KILL $$"), 137)
        self.assertFalse((self.folder / "summary.json").exists())
        self.assertEqual(self.step("map", "echo no space left; exit 74"), 74)
        self.assertFalse((self.folder / "summary.json").exists())

    def test_any_other_job_fails_with_its_command(self):
        self.assertEqual(self.step("run", "exit 1"), 1)
        self.assertFalse((self.folder / "summary.json").exists())

    def test_findings_of_doctor_are_kept_where_it_writes_them(self):
        self.assertEqual(self.step("doctor", "echo '{\"usable\": false}' >summary.json; exit 1"), 0)
        self.assertEqual(self.summary(), {"usable": False})
        self.assertEqual(self.step("doctor", "echo error: is not a recording; exit 2"), 0)
        self.assertEqual(self.summary()["failed"], "is not a recording")

    def test_two_runs_of_one_job_do_not_overlap(self):
        with (self.folder / "log").open("a") as log:
            fcntl.flock(log, fcntl.LOCK_EX)  # as a command does whose engine was killed
            step = subprocess.Popen(["python3", str(WORKFLOW / "step.py"), "run", "--output", "x", "--log",
                                     str(self.folder / "log"), "--", "touch", str(self.folder / "ran")])
            with self.assertRaises(subprocess.TimeoutExpired):
                step.wait(timeout=1)
            self.assertFalse((self.folder / "ran").exists())
        self.assertEqual(step.wait(timeout=60), 0)
        self.assertTrue((self.folder / "ran").exists())


class Sessions(FolderCase):
    def setUp(self):
        super().setUp()
        self.summaries = [self.write(f"sessions/{name}/summary.json", b"{}") for name in "abcd"]
        self.summaries[3].write_text('{"failed": "no images", "exit_status": 1}')
        self.plan = self.write("join/plan.json", json.dumps({
            "stores": [{"path": f"../sessions/{name}/session.db", "digest": name} for name in "abc"],
            "sessions": [{"id": id, "name": id, "store": store}
                         for id, store in (("a1", 0), ("a2", 0), ("b1", 1), ("c1", 2))]}).encode())

    def states(self, maps, apart=()):
        joined = self.write("join/finish.json", json.dumps({
            "maps": maps, "apart": [{"session": id, "reason": reason} for id, reason in apart]}).encode())
        rows = sessions.list_states(self.summaries, self.plan, joined, {})
        return {row["name"]: (row["state"], row["reason"]) for row in rows}

    def test_a_recording_is_joined_if_a_session_of_it_is(self):
        states = self.states([["a1", "b1"], ["a2"], ["c1"]], [("a2", "no candidate"), ("c1", "no candidate")])
        self.assertEqual(states, {"a": ("joined", ""), "b": ("joined", ""), "c": ("apart", "no candidate"),
                                  "d": ("failed", "no images")})

    def test_sessions_of_one_recording_are_not_partners(self):
        states = self.states([["a1", "a2"], ["b1", "c1"]])
        self.assertEqual(states["a"][0], "apart")
        self.assertEqual((states["b"][0], states["c"][0]), ("joined", "joined"))

    def test_rows_have_the_findings_of_doctor(self):
        doctor = {"a": self.write("doctor/a.json", b'{"findings": [{"text": "is cut off at byte 9"}]}')}
        joined = self.write("join/finish.json", b'{"maps": [["a1", "b1"]], "apart": []}')
        rows = sessions.list_states(self.summaries, self.plan, joined, doctor)
        self.assertEqual(rows[0]["findings"], ["is cut off at byte 9"])
        self.assertEqual(rows[1]["findings"], [])

    def test_only_what_was_mapped_is_joined(self):
        stores, failed = sessions.split_summaries(self.summaries)
        self.assertEqual(list(stores), ["a", "b", "c"])
        self.assertEqual(stores["a"], str(self.folder / "sessions/a/session.db"))
        self.assertEqual(failed, {"d": "no images"})


if __name__ == "__main__":
    import rosunit
    rosunit.unitrun("urban_nav", "workflow_steps", "__main__")
