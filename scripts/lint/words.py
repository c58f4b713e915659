# SPDX-License-Identifier: BSD-3-Clause
"""Words: sizes of READMEs, and how often words that are not the field's are written."""
import re
from collections import Counter, defaultdict
from pathlib import Path

MOST_README_WORDS = 1200
TABLE = Path(__file__).parent / "words.txt"


def long_readmes(tree):
    """A README has at most 1200 words."""
    for name, text in tree.text.items():
        if name.endswith("README.md") and len(text.split()) > MOST_README_WORDS:
            yield f"{name}: {len(text.split())} words"


class Table:
    """The rows of words.txt: a name, a ceiling, and the words or the regular expression that count under it."""

    def __init__(self, text):
        self.lines = text.split("\n")
        self.ceilings, self.words, self.patterns = {}, {}, {}
        for line in self.lines:
            match = re.match(r"([^#:]*\S) +(\d+): (.*)$", line)
            if match:
                name, ceiling, what = match.group(1), int(match.group(2)), match.group(3)
                self.ceilings[name] = ceiling
                if what.startswith("/"):
                    self.patterns[name] = re.compile(what.strip("/"), re.M)
                else:
                    self.words.update(dict.fromkeys(what.split(), name))

    def lowered(self, counts):
        """The text of the table with the ceilings that are above these counts brought down to them."""
        def lower(line):
            match = re.match(r"([^#:]*\S) +(\d+): (.*)$", line)
            if not match or counts[match.group(1)] >= int(match.group(2)):
                return line
            return f"{match.group(1)} {counts[match.group(1)]}: {match.group(3)}"
        return "\n".join(lower(line) for line in self.lines)


def count_words(tree, table):
    """(name -> number, name -> file -> number) in sources, messages and documents; parts of identifiers are words too."""
    counts, places = Counter(), defaultdict(Counter)
    for path, text in tree.text.items():
        if not path.endswith((".cpp", ".hpp", ".py", ".msg", ".srv", ".md")) or path.startswith("scripts/"):
            continue
        for word in re.findall(r"[A-Z]?[a-z]+", text):
            name = table.words.get(word.lower())
            if name:
                places[name][path] += 1
        for name, pattern in table.patterns.items():
            found = len(pattern.findall(text))
            if found:
                places[name][path] += found
    for name, files in places.items():
        counts[name] = sum(files.values())
    return counts, places


def word_counts(tree, table=None):
    """Words that are not the field's become rarer: as many as words.txt allows, which is never more than there are."""
    table = table or Table(TABLE.read_text())
    counts, places = count_words(tree, table)
    for name, ceiling in table.ceilings.items():
        if counts[name] > ceiling:
            where = ", ".join(f"{path} ({n})" for path, n in places[name].most_common(3))
            yield f"{name}: {counts[name]} times, at most {ceiling}; most in {where}"
        elif counts[name] < ceiling:
            yield f"{name}: {counts[name]} times, the ceiling is {ceiling}: run scripts/lint.py --lower"
