# SPDX-License-Identifier: BSD-3-Clause
"""Recordings as iterators of messages."""
import os
from typing import NamedTuple

from ._message import make_type


class Topic(NamedTuple):
    """A topic of a recording: `type` in the form of ROS 1 ("sensor_msgs/Image"), `encoding` of its messages ("ros1", "cdr", or another
    one), `definition` of the type as the recording holds it, number of `messages`."""

    type: str
    encoding: str
    definition: str
    messages: int


class Recording:
    """A ROS 1 bag, an MCAP file, a `.db3` or a folder of rosbag2, recognised by content. It is only read.

    `topics`: {name: Topic}; `start_ns`, `end_ns`: receipt of the first and the last message, ns; `kind`: "bag", "mcap", "db3" or
    "rosbag2"; `warnings`: what is missing or damaged, as far as it was met by now. Iterating is messages(). Throws Error for what is
    not a recording. Memory is bounded: an entry for each message, and the chunk in use.
    """

    def __init__(self, path):
        from . import _input

        self.path = os.fspath(path)
        self._reader = _input.OpenRecording(self.path, make_type)
        self._topics = None

    def __repr__(self):
        return f"Recording({self.path!r})"

    def __iter__(self):
        return self.messages()

    @property
    def kind(self):
        """The storage: "bag", "mcap", "db3" or "rosbag2"."""
        return self._reader.kind()

    @property
    def topics(self):
        """{name: Topic}, by name."""
        if self._topics is None:
            self._topics = {name: Topic(*rest) for name, *rest in self._reader.topics()}
        return dict(self._topics)

    @property
    def start_ns(self):
        """Receipt of the first message, ns; 0 without messages."""
        return self._reader.start_ns()

    @property
    def end_ns(self):
        """Receipt of the last message, ns; 0 without messages."""
        return self._reader.end_ns()

    @property
    def warnings(self):
        """Missing or damaged parts of the files that were read so far, as a list of sentences."""
        return self._reader.warnings()

    def messages(self, topics=None, start_ns=None, end_ns=None, order="file", raw=False):
        """Iterates over (topic, receipt_ns, message).

        `topics`: names, or one name; all by default. `start_ns`, `end_ns`: only messages received in [start_ns, end_ns), ns. `order`:
        "file", which is that of receipt, or "header", that of the stamps in the headers (receipt where a message has none), which
        reads the recording twice. `raw`: the encoded bytes as a memoryview in place of a Message.

        Throws Error for a topic that is not there, and for a named one whose messages cannot be decoded; of all topics, those are
        left out with a RuntimeWarning that gives the reason. Messages are valid for as long as they are kept.
        """
        from ._error import Error

        if order not in ("file", "header"):
            raise Error(f"order = {order}: expected file, header")
        if isinstance(topics, str):
            topics = [topics]
        names = None if topics is None else list(topics)
        return self._reader.messages(names, start_ns, end_ns, order == "header", raw)
