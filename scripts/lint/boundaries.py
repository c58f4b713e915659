# SPDX-License-Identifier: BSD-3-Clause
"""What only one part of the suite may do: name topics, open recordings, spell the states of closures."""
import re

from .tree import is_product

# Where recordings are read and written.
BAG_FOLDERS = ("src/urban_nav_input/", "src/urban_nav/src/convert/")
# The reader and the writer of closures.csv.
CLOSURE_FILES = ()


def strings(text):
    """(line number, literal) of the strings of a source, without includes and comments."""
    pattern = r'//[^\n]*|/\*.*?\*/|^[ \t]*#include[^\n]*|R"(\w*)\(.*?\)\1"|"((?:[^"\\\n]|\\.)*)"'
    for match in re.finditer(pattern, text, re.S | re.M):
        if match.group(2) is not None:
            yield text.count("\n", 0, match.start()) + 1, match.group(2)


def topic_names(tree):
    """Names of topics are constants of urban_nav_ros; a test spells them as a user does.

    A string is a topic if it begins like one of these constants (map/..., /tf) or if it is advertised or subscribed to.
    """
    topics = set()
    for source in tree.sources:
        if re.match(r"src/urban_nav_ros/include/urban_nav_ros/\w*topics\.hpp$", source.path):
            topics |= {text for _, text in strings(source.text) if re.match(r"\w+/|/\w", text)}
    spaces = sorted({topic.lstrip("/").split("/")[0] for topic in topics if "/" in topic.lstrip("/")})
    pattern = re.compile(rf"/?(?:{'|'.join(map(re.escape, spaces))})/[\w/]*$")
    for source in tree.sources:
        if source.path.startswith("src/urban_nav_ros/") or not is_product(source.path) or not spaces:
            continue
        for number, text in strings(source.text):
            if pattern.match(text) or text in topics:
                yield f'{source.path}:{number}: "{text}"'
        for match in re.finditer(r'\b(?:advertise|subscribe\w*)<[^;(]*>\(\s*"(\w+)"', source.text):
            yield f'{source.path}:{source.text.count(chr(10), 0, match.start(1)) + 1}: "{match.group(1)}"'


def bag_readers(tree):
    """Recordings are read by src/urban_nav_input and written by src/urban_nav/src/convert: elsewhere nothing names rosbag."""
    for source in tree.sources:
        if is_product(source.path) and "rosbag::" in source.text and not source.path.startswith(BAG_FOLDERS):
            yield source.path


def closure_states(tree):
    """Kinds and verdicts of closures are enumerators; strings only in the reader and the writer of closures.csv."""
    for source in tree.sources:
        if is_product(source.path) and source.path not in CLOSURE_FILES:
            for match in re.finditer(r'[=!]= "(?:icp|stereo|accepted|rejected)"', source.text):
                yield f"{source.path}:{source.text.count(chr(10), 0, match.start()) + 1}: {match.group(0)}"
