# SPDX-License-Identifier: BSD-3-Clause
"""Versions: one for the whole suite."""
import re

SEMVER = re.compile(r"\d+\.\d+\.\d+")


def versions(tree):
    """Every package.xml has the version of the newest heading of CHANGELOG.md, MAJOR.MINOR.PATCH."""
    found = re.search(r"^## (\S+)", tree.text.get("CHANGELOG.md", ""), re.M)
    if not found or not SEMVER.fullmatch(found.group(1)):
        yield "CHANGELOG.md: its first heading of the second level does not begin with MAJOR.MINOR.PATCH"
        return
    for path, text in sorted(tree.text.items()):
        if path.rsplit("/", 1)[-1] != "package.xml":
            continue
        version = re.search(r"<version>([^<]*)</version>", text)
        if not version or version.group(1) != found.group(1):
            yield f"{path}: version {version.group(1) if version else 'missing'}, in CHANGELOG.md {found.group(1)}"
