# SPDX-License-Identifier: BSD-3-Clause
"""Navigation and mapping from a robot's recordings: the suite urban_nav in Python.

    import urban_nav

    for topic, receipt_ns, message in urban_nav.Recording("session.mcap").messages(topics=["/imu/data"]):
        ...
    summary = urban_nav.map("session.mcap", "out")
    stamps_ns, T_map_base = urban_nav.Store("out/session.db").trajectory()

Conventions: SI units; stamps are int ns; T_a_b is a 4 x 4 matrix that takes coordinates of frame b to frame a; covariances have the
tangent (translation, rotation) in the axes of the parent frame. Lines that the command would print go to the logger `urban_nav`.
"""
from ._commands import disparity, evaluate, icp, map, places, relax  # noqa: A004
from ._error import Error
from ._estimators import Frame, Relaxation, Vo
from ._message import Message
from ._recording import Recording, Topic
from ._store import Keyframe, Session, Store

__all__ = ["Error", "Frame", "Keyframe", "Message", "Recording", "Relaxation", "Session", "Store", "Topic", "Vo",
           "disparity", "evaluate", "icp", "map", "places", "relax"]
