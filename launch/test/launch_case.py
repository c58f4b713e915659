# SPDX-License-Identifier: BSD-3-Clause
"""The case from which the tests of launch files derive: a bag for all of them, and for each a listener and what it launched."""
import shutil
import tempfile
import unittest

import rospy

from graph import Launched, Listener, make_bag, until

PATIENCE = 90.0  # seconds for what takes two on an idle machine; a test that passes does not wait for them to end


class LaunchCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node(cls.__name__, disable_signals=True)
        # Not a frame may be dropped on a machine that is busy: bits are compared, and frames counted.
        rospy.set_param("/swf_vo/queue", 100000)
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.bag = make_bag(cls.folder)

    def setUp(self):
        self.listener = Listener()
        self.launched = None

    def tearDown(self):
        if self.launched:
            self.assertEqual(self.launched.stop(), "")
        self.listener.close()
        self.assertEqual(self.listener.errors, [])

    def launch(self, file, **arguments):
        self.launched = Launched(file, **arguments)

    def expect(self, so, what="", seconds=PATIENCE):
        """Waits until it is so; `what` is a text, or a function that makes one of how far it came."""
        if not until(so, seconds):
            self.fail(f"{what() if callable(what) else what}\n{self.launched.output() if self.launched else ''}")
