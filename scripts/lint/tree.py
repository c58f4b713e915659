# SPDX-License-Identifier: BSD-3-Clause
"""The files under version control, and what they belong to."""
import re
import subprocess
from pathlib import Path

from .source import Source

ROOT = Path(__file__).resolve().parent.parent.parent


def target_of(path):
    """The library or program that compiles a source, None for those that compile alone."""
    parts = Path(path).parts
    package, rest = (parts[1], parts[2:]) if parts[0] == "src" else (parts[0], parts[1:])
    if not rest or rest[0] in ("tools", "include") or rest[-1] == "main.cpp":
        return None
    if rest[0] in ("bench", "testing") and len(rest) == 2:
        return None if rest[0] == "bench" else f"{package} testing"
    if rest[:2] == ("testing", "programs"):
        return None
    return f"{package} {'rostest' if rest[:2] == ('test', 'ros') else rest[0]}"


def package_of(path):
    """The folder of the package that a file belongs to."""
    parts = path.split("/")
    return "/".join(parts[:2] if parts[0] == "src" else parts[:1])


def is_product(path):
    """Whether a file is part of what users run: not of tests, their support, benches or scripts."""
    return not re.search(r"(?:^|/)(?:test|testing|bench|scripts|tools)/", path)


class Tree:
    """The files under version control."""

    def __init__(self, root=ROOT):
        self.root = root
        names = subprocess.run(["git", "ls-files", "-z"], cwd=root, capture_output=True, text=True, check=True).stdout.split("\0")
        self.files = [name for name in names if name and (root / name).is_file()]
        self.text = {f: (root / f).read_text(errors="replace") for f in self.files
                     if f.endswith((".cpp", ".hpp", ".py", ".md", ".msg", ".srv", ".cmake", ".txt", ".sh", ".launch", ".test", ".yaml", ".xml"))}
        self.sources = [Source(f, text) for f, text in self.text.items() if f.endswith((".cpp", ".hpp"))]
