# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of robots in Python.

    import urban_nav

    for topic, receipt_ns, message in urban_nav.Recording("session.mcap").messages(topics=["/imu/data"]):
        ...

Conventions: SI units; stamps are int ns.
"""
from ._error import Error
from ._message import Message
from ._recording import Recording, Topic

__all__ = ["Error", "Message", "Recording", "Topic"]
