# SPDX-License-Identifier: BSD-3-Clause
"""What the programs of this folder share: simulated drives, those of the default model and others, and the command."""
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
LEAST_RETURNS = 500  # a class with fewer in the truth is not scored


def urban_nav(*words):
    done = subprocess.run([str(word) for word in (COMMAND, *words)], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"urban_nav {' '.join(map(str, words))}:\n{done.stderr[-2000:]}")


def truth(bag):
    """The folder of a bag's truth."""
    return bag.with_suffix(".truth")


def simulated(folder, world, seed, route, day, seconds):
    """A drive as a bag; what is there already is taken."""
    bag = Path(folder) / f"{world}_{seed}_{day}.bag"
    if not bag.exists():
        print(f"drives {bag.stem} for {seconds} s", file=sys.stderr, flush=True)
        urban_nav("simulate", "--world", world, "--seed", seed, "--route", route, "--day", day, "--duration", seconds, "--sensors", "ladybug,lasers",
                  "--views", "lasers", "-o", bag)
    return bag


def training_drives(folder, world=None):
    """The bags that the default model is made from, all of them or those of a world."""
    rows = re.findall(r'"(\w+) (\d+) (\w+) (\d+) (\d+)"', MODEL_SCRIPT.read_text())
    return [simulated(folder, *row) for row in rows if world in (None, row[0])]


def with_poses(bags):
    """Bags, and their true trajectories, as words of a command."""
    return [*bags, *(word for bag in bags for word in ("--trajectory", truth(bag) / "trajectory.tum"))]


def model_without(folder, world):
    """A model of the drives in the other worlds."""
    model = Path(folder) / f"without_{world}.labels"
    if not model.exists():
        bags = [bag for other in WORLDS if other != world for bag in training_drives(folder, other)]
        urban_nav("labels", "train", *with_poses(bags), "--set", "scene_labeler.samples=16000", "-o", model)
    return model


def evaluated(model, bags):
    """What `labels evaluate` says of a model on some bags."""
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        urban_nav("labels", "evaluate", model, *with_poses(bags), "--json", out.name)
        return json.loads(Path(out.name).read_text())


def scored_classes(result):
    """Names of the classes with enough returns."""
    return [name for name, one in result["classes"].items() if one["points"] >= LEAST_RETURNS]


def f1_of(rows, k):
    """F1 of the class at place k of a confusion, %."""
    stated, true = sum(row[k] for row in rows), sum(rows[k])
    return 200 * rows[k][k] / max(1, stated + true)
