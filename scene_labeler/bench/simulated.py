# SPDX-License-Identifier: BSD-3-Clause
"""Functions shared by the programs of this folder: simulated drives, models trained on them, and calls of urban_nav."""
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
MODEL_SCRIPT = TOP / "src/urban_nav/bench/default_labels_model.sh"
WORLDS = ("quad", "begbroke", "street")
COMMAND = os.environ.get("URBAN_NAV", TOP / "urban_nav")
LEAST_RETURNS = 500  # classes with fewer true returns are not scored


def urban_nav(*words):
    done = subprocess.run([str(word) for word in (COMMAND, *words)], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"urban_nav {' '.join(map(str, words))}:\n{done.stderr[-2000:]}")


def truth(bag):
    """Returns the folder of a bag's ground truth."""
    return bag.with_suffix(".truth")


def simulated(folder, world, seed, route, day, seconds):
    """Returns the bag of a drive; simulates it unless it exists."""
    bag = Path(folder) / f"{world}_{seed}_{day}.bag"
    if not bag.exists():
        print(f"drives {bag.stem} for {seconds} s", file=sys.stderr, flush=True)
        urban_nav("simulate", "--world", world, "--seed", seed, "--route", route, "--day", day, "--duration", seconds, "--sensors", "ladybug,lasers",
                  "--views", "lasers", "-o", bag)
    return bag


def training_drives(folder, world=None):
    """Returns the bags on which the default model is trained: all, or those of one world."""
    rows = re.findall(r'"(\w+) (\d+) (\w+) (\d+) (\d+)"', MODEL_SCRIPT.read_text())
    return [simulated(folder, *row) for row in rows if world in (None, row[0])]


def with_poses(bags):
    """Returns arguments of a command: bags and their true trajectories."""
    return [*bags, *(word for bag in bags for word in ("--trajectory", truth(bag) / "trajectory.tum"))]


def model_without(folder, world):
    """Returns a model trained on the drives of the other worlds; trains it unless it exists."""
    model = Path(folder) / f"without_{world}.labels"
    if not model.exists():
        bags = [bag for other in WORLDS if other != world for bag in training_drives(folder, other)]
        urban_nav("labels", "train", *with_poses(bags), "--set", "scene_labeler.samples=16000", "-o", model)
    return model


def evaluated(model, bags):
    """Returns the result of `labels evaluate` of a model on some bags."""
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        urban_nav("labels", "evaluate", model, *with_poses(bags), "--json", out.name)
        return json.loads(Path(out.name).read_text())


def scored_classes(result):
    """Returns the names of the classes with enough returns."""
    return [name for name, one in result["classes"].items() if one["points"] >= LEAST_RETURNS]


def f1_of(rows, k):
    """Returns the F1 score of class k of a confusion matrix, %."""
    stated, true = sum(row[k] for row in rows), sum(rows[k])
    return 200 * rows[k][k] / max(1, stated + true)
