# SPDX-License-Identifier: BSD-3-Clause
"""What a folder may include, and how long the nodelets are."""
import re
from collections import defaultdict

# Folders of src/urban_nav/src, lowest first; folders on one line are of one level. A folder includes itself, its level
# and lower ones.
COMMAND_FOLDERS = [  # src/urban_nav/README.md, "Inside"
    ["base"],
    ["evaluation", "convert", "device"],
    ["map", "simulate"],
    ["topics"],
    ["edits"],
    ["inspect", "join"],
    ["view"],
    ["commands"],
]

# Packages of stages: what all topics of the command share does not know them.
STAGES = ["swf_vo", "fabmap_node", "loop_metric", "pose_graph", "laser_mapper", "dense_stereo", "scene_labeler", "segway_drivers",
          "laser_odometry", "urban_nav_localization"]

# Lines of a nodelet folder; of those that are longer, today's number rounded up to the next 50, which only falls.
USUAL_NODELET_LINES = 300
NODELET_LINES = {
    "dense_stereo": 400,
    "fabmap_node": 350,
    "laser_mapper": 450,
    "pose_graph": 550,
    "scene_labeler": 350,
    "segway_drivers": 1400,
    "src/urban_nav_localization": 400,
    "src/urban_nav_sim": 850,
    "swf_vo": 350,
}


def command_includes(tree):
    """A folder of the command includes none above it, so that there is no circle."""
    level = {folder: n for n, folders in enumerate(COMMAND_FOLDERS) for folder in folders}
    start = "src/urban_nav/src/"
    edges = defaultdict(set)
    for source in tree.sources:
        if not source.path.startswith(start) or "/" not in source.path[len(start):]:
            continue
        folder = source.path[len(start):].split("/")[0]
        if folder not in level:
            yield f"{source.path}: folder {folder} has no level in scripts/lint/folders.py"
            continue
        if folder == "topics":
            for other in re.findall(r'^#include "(topics/\w+)/', source.text, re.M):
                if not source.path.startswith(start + other + "/"):
                    yield f"{source.path}: a topic includes another one, {other}"
        if folder in ("base", "map"):
            for stage in re.findall(rf'^#include "({"|".join(STAGES)})/', source.text, re.M):
                yield f"{source.path}: includes the stage {stage}"
        for included in re.findall(r'^#include "(\w+)/', source.text, re.M):
            if included in level and included != folder:
                edges[folder].add(included)
                if level[included] > level[folder]:
                    yield f"{source.path}: includes {included}/, which is above"
    for folder, others in sorted(edges.items()):
        for other in sorted(others):
            if folder < other and folder in edges[other]:
                yield f"{start}: {folder} and {other} include each other"


def nodelet_includes(tree):
    """A file in a nodelet folder includes ROS, itself or by the header of its name; what does not belongs to live/."""
    ros = r'#include [<"](?:ros|nodelet|pluginlib|tf2\w*|urban_nav_ros|urban_nav_msgs|diagnostic_\w+|\w+_msgs|std_srvs|rosgraph_msgs)/'
    for source in tree.sources:
        if "/nodelet/" in source.path and "/test/" not in source.path:
            own_header = tree.text.get(source.path.replace(".cpp", ".hpp"), "")
            if not re.search(ros, source.text) and not re.search(ros, own_header):
                yield source.path


def nodelet_lines(tree):
    """A nodelet folder is short: it converts and forwards."""
    lines = defaultdict(int)
    for source in tree.sources:
        if re.match(r"(?:src/)?\w+/nodelet/", source.path):
            lines[source.path.split("/nodelet/")[0]] += source.lines
    for package, count in sorted(lines.items()):
        most = NODELET_LINES.get(package, USUAL_NODELET_LINES)
        if count > most:
            yield f"{package}/nodelet: {count} lines, at most {most}"
        elif most > max(USUAL_NODELET_LINES, -(-count // 50) * 50):
            yield f"{package}/nodelet: {count} lines, lower its limit of {most} in scripts/lint/folders.py"
