#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""bag.launch with loop:=true: three rounds of a recording are three sessions, the same in odometry, graph, loops and places."""
import sqlite3
import sys
from pathlib import Path

import rospy
from std_srvs.srv import SetBool

sys.path.insert(0, str(Path(__file__).resolve().parent))
from graph import camera_is_connected, connections, services  # noqa: E402
from launch_case import LaunchCase  # noqa: E402

SECONDS, ROUNDS = 8, 3
FRAMES = 20 * SECONDS


def sessions(path):
    """The ids of the sessions of a store."""
    with sqlite3.connect(f"file:{path}?mode=ro", uri=True) as store:
        return {row[0] for row in store.execute("SELECT id FROM session")}


def rows(path, table):
    """Id -> number of rows in the table, of the sessions of a store."""
    with sqlite3.connect(f"file:{path}?mode=ro", uri=True) as store:
        return dict(store.execute(f"SELECT session, COUNT(*) FROM {table} GROUP BY session"))


class RoundsLaunch(LaunchCase):
    @classmethod
    def record(cls, folder):
        for stage in ("loop_metric", "pose_graph", "fabmap_node"):
            rospy.set_param(f"/{stage}/queue_size", 10000)
        return cls.simulated(folder, SECONDS, "stereo", "ladybug", "lasers")[0]

    def announced(self):
        """Ids of the sessions that the odometry has announced, in order, with their numbers of steps."""
        ids = {}
        for message in list(self.listener.relative):
            ids[message.session.id] = ids.get(message.session.id, 0) + 1
        return ids

    def test_three_rounds_are_three_sessions_everywhere(self):
        store = Path(self.folder) / "rounds.db"
        self.launch("bag.launch", bag=self.bag, loop="true", paused="true", rviz="false", dense="false", recognise_places="true", store=store,
                    motion_input="none", rate=0.5)
        self.expect(lambda: "/player/pause_playback" in services(), "the player")
        self.expect(camera_is_connected, lambda: f"only {connections('/stereo_manager')}")
        for node in ("/pose_graph", "/fabmap_node", "/stereo_manager"):
            self.expect(lambda: {"/vo/odometry", "/vo/relative_pose"} <= connections(node), lambda: f"{node}: only {connections(node)}")
        self.assertTrue(rospy.ServiceProxy("/player/pause_playback", SetBool)(False).success)
        self.expect(lambda: len(self.announced()) > ROUNDS, lambda: f"sessions: {self.announced()}", seconds=900)
        self.assertEqual(self.launched.stop(), "")
        self.launched = None

        announced = self.announced()
        rounds = list(announced)[:ROUNDS]
        self.assertNotIn("", announced)
        for session in rounds:
            self.assertEqual(announced[session], FRAMES - 1, f"each pair of each round: {announced}")
        starts = {message.session.start for message in self.listener.relative}
        self.assertEqual(len(starts), 1, "each round begins at the same time")
        for name in (store, f"{store}.loops", f"{store}.places"):
            kept = sessions(name)
            self.assertLessEqual(set(rounds), kept, f"{name}: {kept}")
            self.assertLessEqual(kept, set(announced), f"{name} has sessions that the odometry has not: {kept}")
        for name in (store, f"{store}.loops"):
            poses = rows(name, "node")
            for session in rounds:
                self.assertEqual(poses[session], FRAMES, f"{name}: {poses}")
        # The round that was interrupted: what the window of the odometry still held has come to the graph.
        last, frames = list(announced)[-1], list(self.listener.frames)
        begin = max(k for k, frame in enumerate(frames) if frame.frame == 0)
        self.assertEqual(announced[last], len(frames) - begin - 1)
        self.assertEqual(rows(store, "node").get(last), len(frames) - begin, store)


if __name__ == "__main__":
    import rostest
    rostest.rosrun("urban_nav_launch", "rounds_launch", RoundsLaunch)
