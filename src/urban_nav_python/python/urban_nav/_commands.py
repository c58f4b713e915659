# SPDX-License-Identifier: BSD-3-Clause
"""Commands as functions: their options are keyword arguments, with `_` for `-`."""
import json
import logging
import os
import tempfile
from pathlib import Path

import numpy as np

from ._error import Error
from ._tables import closure_table, read_pfm, write_points

_log = logging.getLogger("urban_nav")
_LEVELS = (logging.INFO, logging.INFO, logging.WARNING, logging.ERROR)


def _line(kind, text):
    _log.log(_LEVELS[kind], "%s", text.rstrip("\n"))


def _word(value):
    """A value as the command line has it."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    raise Error(f"{value!r}: expected a text, a path or a number")


def _words(name, value):
    """The values of one option; None if it is not given."""
    if value is None or value is False:
        return None
    if isinstance(value, dict):
        sign = ":=" if name == "topic" else "="
        return [f"{key}{sign}{_word(each)}" for key, each in value.items()]
    if isinstance(value, (list, tuple, np.ndarray)):
        return [_word(each) for each in value]
    return [_word(value)]


def _paths(inputs):
    return [_word(inputs)] if isinstance(inputs, (str, os.PathLike)) else [_word(each) for each in inputs]


def _run(command, positional, options, progress=None):
    """Runs a command. `positional`: {name: [words]}. Returns the exit status."""
    from . import _suite

    arguments = dict(positional)
    for name, value in options.items():
        key = name.replace("_", "-")
        words = _words(key, value)
        if words is not None:
            arguments[key] = words
    return _suite.run(command, arguments, _line, progress)


def _with_json(command, positional, options, progress=None):
    """Runs a command and returns its output of --json."""
    with tempfile.TemporaryDirectory(prefix="urban_nav-") as folder:
        path = options.get("json") or os.path.join(folder, "summary.json")
        _run(command, positional, {**options, "json": path}, progress)
        return json.loads(Path(path).read_text(encoding="utf-8"))


def map(inputs, out, *, progress=None, **options):  # noqa: A001
    """Turns recordings into a trajectory with covariance, a map and a report, as `urban_nav map` does; the files have the same bytes.

    `inputs`: a recording or a folder, or a list of them. `out`: the folder to write into. `progress`: called as f(stage, done, total)
    at most 20 times a second; total 0 is unknown. Further options are those of the command (`urban_nav map --help`):
    `stages="vo,graph"`, `threads=1`, `overwrite=True`, `topic={"left": "/cam0/image_raw"}`, `set={"swf_vo.window": 25}`.

    Returns the content of summary.json as a dict (lengths in m, times in s where the key ends in _s, ms in _ms). Throws Error as the
    command fails; an exception of `progress` and Ctrl-C (KeyboardInterrupt) end the run, which resumes when it is called again.
    """
    _run("map", {"INPUT": _paths(inputs), "out": [_word(out)]}, options, progress)
    return json.loads((Path(out) / "summary.json").read_text(encoding="utf-8"))


def evaluate(truth, estimate, **options):
    """Compares a trajectory with the truth, as `urban_nav evaluate` does.

    `truth`, `estimate`: files (.tum, .kitti, .csv of EuRoC). Options are those of the command: `spans="10f,100m"`,
    `find_offset=True`, `covariance="covariance.csv"`. Returns a dict with the keys of `--json`: `ate_m` (m, first poses aligned),
    `ate_se3_m`, `ate_sim3_m`, `rpe_percent`, `rpe_deg_per_m`, `nees_mean`, `frames_matched`, ...
    """
    return _with_json("evaluate", {"truth": [_word(truth)], "estimate": [_word(estimate)]}, options)


def icp(source, target, **options):
    """Aligns two clouds, as `urban_nav icp` does.

    `source`, `target`: files (PLY, PCD, LAS, CSV), or arrays n x 3 (m). Options are those of the command: `global_=True` (a keyword of
    Python with `_` after it), `initial="T.txt"` or a 4 x 4 matrix, `set={...}`. Returns a dict with the keys of `--json`, as arrays:
    `T_target_source` 4 x 4 (m), `covariance` and `information` 6 x 6 (tangent translation, rotation, in the axes of target),
    `free_directions` k x 6 (unit vectors), `verdict` ("accepted", "degenerate", "rejected") and `reason`. A rejected alignment is
    no error.
    """
    options = {name.rstrip("_"): value for name, value in options.items()}
    with tempfile.TemporaryDirectory(prefix="urban_nav-") as folder:
        clouds = []
        for name, cloud in (("source", source), ("target", target)):
            if not isinstance(cloud, (str, os.PathLike)):
                path = os.path.join(folder, name + ".ply")
                write_points(path, cloud, name)
                cloud = path
            clouds.append(_word(cloud))
        initial = options.get("initial")
        if initial is not None and not isinstance(initial, (str, os.PathLike)):
            options["initial"] = os.path.join(folder, "initial.txt")
            rows = np.asarray(initial, dtype=float)
            if rows.shape != (4, 4):
                raise Error(f"initial has the shape {rows.shape}: expected 4 x 4")
            Path(options["initial"]).write_text("\n".join(" ".join(repr(float(x)) for x in row) for row in rows) + "\n", encoding="utf-8")
        result = _with_json("icp", {"SOURCE": [clouds[0]], "TARGET": [clouds[1]]}, options)
    result["T_target_source"] = np.array(result["T_target_source"], dtype=float).reshape(4, 4)
    for key in ("covariance", "information"):
        result[key] = np.array([np.nan if x is None else x for x in result[key]], dtype=float).reshape(6, 6)
    result["free_directions"] = np.array(result["free_directions"], dtype=float).reshape(-1, 6)
    return result


def relax(graph, out=None, **options):
    """Optimises a pose graph, as `urban_nav relax` does.

    `graph`: a file of g2o or TORO. `out`: the file to write with the relaxed poses; None: only the summary is of interest. Options
    are those of the command: `robust="off"`, `objective="chordal"`, `edges="edges.csv"`, `covariance="covariance.csv"`. Returns a dict
    with the keys of `--json`: `poses`, `edges`, `edges_rejected`, `cost_before` and `cost_after` (each `geodesic`, `chordal`, `g2o`),
    `ms_batch`, `ending`, `scales`, `warnings`.
    """
    with tempfile.TemporaryDirectory(prefix="urban_nav-") as folder:
        written = os.path.join(folder, "relaxed.g2o") if out is None else _word(out)
        return _with_json("relax", {"IN": [_word(graph)], "output": [written]}, options)


def disparity(left, right, calibration, **options):
    """Matches one stereo pair densely, as `urban_nav disparity` does.

    `left`, `right`: image files, or arrays H x W (uint8, grey). `calibration`: KITTI's calib.txt, or "LEFT.yaml,RIGHT.yaml", or the two
    paths. Options are those of the command: `method="paper"`, `rectified=True`. Returns (disparity, variance), float32, H x W: px and
    px2 of the left image, NaN where invalid.
    """
    with tempfile.TemporaryDirectory(prefix="urban_nav-") as folder:
        images = []
        for name, image in (("left", left), ("right", right)):
            if not isinstance(image, (str, os.PathLike)):
                pixels = np.ascontiguousarray(image)
                if pixels.ndim != 2 or pixels.dtype != np.uint8:
                    raise Error(f"{name}: an array {pixels.shape} of {pixels.dtype}: expected H x W of uint8, or a file")
                image = os.path.join(folder, name + ".pgm")
                Path(image).write_bytes(b"P5\n%d %d\n255\n" % (pixels.shape[1], pixels.shape[0]) + pixels.tobytes())
            images.append(_word(image))
        files = os.path.join(folder, "disparity.pfm"), os.path.join(folder, "variance.pfm")
        _run("disparity", {"LEFT": [images[0]], "RIGHT": [images[1]], "calibration": [",".join(_paths(calibration))],
                           "output": [files[0]], "variance": [files[1]]}, options)
        return read_pfm(files[0]), read_pfm(files[1])


def places(model, inputs, *, progress=None, **options):
    """The most likely earlier place of every image, as `urban_nav places query` finds it.

    `model`: a file of `places train`, or "default". `inputs`: folders of images or recordings, consecutive sessions. Options are those
    of the command: `threshold=0.99`, `mask=20`. Returns a structured array with the columns of closures.csv: a is the earlier place, b
    the query; stamps in ns; verdict "accepted" above the threshold.
    """
    with tempfile.TemporaryDirectory(prefix="urban_nav-") as folder:
        path = os.path.join(folder, "closures.csv")
        _run("places query", {"MODEL": [_word(model)], "SRC": _paths(inputs), "output": [path]}, options, progress)
        return closure_table(Path(path).read_text(encoding="utf-8"))
