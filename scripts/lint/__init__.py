# SPDX-License-Identifier: BSD-3-Clause
"""Rules of the house for sources and documents; scripts/lint.py applies them.

A rule is a function of a Tree whose doc comment says what holds; it yields a line for each breach.
"""
from .boundaries import bag_readers, closure_states, topic_names
from .code import double_types, gtest_names, long_files, long_functions, long_lines, unity_names
from .documents import broken_links
from .folders import command_includes, nodelet_includes, nodelet_lines
from .names import constant_names, of_functions, old_names, ros_spelling, test_names
from .release import versions
from .source import Source
from .tree import Tree
from .words import long_readmes, word_counts

RULES = [long_lines, long_files, long_functions, double_types, unity_names, gtest_names, command_includes, long_readmes, of_functions,
         ros_spelling, word_counts, old_names, nodelet_includes, nodelet_lines, constant_names, test_names, topic_names,
         bag_readers, closure_states, versions, broken_links]

# Rules that do not hold yet: they are counted, and a breach fails no run.
COUNTED = set()
