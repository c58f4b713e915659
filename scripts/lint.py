#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Holds the sources against the rules of the house; prints each breach, or the count of a rule that does not hold yet.

Exit status 0 if no enforced rule is broken. `--all` prints the breaches of the others as well; `--rule NAME` looks at one.
"""
import argparse
import re
import subprocess
import sys
from collections import Counter, defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# The rules that hold. A breach fails the run; every other rule of RULES is counted only.
ENFORCED = {"long_files", "long_lines", "unity_names", "gtest_names", "command_includes", "of_functions",
            "word_counts", "old_names", "nodelet_includes", "long_functions"}

# Functions over 60 lines that are to stay, with the reason.
LONG_FUNCTIONS = {
    # Tables: one row after another, without a branch.
    "segway_drivers/src/parameters.cpp:table": "table of parameters",
    "src/urban_nav/src/simulate/simulate_command.cpp:simulateCommand": "table of options",
    "src/urban_nav_live/include/urban_nav_live/stereo_input_parameters.hpp:withStereoInput": "table of parameters",
    "src/urban_nav_registration/src/parameters.cpp:table": "table of parameters",
    "src/urban_nav/src/topics/lasers/map_viewer_script.cpp:mapViewerScript": "one script of the page, as text",
    # Loops of a solver whose steps share most of their variables: apart, each would take ten arguments.
    "pose_graph/src/condense/solve_condensed.cpp:solveCondensed": "descent and its tests of convergence",
    "pose_graph/src/incremental/incremental_solver.cpp:IncrementalSolver::relax": "descent and its tests of convergence",
    "pose_graph/src/solve/minimise.cpp:minimise": "descent and its tests of convergence",
}

# Folders of src/urban_nav/src, lowest first; folders on one line are of one level. A folder includes itself, its level
# and lower ones.
COMMAND_FOLDERS = [  # src/urban_nav/README.md, "Inside"
    ["base"],
    ["evaluation", "convert", "device"],
    ["map", "simulate"],
    ["topics"],
    ["inspect"],
    ["commands"],
]

STAGES = ["swf_vo", "fabmap_node", "loop_metric", "pose_graph", "laser_mapper", "dense_stereo", "scene_labeler", "segway_drivers",
          "urban_nav_localization"]

NODELET_LINES = {"swf_vo": 300, "pose_graph": 500, "loop_metric": 500}
WORDS = ["behind", "nobody", "somebody", "felt", "told", "heard", "believe"]
MOST_OF_A_WORD, MOST_OF_FUNCTIONS, MOST_README_WORDS = 15, 20, 2500


class Source:
    """A C++ file as its declarations: types and functions with their namespace and lines, and names in unnamed namespaces."""

    def __init__(self, path, text):
        self.path = path
        self.text = text
        self.lines = text.count("\n")
        self.types = []  # (namespace path, name, is in an unnamed namespace)
        self.functions = []  # (name, lines)
        self.unnamed = []  # (namespace path, kind, name, parameters)
        self.named = []  # the same of named namespaces
        _scan(_without_comments(text), self)


def _without_comments(text):
    """The text with comments, strings, characters and preprocessor lines emptied, line by line as long as before."""
    pattern = r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|(?<![0-9A-Fa-f])\'(?:[^\'\\\n]|\\.)*\'|^[ \t]*#(?:[^\n\\]|\\.|\\\n)*'

    def emptied(match):
        found = match.group(0)
        return ('""' if found[0] in '"R' else "0" if found[0] == "'" else "") + "\n" * found.count("\n")

    return re.sub(pattern, emptied, text, flags=re.S | re.M)


def _scan(code, source):
    """Walks along the braces of the code and notes what is declared outside of functions."""
    scopes = []  # (kind, name, line where it began)
    head, line, at = "", 1, 0
    depth_inside = 0  # braces within a function or an initialiser
    for match in re.finditer(r"[{};]|\n", code):
        token = match.group(0)
        if depth_inside == 0:
            head += code[at:match.start()] + ("\n" if token == "\n" else "")
        at = match.end()
        if token == "\n":
            line += 1
        elif depth_inside > 0:
            depth_inside += {"{": 1, "}": -1, ";": 0}[token]
            if depth_inside == 0 and scopes[-1][0] == "function":
                _, name, begin = scopes.pop()
                source.functions.append((name, line - begin + 1))
                head = ""
            elif depth_inside == 0:
                scopes.pop()
                head += "{}"
        elif token == "{":
            words = " ".join(head.split())
            kind, name = _opened(words, head)
            begin = line - head.lstrip().count("\n")
            if kind in ("function", "value"):
                if kind == "function":
                    _note(words + " {}", scopes, source)
                depth_inside = 1
            else:
                if kind == "type":
                    _note_type(name, scopes, source)
                head = ""
            scopes.append((kind, name, begin))
        elif token == "}":
            if scopes:
                scopes.pop()
            head = ""
        else:
            _note(" ".join(head.split()), scopes, source)
            head = ""


def _opened(words, head):
    """(kind, name) of what a brace opens after these words: namespace, type, function or value."""
    match = re.match(r"(?:inline )?namespace(?: ([\w:]+))?$", words)
    if match:
        return "namespace", match.group(1) or ""
    if words == 'extern ""':
        return "namespace", "C"
    plain = re.sub(r"^(?:(?:public|private|protected) ?: ?)+", "", words)
    plain = re.sub(r"^(?:template ?<(?:[^<>]|<[^<>]*>)*> ?)+", "", plain)
    match = re.match(r"(?:class|struct|union|enum(?: class| struct)?)\b(?: alignas ?\([^)]*\))? ?([\w:]*)", _without_arguments(plain))
    if match and "(" not in plain.replace("alignas(", "").split(":")[0] and "=" not in plain:
        return "type", match.group(1)
    if "(" in plain and not (head[-1:].strip() and head[-1] not in ")}") and not re.search(r"[=,({] ?$", plain):
        return "function", _function_name(plain)
    return "value", ""


def _without_arguments(words):
    """The words without arguments of templates."""
    while (plain := re.sub(r"<[^<>]*>", "", words)) != words:
        words = plain
    return words


def _function_name(words):
    match = re.search(r"([\w:~]+|operator ?[^\s(]+)(?:<[^<>()]*>)? ?\(", _without_arguments(words))
    return match.group(1) if match else "?"


def _spaces(scopes):
    """(path, is unnamed) of the namespaces around; None inside a type."""
    if any(kind != "namespace" for kind, _, _ in scopes):
        return None
    names = [name for _, name, _ in scopes]
    return "::".join(name for name in names if name), "" in names


def _note_type(name, scopes, source):
    if not name:
        return
    unnamed = any(kind == "namespace" and not scope for kind, scope, _ in scopes)
    path = "::".join(scope for _, scope, _ in scopes if scope)
    source.types.append((path, name, unnamed))
    spaces = _spaces(scopes)
    if spaces:
        (source.unnamed if spaces[1] else source.named).append((spaces[0], "type", name, ""))


def _note(words, scopes, source):
    """A function or a variable outside of types; of unnamed namespaces alone."""
    spaces = _spaces(scopes)
    match = re.match(r"using (?:[\w]+::)+(\w+)$", words)
    if spaces and match:
        source.unnamed.append((spaces[0], "using" if spaces[1] else "outer using", match.group(1), words))
    match = re.match(r"using (\w+) = (.*)$", words)
    if spaces and match:
        (source.unnamed if spaces[1] else source.named).append((spaces[0], "alias", match.group(1), match.group(2)))
    if not spaces or re.match(r"(using|namespace|typedef|TEST|INSTANTIATE|TYPED|static_assert|friend|template class)\b|TEST_", words):
        return
    names = source.unnamed if spaces[1] else source.named
    plain = re.sub(r"^(?:template ?<(?:[^<>]|<[^<>]*>)*> ?)+", "", words)
    if re.match(r"(?:class|struct|enum)\b[^({=]*$", plain):
        return  # a declaration in advance
    shorter = re.sub(r"<[^<>=]*>", lambda found: "_" * len(found.group(0)), plain)
    bracket, equals = shorter.find("("), plain.find("=")
    if 0 <= bracket and (equals < 0 or bracket < equals) and not re.match(r"[^(]*\w ?\{", plain):
        name = _function_name(plain)
        if re.match(r"k[A-Z]", name):  # a constant with arguments
            names.append((spaces[0], "variable", name, ""))
        elif "::" not in name and (plain.endswith("{}") or not spaces[1]):
            names.append((spaces[0], "function", name, _parameters(plain[bracket + 1:])))
        return
    for declarator in _split(plain):
        match = re.search(r"([\w:]+) ?(?:\[[^\]]*\] ?)*(?:\{.*)?$", declarator.split("=")[0].strip())
        if match and "::" not in match.group(1):
            names.append((spaces[0], "variable", match.group(1), ""))


def _split(words):
    """The parts between commas outside of brackets, up to the bracket that closes what is around them."""
    depth, parts, part = 0, [], ""
    for c in words:
        if c in "(<[{":
            depth += 1
        elif c in ")>]}":
            depth -= 1
            if depth < 0:
                break
        if c == "," and depth == 0:
            parts.append(part)
            part = ""
        else:
            part += c
    return parts + [part]


def _parameters(words):
    """The types of parameters, from what stands after the opening bracket."""
    parts = _split(words)
    return ", ".join(re.sub(r"(?<=[\w>&*\]]) ?\b\w+$", "", p.split("=")[0].strip()) if " " in p.strip() or "&" in p else p.strip() for p in parts)


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


class Tree:
    """The files under version control."""

    def __init__(self, root=ROOT):
        self.root = root
        names = subprocess.run(["git", "ls-files", "-z"], cwd=root, capture_output=True, text=True, check=True).stdout.split("\0")
        self.files = [name for name in names if name and (root / name).is_file()]
        self.text = {f: (root / f).read_text(errors="replace") for f in self.files
                     if f.endswith((".cpp", ".hpp", ".py", ".md", ".msg", ".srv", ".cmake", ".txt", ".sh", ".launch", ".test", ".yaml", ".xml"))}
        self.sources = [Source(f, text) for f, text in self.text.items() if f.endswith((".cpp", ".hpp"))]


def long_lines(tree):
    """A line of C++ is at most 120 columns wide, unless it holds a string: these are not broken."""
    for source in tree.sources:
        text = re.sub(r'R"(\w*)\(.*?\)\1"', lambda found: '"' + "\n" * found.group(0).count("\n"), source.text, flags=re.S)
        for number, line in enumerate(text.split("\n"), 1):
            if len(line) > 120 and not line.startswith("#include") and '"' not in line:
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
            yield f"{source.path}: folder {folder} has no level in {Path(__file__).name}"
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


def long_readmes(tree):
    """A README has at most 2500 words."""
    for name, text in tree.text.items():
        if name.endswith("README.md") and len(text.split()) > MOST_README_WORDS:
            yield f"{name}: {len(text.split())} words"


def of_functions(tree):
    """At most 20 functions have a name that ends in Of."""
    names = sorted({name.split("::")[-1] for source in tree.sources for name, _ in source.functions if re.search(r"[a-z]Of$", name)})
    if len(names) > MOST_OF_FUNCTIONS:
        yield from names


def ros_spelling(tree):
    """Launch, message, service and rviz files are spelt as ROS spells: localization."""
    for name in tree.files:
        if re.search(r"localis", Path(name).name, re.I) and name.endswith((".launch", ".msg", ".srv", ".rviz", ".test")):
            yield name


def word_counts(tree):
    """Words for persons and senses are rare in sources, messages and READMEs."""
    counts, places = Counter(), defaultdict(Counter)
    words = "|".join(WORDS)
    pattern = rf"(?:(?<![A-Za-z])(?:{words})|{'|'.join(word.capitalize() for word in WORDS)})(?=s?(?![a-z]))"
    for name, text in tree.text.items():
        if name.endswith((".cpp", ".hpp", ".msg", ".srv", "README.md")):
            for word in re.findall(pattern, text):
                counts[word.lower()] += 1
                places[word.lower()][name] += 1
    for word in WORDS:
        if counts[word] > MOST_OF_A_WORD:
            yield f"{word}: {counts[word]} times, as in {', '.join(name for name, _ in places[word].most_common(3))}"


def old_names(tree):
    """Names that docs/glossary.md lists as renamed do not come back; rows with a package in brackets are not checked."""
    section = tree.text.get("docs/glossary.md", "").split("## Renamed")[-1].split("Parameters;")[0]
    rows = [line.split("|")[1] for line in section.split("\n") if line.startswith("| `")]
    names = {name for row in rows if "(" not in row for name in re.findall(r"`([A-Za-z]\w*)`", row)}
    for source in tree.sources:
        for name in sorted(names & set(re.findall(r"\w+", _without_comments(source.text)))):
            yield f"{source.path}: {name}"


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
    for package, most in NODELET_LINES.items():
        lines = sum(s.lines for s in tree.sources if s.path.startswith(f"{package}/nodelet/"))
        if lines > most:
            yield f"{package}/nodelet: {lines} lines, at most {most}"


RULES = [long_lines, long_files, long_functions, double_types, unity_names, gtest_names, command_includes, long_readmes, of_functions,
         ros_spelling, word_counts, old_names, nodelet_includes, nodelet_lines]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--rule", action="append", choices=[rule.__name__ for rule in RULES])
    arguments = parser.parse_args()
    tree = Tree()
    failed = False
    for rule in RULES:
        if arguments.rule and rule.__name__ not in arguments.rule:
            continue
        breaches = list(rule(tree))
        enforced = rule.__name__ in ENFORCED
        if breaches and (enforced or arguments.all or arguments.rule):
            print(f"{rule.__name__}: {rule.__doc__}")
            for breach in breaches:
                print(f"  {breach}")
        elif breaches:
            print(f"{rule.__name__}: not yet, {len(breaches)}")
        failed = failed or (enforced and bool(breaches))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
