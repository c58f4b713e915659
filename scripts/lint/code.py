# SPDX-License-Identifier: BSD-3-Clause
"""Sizes of sources and functions, and what unity builds ask of names."""
import re
from collections import defaultdict

from .tree import target_of

# Functions over 60 lines that are to stay, with the reason.
LONG_FUNCTIONS = {
    # Tables: one row after another, without a branch.
    "segway_drivers/src/parameters.cpp:table": "table of parameters",
    "src/urban_nav/src/simulate/simulate_command.cpp:simulateCommand": "table of options",
    "src/urban_nav_live/include/urban_nav_live/stereo_input_parameters.hpp:withStereoInput": "table of parameters",
    "src/urban_nav_registration/src/parameters.cpp:table": "table of parameters",
    "swf_vo/src/parameters.cpp:table": "table of parameters",
    "src/urban_nav/src/topics/lasers/map_viewer_script.cpp:mapViewerScript": "one script of the page, as text",
    # Loops of a solver whose steps share most of their variables: apart, each would take ten arguments.
    "pose_graph/src/condense/solve_condensed.cpp:solveCondensed": "descent and its tests of convergence",
    "pose_graph/src/incremental/incremental_solver.cpp:IncrementalSolver::relax": "descent and its tests of convergence",
    "pose_graph/src/solve/minimise.cpp:minimise": "descent and its tests of convergence",
}


def long_lines(tree):
    """A line of C++ is at most 120 columns wide; the text of a raw string is as it is."""
    for source in tree.sources:
        text = re.sub(r'R"(\w*)\(.*?\)\1"', lambda found: '"' + "\n" * found.group(0).count("\n"), source.text, flags=re.S)
        for number, line in enumerate(text.split("\n"), 1):
            if len(line) > 120 and not line.startswith("#include"):
                yield f"{source.path}:{number}: {len(line)} columns"


def long_files(tree):
    """A source is shorter than 500 lines."""
    for name, text in tree.text.items():
        lines = text.count("\n")
        if lines >= 500 and name.endswith((".cpp", ".hpp", ".py", ".cmake")):
            yield f"{name}: {lines} lines"


def long_functions(tree):
    """A function is shorter than 60 lines."""
    for source in tree.sources:
        for name, lines in source.functions:
            if lines >= 60 and f"{source.path}:{name}" not in LONG_FUNCTIONS:
                yield f"{source.path}: {name}: {lines} lines"


def double_types(tree):
    """A type of a namespace is defined in one file."""
    files = defaultdict(set)
    for source in tree.sources:
        for space, name, unnamed in source.types:
            if not unnamed:
                files[f"{space}::{name}"].add(source.path)
    for name, where in sorted(files.items()):
        if len(where) > 1:
            yield f"{name}: {', '.join(sorted(where))}"


def unity_names(tree):
    """Names in unnamed namespaces are unique within a library or test: unity builds put several sources into one."""
    names = defaultdict(lambda: defaultdict(set))
    headers = [source for source in tree.sources if source.path.endswith(".hpp")]
    public = {(space, name): source.path for source in headers for space, _, name, _ in source.named}
    helpers = {(space, name): source.path for source in headers if "/test/" in source.path for space, _, name, _ in source.named}
    types = {(space, name) for source in headers for space, kind, name, _ in source.named if kind == "type"}
    for source in tree.sources:
        target = target_of(source.path) if source.path.endswith(".cpp") else None
        if target:
            for space, kind, name, parameters in source.unnamed:
                names[target, f"{space}::{name}"][kind.replace("outer ", ""), parameters].add(source.path)
                known = {"variable": public, "type": public, "alias": public, "outer using": types, "function": helpers}.get(kind, ())
                # A function hides those of its name in a header from callers in unnamed namespaces, unless arguments lead there.
                if (space, name) in known and (kind != "function" or target.endswith("test")):
                    yield f"{target}: {space}::{name}: {source.path}, {public[space, name]}"
    for (target, name), entries in sorted(names.items()):
        kinds = {kind for kind, _ in entries}
        if kinds == {"alias"} and len(entries) == 1:
            continue
        if kinds == {"using"} and (len(entries) == 1 or re.search(r"::[A-Z]", name)):  # types may be aliases of one another
            continue
        paths = set().union(*entries.values())
        if len(paths) > 1 and (kinds != {"function"} or any(len(p) > 1 for p in entries.values())):
            yield f"{target}: {name}: {', '.join(sorted(paths))}"


def gtest_names(tree):
    """Tests write ::testing::Test: testing:: alone is a namespace of the package wherever that has one."""
    pattern = r"(?<![:\w])testing::(?:Test|TestWithParam|TempDir|Values|ValuesIn|Bool|Combine|Range)\b"
    for source in tree.sources:
        for match in re.finditer(pattern, source.text):
            yield f"{source.path}:{source.text.count(chr(10), 0, match.start()) + 1}: {match.group(0)}"
