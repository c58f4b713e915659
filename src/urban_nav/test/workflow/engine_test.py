# SPDX-License-Identifier: BSD-3-Clause
"""workflow/Snakefile, run by Snakemake on small recordings of which two are damaged: a killed job and a restarted engine change no
byte. Skipped without snakemake; with URBAN_NAV_INSTALL=1 it is installed first. With URBAN_NAV_SLURM=1 also on a Slurm of one node,
which the test starts as root (slurm-wlm)."""
import copy
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import drive  # noqa: E402
import single_node_slurm  # noqa: E402

ROOT = Path(__file__).resolve().parents[4]
SNAKEFILE = ROOT / "workflow" / "Snakefile"
PROGRAM = shutil.which("urban_nav")  # of the workspace
SECONDS = 4
DAY_NS = 86_400 * 10**9
STAGES = "--stages vo,places,loops,graph"
LIMIT_S = 1800  # of one engine, on a machine that does other work


def install(package):
    """Installs a package of Debian if the environment asks for it."""
    if os.environ.get("URBAN_NAV_INSTALL") == "1":
        subprocess.run(["apt-get", "install", "-y", "--no-install-recommends", package], check=True, capture_output=True)


def on_another_day(source, target, days):
    """Writes a bag whose stamps are later by so many days: the same drive as another session."""
    import rosbag
    import rospy

    def later(stamp):
        return rospy.Time.from_sec(0) + rospy.Duration(nsecs=stamp.to_nsec() + days * DAY_NS)

    with rosbag.Bag(str(source)) as whole, rosbag.Bag(str(target), "w") as shifted:
        for topic, message, stamp in whole.read_messages():
            message = copy.deepcopy(message)
            if hasattr(message, "header"):
                message.header.stamp = later(message.header.stamp)
            shifted.write(topic, message, later(stamp))


@unittest.skipUnless(PROGRAM, "no urban_nav on the path of the workspace")
class Engine(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        install("snakemake")
        cls.snakemake = shutil.which("snakemake")
        if not cls.snakemake:
            raise unittest.SkipTest("no snakemake (apt-get install snakemake, or URBAN_NAV_INSTALL=1)")
        cls.folder = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        recordings = cls.folder / "recordings"
        recordings.mkdir()
        drive.cut(drive.record(Path(PROGRAM).resolve()), recordings / "monday.bag", SECONDS, ["stereo"])
        on_another_day(recordings / "monday.bag", recordings / "tuesday.bag", 1)
        on_another_day(recordings / "monday.bag", cls.folder / "wednesday.bag", 2)
        whole = (cls.folder / "wednesday.bag").read_bytes()
        (recordings / "torn.bag").write_bytes(whole[:3 * len(whole) // 4])
        (recordings / "noise.bag").write_bytes(bytes(range(256)) * 20)
        cls.expected = cls.run_to_end("undisturbed")

    @classmethod
    def start(cls, out, *options):
        command = [cls.snakemake, "-s", str(SNAKEFILE), "--cores", "2", *options, "--config", "recordings=recordings",
                   f"out={out}", f"program={PROGRAM}", f"map_options={STAGES}"]
        workplace = cls.folder / f"{out}.engine"  # of its notes and locks
        workplace.mkdir(exist_ok=True)
        for name in ("recordings", out):
            link = workplace / name
            if not link.is_symlink():
                (cls.folder / name).mkdir(exist_ok=True)
                link.symlink_to(cls.folder / name)
        log = (cls.folder / f"{out}.txt").open("a")
        return subprocess.Popen(command, cwd=workplace, stdout=log, stderr=log, start_new_session=True)

    @classmethod
    def run_to_end(cls, out, *options):
        engine = cls.start(out, *options)
        status = engine.wait(timeout=LIMIT_S)
        if status != 0:
            raise AssertionError(f"{out}: exit status {status}\n{(cls.folder / f'{out}.txt').read_text()[-4000:]}")
        return cls.results(out)

    @classmethod
    def results(cls, out):
        """The bytes of what a run of the workflow is compared by."""
        names = ["fleet.release", "fleet.json"]
        for name in ("monday", "tuesday", "torn"):
            names += [f"sessions/{name}/{file}" for file in ("trajectory.tum", "covariance.csv", "closures.csv", "graph.g2o")]
        return {name: (cls.folder / out / name).read_bytes() for name in names}

    def wait_for_map(self, out, name):
        """Returns the process that maps a recording, as soon as its store exists."""
        store = self.folder / out / "sessions" / name / "session.db"
        end = time.monotonic() + LIMIT_S
        while time.monotonic() < end:
            found = subprocess.run(["pgrep", "-f", f"^[^ ]*urban_nav map [^ ]*/{name}.bag .*--out {out}/sessions/{name}"],
                                   capture_output=True, text=True, check=False).stdout.split()
            if found and store.exists():
                return int(found[0])
            time.sleep(0.02)
        self.fail(f"{out}: {name} was not mapped: {(self.folder / f'{out}.txt').read_text()[-2000:]}")

    def assert_same(self, results):
        self.assertEqual([name for name in self.expected if results[name] != self.expected[name]], [])

    def test_every_recording_is_listed(self):
        rows = {row["name"]: row for row in json.loads(self.expected["fleet.json"])["sessions"]}
        self.assertEqual({name: row["state"] for name, row in rows.items()},
                         {"monday": "joined", "tuesday": "joined", "torn": "joined", "noise": "failed"})
        self.assertIn("is not a recording", rows["noise"]["reason"])
        self.assertTrue(any("cut off" in finding for finding in rows["torn"]["findings"]), rows["torn"])
        self.assertEqual(rows["monday"]["findings"], [])
        out = self.folder / "undisturbed"
        for name in ("fleet.db", "fleet.html", *(f"doctor/{name}.json" for name in rows)):
            self.assertTrue((out / name).is_file(), name)
        self.assertIn("sessions/noise", (out / "fleet.html").read_text())

    def test_a_killed_job_resumes_to_the_same_bytes(self):
        engine = self.start("killed")
        os.kill(self.wait_for_map("killed", "tuesday"), signal.SIGKILL)
        self.assertEqual(engine.wait(timeout=LIMIT_S), 0, (self.folder / "killed.txt").read_text()[-3000:])
        self.assertIn("Trying to restart job", (self.folder / "killed.txt").read_text())
        self.assert_same(self.results("killed"))

    def test_a_restarted_engine_continues_to_the_same_bytes(self):
        engine = self.start("restarted")
        self.wait_for_map("restarted", "monday")
        os.kill(engine.pid, signal.SIGKILL)  # its jobs live on; the next engine waits for them
        engine.wait(timeout=60)
        unlock = self.start("restarted", "--unlock")
        self.assertEqual(unlock.wait(timeout=LIMIT_S), 0)
        self.assert_same(self.run_to_end("restarted", "--rerun-incomplete"))
        done = self.start("restarted", "--dry-run")
        self.assertEqual(done.wait(timeout=LIMIT_S), 0)
        self.assertIn("Nothing to be done", (self.folder / "restarted.txt").read_text())

    def test_slurm_gives_the_same_bytes(self):
        if os.environ.get("URBAN_NAV_SLURM") != "1":
            self.skipTest("URBAN_NAV_SLURM=1 starts a Slurm of one node (slurm-wlm, as root)")
        install("slurm-wlm")
        with single_node_slurm.started(self.folder / "slurm"):
            engine = self.start("slurm", "--profile", str(ROOT / "workflow" / "profiles" / "slurm"))
            os.kill(self.wait_for_map("slurm", "tuesday"), signal.SIGKILL)
            self.assertEqual(engine.wait(timeout=LIMIT_S), 0, (self.folder / "slurm.txt").read_text()[-3000:])
        self.assert_same(self.results("slurm"))


if __name__ == "__main__":
    import rosunit
    rosunit.unitrun("urban_nav", "workflow_engine", "__main__")
