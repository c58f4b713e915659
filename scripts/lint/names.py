# SPDX-License-Identifier: BSD-3-Clause
"""How constants, tests, functions and files are named."""
import re
from pathlib import Path

from .source import split, without_comments

MOST_OF_FUNCTIONS = 20

# A constant, or one whose name begins with a transform and its frames: kMaxRange, kT_base_camera.
CONSTANT = r"k(?:[A-Z][A-Za-z0-9]*|[A-Z]_[a-z]\w*)$"
# What a template or a library asks for by this name: members of nodelet classes (docs/adding_a_stage.md), of traits.
GIVEN_NAMES = {"name", "topic", "value"}


def of_functions(tree):
    """At most 20 functions have a name that ends in Of."""
    names = sorted({name.split("::")[-1] for source in tree.sources for name, _ in source.functions if re.search(r"[a-z]Of$", name)})
    if len(names) > MOST_OF_FUNCTIONS:
        yield from names


def old_names(tree):
    """Names that docs/glossary.md lists as renamed do not come back; rows with a package in brackets are not checked."""
    section = tree.text.get("docs/glossary.md", "").split("## Renamed")[-1].split("Parameters;")[0]
    rows = [line.split("|")[1] for line in section.split("\n") if line.startswith("| `")]
    names = {name for row in rows if "(" not in row for name in re.findall(r"`([A-Za-z]\w*)`", row)}
    for source in tree.sources:
        for name in sorted(names & set(re.findall(r"\w+", without_comments(source.text)))):
            yield f"{source.path}: {name}"


def ros_spelling(tree):
    """Launch, message, service and rviz files are spelt as ROS spells: localization."""
    for name in tree.files:
        if re.search(r"localis", Path(name).name, re.I) and name.endswith((".launch", ".msg", ".srv", ".rviz", ".test")):
            yield name


def _constexpr_names(code):
    """Names of constexpr variables, wherever they are declared; of functions none."""
    for match in re.finditer(r"\bconstexpr\b(?! *\()", code):
        words = " ".join(re.split(r"[;]", code[match.end():match.end() + 2000], maxsplit=1)[0].split())
        plain = words
        while (shorter := re.sub(r"<[^<>=;]*>", "", plain)) != plain:
            plain = shorter
        for declarator in split(plain):
            found = re.match(r"[^=({]*?([A-Za-z_]\w*) ?(?:\[[^\]]*\] ?)*(?:$|=|\{)", declarator)
            if not found:
                break
            if re.match(r"[^={]*\)", declarator):
                break
            is_lambda = re.match(r"auto \w+ = \[", declarator)
            if not is_lambda:
                yield found.group(1)


def constant_names(tree):
    """Constants are written kName: constexpr variables, const ones of namespaces, static const members."""
    for source in tree.sources:
        names = {*source.constants, *_constexpr_names(without_comments(source.text))}
        for name in sorted(name for name in names if not re.match(CONSTANT, name) and name not in GIVEN_NAMES):
            yield f"{source.path}: {name}"


def test_names(tree):
    """Tests and their suites are named in upper camel case."""
    pattern = r"^(?:TYPED_)?TEST(?:_[FP])?\(\s*(\w+)\s*,\s*(\w+)\s*\)"
    for source in tree.sources:
        for match in re.finditer(pattern, source.text, re.M):
            if not all(re.match(r"(?:DISABLED_)?[A-Z][A-Za-z0-9]*$", name) for name in match.groups()):
                yield f"{source.path}: {match.group(1)}.{match.group(2)}"
