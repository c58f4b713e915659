# SPDX-License-Identifier: BSD-3-Clause
"""The recordings in a folder. Snakemake reads this at each start, so that nothing is opened beyond its first bytes."""
import json
import os
import shlex
import sqlite3
from pathlib import Path

ENDINGS = {".bag", ".mcap", ".db3", ".zst", ".active"}  # of recordings; NAME is that of the file without them
MAGIC = {b"#ROSBAG V": ".bag", b"\x89MCAP0\r\n": ".mcap", b"\x28\xb5\x2f\xfd": ".zst"}
SQLITE = b"SQLite format 3\0"
# What a folder of a recording holds: rosbag2, EuRoC, KITTI, New College.
FOLDER_PARTS = ("metadata.yaml", "mav0", "image_0", "image_00", "velodyne", "velodyne_points", "StereoImages")


def find_program(workflow_folder):
    """The command of the repository that holds the workflow, as a word of a shell; else the one on the path."""
    program = Path(workflow_folder).resolve().parent / "urban_nav"
    return shlex.quote(str(program)) if program.is_file() and os.access(program, os.X_OK) else "urban_nav"


def is_rosbag2(path):
    """Whether an SQLite file has the tables of rosbag2; session stores have others."""
    try:
        with sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro&immutable=1", uri=True) as database:
            tables = {name for name, in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        return {"topics", "messages"} <= tables
    except sqlite3.Error:
        return path.suffix == ".db3"  # a damaged one


def is_recording_file(path):
    with path.open("rb") as file:
        begin = file.read(16)
    if begin.startswith(SQLITE):
        return is_rosbag2(path)
    return any(begin.startswith(magic) for magic in MAGIC) or path.suffix in ENDINGS


def is_recording(path):
    """Whether `map` reads this file or folder; also a file of which only the ending is left of a recording."""
    if path.is_file():
        return is_recording_file(path)
    if not path.is_dir() or path.name.endswith(".truth"):
        return False
    if any((path / part).exists() for part in FOLDER_PARTS):
        return True
    return sum(is_recording_file(file) for file in path.iterdir() if file.is_file()) == 1


def name_of(path):
    """NAME of a recording: without its endings (drive.bag, drive.db3.zst); of a folder its whole name."""
    if path.is_dir():
        return path.name
    name = path.name
    while Path(name).suffix in ENDINGS:
        name = Path(name).stem
    return name


def find_recordings(folder):
    """Returns {NAME: path}, in the order of the names. Raises ValueError naming what is wrong."""
    folder = Path(str(folder))
    if not folder.is_dir():
        raise ValueError(f"recordings={folder}: expected a folder of recordings, found none")
    found = {}
    for path in sorted(folder.iterdir()):
        if path.name.startswith(".") or not is_recording(path):
            continue
        name = name_of(path)
        if name in found:
            raise ValueError(f"{path}: expected a name of its own without ending, found {found[name]} as well")
        found[name] = str(path)
    if not found:
        raise ValueError(f"recordings={folder}: expected recordings in it, found none")
    return found


def planned_pieces(plan):
    """Returns the names of the pieces of a plan of `urban_nav join`."""
    return json.loads(Path(plan).read_text())["pieces"]
