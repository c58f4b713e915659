# SPDX-License-Identifier: BSD-3-Clause
"""Commands as functions: the results and the errors of the program."""
import json
import os
import signal
import sys
import unittest
from pathlib import Path

import numpy as np

import urban_nav
from urban_nav import _tables

sys.path.insert(0, str(Path(__file__).resolve().parent))
from case import FolderCase, stereo_bag  # noqa: E402


class Map(FolderCase):
    def test_files_are_those_of_the_command_and_the_store_holds_them(self):
        bag = stereo_bag(self.folder / "drive.bag")
        status, text = self.run_program("map", bag, "--stages", "vo", "--threads", 1, "--out", self.folder / "command")
        self.assertEqual(status, 0, text)
        calls = []
        summary = urban_nav.map(bag, self.folder / "module", stages="vo", threads=1, progress=lambda *each: calls.append(each))
        for name in ("trajectory.tum", "trajectory.kitti", "covariance.csv", "relative_covariance.csv"):
            self.assertEqual((self.folder / "module" / name).read_bytes(), (self.folder / "command" / name).read_bytes(), name)
        frames = summary["frames"]
        self.assertGreater(frames, 20)
        self.assertEqual({stage for stage, _, _ in calls}, {"vo"})
        self.assertEqual(calls[-1][1], frames)
        self.assertEqual([done for _, done, _ in calls], sorted(done for _, done, _ in calls))
        self.check_store(frames)
        self.check_visual_odometry(bag)

    def check_store(self, frames):
        store = urban_nav.Store(self.folder / "module" / "session.db")
        self.assertEqual([(each.map, each.poses, each.complete) for each in store.sessions], [(0, frames, True)])
        stamps, T_map_base = store.trajectory()
        rows = np.loadtxt(self.folder / "module" / "trajectory.tum")
        np.testing.assert_allclose(T_map_base[:, :3, 3], rows[:, 1:4], atol=1e-12)
        np.testing.assert_allclose(1e-9 * stamps, rows[:, 0], atol=1e-6)
        np.testing.assert_array_equal(store.trajectory(store.sessions[0].id[:8])[0], stamps)
        steps = np.loadtxt(self.folder / "module" / "relative_covariance.csv", delimiter=",", skiprows=1, usecols=range(3, 39))
        np.testing.assert_allclose(store.relative_covariances(), steps.reshape(-1, 6, 6), rtol=1e-12, atol=1e-300)
        poses = np.loadtxt(self.folder / "module" / "covariance.csv", delimiter=",", skiprows=1, usecols=range(2, 38))
        np.testing.assert_allclose(store.covariances(), poses.reshape(-1, 6, 6), rtol=1e-12, atol=1e-300)
        self.assertTrue((np.linalg.eigvalsh(store.covariances()[1:]) > 0).all())
        self.assertEqual(len(store.closures()), 0)
        self.assertIn("stamp_a_ns", store.closures().dtype.names)
        self.fails(1, "session.db", store.cloud)
        self.fails(2, "absent", store.trajectory, "absent")

    def check_visual_odometry(self, bag):
        """A loop of one's own follows the path of `map`, whose wheels and IMU are not in this bag."""
        infos, pairs = {}, {}
        for topic, _, message in urban_nav.Recording(bag).messages():
            side = "left" if "/left/" in topic else "right" if "/right/" in topic else ""
            if topic.endswith("camera_info"):
                infos.setdefault(side, message)
            elif side:
                pairs.setdefault(message.header.stamp, {})[side] = message.image
        odometry = urban_nav.Vo(infos["left"], infos["right"])
        frames = [odometry.add(stamp, pair.get("left"), pair.get("right")) for stamp, pair in sorted(pairs.items())]
        expected = np.loadtxt(self.folder / "module" / "trajectory.kitti").reshape(-1, 3, 4)
        self.assertEqual(len(frames), len(expected))
        self.assertEqual({frame.status for frame in frames}, {"OK"})
        np.testing.assert_allclose(frames[-1].T_first_left[:3, 3], expected[-1, :, 3], atol=0.02)
        self.assertTrue((np.linalg.eigvalsh(frames[-1].covariance) > 0).all())
        self.assertGreater(len(frames[-1].features), 50)
        self.assertNotEqual(odometry.add(stamp_after(frames[-1]), None, None).status, "OK")
        self.fails(2, "px", odometry.add, stamp_after(frames[-1], 2), np.zeros((9, 9), np.uint8), None)
        self.fails(2, "expected H x W of uint8", odometry.add, stamp_after(frames[-1], 2), np.zeros((9, 9)), None)
        self.fails(2, "window", urban_nav.Vo, infos["left"], infos["right"], window=0)
        self.fails(2, "left_info", urban_nav.Vo, infos["right"], infos["left"])

    def test_ctrl_c_ends_a_run_which_then_resumes(self):
        bag = stereo_bag(self.folder / "drive.bag", 2)
        with self.assertRaises(KeyboardInterrupt):
            urban_nav.map(bag, self.folder / "out", stages="vo", progress=lambda *_: os.kill(os.getpid(), signal.SIGINT))
        self.assertFalse((self.folder / "out" / "summary.json").exists())
        self.assertGreater(urban_nav.map(bag, self.folder / "out", stages="vo")["frames"], 10)

    def test_an_error_of_the_callback_comes_through(self):
        def fail(*_):
            raise ZeroDivisionError("mine")

        with self.assertRaisesRegex(ZeroDivisionError, "mine"):
            urban_nav.map(stereo_bag(self.folder / "drive.bag", 1), self.folder / "out", stages="vo", progress=fail)

    def test_errors_have_the_text_of_the_command(self):
        absent = self.folder / "absent.bag"
        status, text = self.run_program("map", absent, "--out", self.folder / "x")
        with self.assertRaises(urban_nav.Error) as caught:
            urban_nav.map(absent, self.folder / "x")
        self.assertEqual(caught.exception.status, status)
        self.assertIn(str(caught.exception), text)
        self.fails(2, "no option colour", urban_nav.map, absent, self.folder / "x", colour=1)
        self.fails(2, "swf_vo.windw", urban_nav.map, absent, self.folder / "x", set={"swf_vo.windw": 3})
        self.fails(2, "no value: it is a switch", urban_nav.map, absent, self.folder / "x", overwrite="yes")


def stamp_after(frame, steps=1):
    return frame.stamp_ns + steps * 50_000_000


class Functions(FolderCase):
    def test_evaluate(self):
        rows = [f"{i} {i} 0 0 0 0 0 1" for i in range(30)]
        truth, estimate = self.folder / "truth.tum", self.folder / "estimate.tum"
        truth.write_text("\n".join(rows) + "\n")
        estimate.write_text("\n".join(f"{i} {1.01 * i} 0 0 0 0 0 1" for i in range(30)) + "\n")
        self.assertLess(urban_nav.evaluate(truth, truth)["ate_m"], 1e-12)
        result = urban_nav.evaluate(truth=truth, estimate=estimate, spans="10f")
        self.assertEqual((result["frames_truth"], result["frames_matched"]), (30, 30))
        self.assertAlmostEqual(result["rpe_percent"], 1.0, places=6)
        self.fails(2, "absent.tum", urban_nav.evaluate, truth, self.folder / "absent.tum")

    def test_icp(self):
        points = np.random.default_rng(3).uniform(-5, 5, (4000, 3)) * [1, 1, 0.3]
        points[:1500, 2] = 0
        points[1500:2800, 0] = 5
        result = urban_nav.icp(points, points + [0.1, -0.05, 0.02])
        np.testing.assert_allclose(result["T_target_source"][:3, 3], [0.1, -0.05, 0.02], atol=5e-3)
        self.assertEqual((result["verdict"], result["covariance"].shape, result["free_directions"].shape), ("accepted", (6, 6), (0, 6)))
        shifted = np.eye(4)
        shifted[:3, 3] = 0.1, -0.05, 0.02
        self.assertEqual(urban_nav.icp(points, points + [0.1, -0.05, 0.02], initial=shifted)["verdict"], "accepted")
        far = np.random.default_rng(4).uniform(-5, 5, (2000, 3))
        self.assertEqual(urban_nav.icp(points, far)["verdict"], "rejected")
        self.fails(2, "n x 3", urban_nav.icp, points[:, :2], points)

    def test_relax(self):
        graph, out = self.folder / "in.g2o", self.folder / "out.g2o"
        graph.write_text("".join(f"VERTEX_SE2 {i} {i} 0 0\n" for i in range(4)) +
                         "".join(f"EDGE_SE2 {i} {i + 1} 1.1 0 0 1 0 0 1 0 1\n" for i in range(3)))
        result = urban_nav.relax(graph, out, robust="off")
        self.assertEqual((result["poses"], result["edges"], result["edges_rejected"]), (4, 3, 0))
        self.assertIn("VERTEX_SE2 3 3.3", out.read_text())
        self.assertEqual(urban_nav.relax(graph)["cost_after"]["geodesic"], result["cost_after"]["geodesic"])
        self.fails(2, "robust = maybe", urban_nav.relax, graph, robust="maybe")

    def test_disparity(self):
        rng = np.random.default_rng(1)
        wide = np.kron(rng.integers(0, 256, (40, 100)), np.ones((3, 3))).astype(np.uint8)
        wide = ((wide.astype(int) + np.roll(wide, 1, 1) + np.roll(wide, 1, 0)) // 3).astype(np.uint8)
        left, right = wide[:, 12:252], wide[:, 20:260]
        calibration = self.folder / "calib.txt"
        calibration.write_text("P0: 300 0 120 0 0 300 60 0 0 0 1 0\nP1: 300 0 120 -60 0 300 60 0 0 0 1 0\n")
        disparity, variance = urban_nav.disparity(left, right, calibration)
        self.assertEqual((disparity.dtype, disparity.shape, variance.shape), (np.float32, left.shape, left.shape))
        valid = np.isfinite(disparity)
        self.assertGreater(valid.mean(), 0.3)
        self.assertAlmostEqual(float(np.median(disparity[valid])), 8.0, delta=0.3)
        np.testing.assert_array_equal(np.isfinite(variance), valid)
        self.fails(2, "left", urban_nav.disparity, left.astype(float), right, calibration)

    def test_the_summary_is_written_where_the_caller_wants_it(self):
        truth = self.folder / "truth.tum"
        truth.write_text("\n".join(f"{i} {i} 0 0 0 0 0 1" for i in range(30)) + "\n")
        result = urban_nav.evaluate(truth, truth, json=self.folder / "result.json")
        self.assertEqual(json.loads((self.folder / "result.json").read_text()), result)


class Tables(FolderCase):
    def test_closures(self):
        table = _tables.closure_table("session_a,stamp_a_ns,session_b,stamp_b_ns,probability,kind,verdict,reason,x,weight\n"
                                      'monday,1225719878123456789,monday,7,0.5,icp,accepted,"a, b",,1\n')
        self.assertEqual(table["stamp_a_ns"][0], 1225719878123456789)
        self.assertEqual((table["kind"][0], table["reason"][0], table["weight"][0]), ("icp", "a, b", 1.0))
        self.assertTrue(np.isnan(table["x"][0]))
        self.assertEqual(len(_tables.closure_table("session_a,stamp_a_ns\n")), 0)

    def test_ply(self):
        points = np.random.default_rng(2).normal(size=(7, 3))
        _tables.write_points(self.folder / "points.ply", points, "points")
        read = _tables.read_ply(self.folder / "points.ply")
        np.testing.assert_array_equal(np.stack([read[name] for name in "xyz"], 1), points)
        (self.folder / "cut.ply").write_bytes(b"ply\nformat")
        self.fails(1, "cut.ply", _tables.read_ply, self.folder / "cut.ply")


if __name__ == "__main__":
    import rosunit
    rosunit.unitrun("urban_nav_python", "commands", "__main__")
