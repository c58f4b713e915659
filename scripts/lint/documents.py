# SPDX-License-Identifier: BSD-3-Clause
"""Documents: links between them."""
import posixpath
import re

LINK = re.compile(r"\]\(([^)\s]+)\)")
BLOCK = re.compile(r"^```.*?^```", re.S | re.M)


def anchors(text):
    """The anchors that a web page of the repository gives to the headings of a document."""
    found = set()
    for heading in re.findall(r"^#+ (.*)$", BLOCK.sub("", text), re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", re.sub(r"[`*]", "", heading)).lower()
        found.add(re.sub(r"[^\w\- ]", "", plain).replace(" ", "-"))
    return found


def broken_links(tree):
    """A link in a document leads to a file or folder of the repository, and to a heading of it."""
    folders = {posixpath.dirname(name) for name in tree.files}
    existing = {*tree.files, *folders, *(posixpath.dirname(folder) for folder in folders)}
    for name, text in tree.text.items():
        if not name.endswith(".md"):
            continue
        for match in LINK.finditer(BLOCK.sub(lambda block: "\n" * block.group(0).count("\n"), text)):
            path, _, anchor = match.group(1).partition("#")
            if re.match(r"[a-z]+:", path):
                continue
            target = posixpath.normpath(posixpath.join(posixpath.dirname(name), path)) if path else name
            if target not in existing:
                yield f"{name}: {match.group(1)}: there is no such file"
            elif anchor and target.endswith(".md") and anchor not in anchors(tree.text[target]):
                yield f"{name}: {match.group(1)}: there is no such heading"
