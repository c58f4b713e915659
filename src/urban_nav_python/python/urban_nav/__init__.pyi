# SPDX-License-Identifier: BSD-3-Clause
import os
from typing import Any, Iterator, NamedTuple, Sequence

__all__: list[str]

_Path = str | os.PathLike[str]

class Error(RuntimeError):
    status: int
    def __init__(self, text: str, status: int = 2) -> None: ...

class Message:
    _type: str
    def __getattr__(self, name: str) -> Any: ...

class Topic(NamedTuple):
    type: str
    encoding: str
    definition: str
    messages: int

class Recording:
    path: str
    def __init__(self, path: _Path) -> None: ...
    def __iter__(self) -> Iterator[tuple[str, int, Message]]: ...
    @property
    def kind(self) -> str: ...
    @property
    def topics(self) -> dict[str, Topic]: ...
    @property
    def start_ns(self) -> int: ...
    @property
    def end_ns(self) -> int: ...
    @property
    def warnings(self) -> list[str]: ...
    def messages(self, topics: str | Sequence[str] | None = None, start_ns: int | None = None, end_ns: int | None = None,
                 order: str = "file", raw: bool = False) -> Iterator[tuple[str, int, Any]]: ...
