#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Selects what is to be built and tested after a change.

    scripts/affected.py COMMIT

The files that differ between COMMIT and the working tree, uncommitted and untracked ones included, give the packages that changed.
These, the packages that depend on them (build, run and test dependencies of package.xml, transitively) and the command are tested.
Everything is tested where a ground package, a script or the build itself changed, or more than half of the packages, or where COMMIT
or the working tree cannot be read.

On standard output, one a line: `everything`, or `test PACKAGE` for each package to test and `build FOLDER` for each that its tests
need. The reasons are on standard error. Exit status 2 if COMMIT is not a commit's name.
"""
import re
import subprocess
import sys
import xml.etree.ElementTree as xml
from pathlib import Path, PurePosixPath

ROOT = Path(__file__).resolve().parent.parent

COMMAND = "urban_nav"
GROUND = {"urban_nav_core", "urban_nav_input", "urban_nav_live", "urban_nav_msgs", "urban_nav_registration", "urban_nav_ros", "urban_nav_store"}
PASSED = ".ci/passed"  # names a commit, and is no part of what is built or tested
HASH = re.compile(r"[0-9a-fA-F]{7,64}")
TOP_DOCUMENT = re.compile(r"docs/.*|[^/]+\.md|LICENSE")
PACKAGE_DOCUMENT = re.compile(r".*\.md|bench/results/[^/]+\.json")
NAMES_DOCUMENTS = re.compile(rb"""["'/]docs["'/]""")


class CannotCompare(Exception):
    """What changed is unknown."""


class BadCommit(Exception):
    """The argument is an error of the user."""


def git(root, *arguments):
    """What git prints; throws CannotCompare where it fails."""
    try:
        done = subprocess.run(["git", "-c", "core.quotePath=false", *arguments], cwd=root, capture_output=True, check=True)
    except FileNotFoundError as error:
        raise CannotCompare("git is not installed") from error
    except subprocess.CalledProcessError as error:
        said = error.stderr.decode(errors="replace").strip().splitlines() or [f"git {arguments[0]} failed"]
        raise CannotCompare(said[0]) from error
    return done.stdout.decode(errors="surrogateescape")


def full_name(root, commit):
    """The whole hash of the commit. Throws BadCommit for a name that git does not know, CannotCompare for a hash that is not here, as
    in a shallow clone."""
    git(root, "rev-parse", "--git-dir")
    if not commit or commit.startswith("-"):
        raise BadCommit(f"{commit!r} is not the name of a commit")
    try:
        return git(root, "rev-parse", "--verify", "--quiet", "--end-of-options", commit + "^{commit}").strip()
    except CannotCompare as error:
        if HASH.fullmatch(commit):
            raise CannotCompare(f"commit {commit} is not in this repository") from error
        raise BadCommit(f"{commit!r} is not the name of a commit") from error


class Packages:
    """The packages of one state of the repository."""

    def __init__(self, texts):
        """Reads {path of a package.xml: its text}."""
        self.folders = {}  # folder -> name
        self.needs = {}  # name -> names of any packages that it depends on
        for path, text in texts.items():
            try:
                root = xml.fromstring(text)
                name = root.findtext("name", "").strip()
            except xml.ParseError as error:
                raise CannotCompare(f"{path}: {error}") from error
            if not name:
                raise CannotCompare(f"{path}: no name")
            self.folders[str(PurePosixPath(path).parent)] = name
            self.needs.setdefault(name, set()).update(
                (child.text or "").strip() for child in root if child.tag.endswith("depend"))

    def of(self, path):
        """(name of the package of a file, path within it), or None for a file outside of all packages."""
        for folder in PurePosixPath(path).parents:
            if str(folder) in self.folders:
                return self.folders[str(folder)], str(PurePosixPath(path).relative_to(folder))
        return None


def packages_of_commit(root, commit):
    paths = [path for path in git(root, "ls-tree", "-r", "-z", "--name-only", commit).split("\0") if PurePosixPath(path).name == "package.xml"]
    return Packages({path: git(root, "show", f"{commit}:{path}") for path in paths})


def packages_now(root):
    listed = git(root, "ls-files", "-z", "--cached", "--others", "--exclude-standard").split("\0")
    paths = {path for path in listed if PurePosixPath(path).name == "package.xml" and (root / path).is_file()}
    return Packages({path: (root / path).read_text(errors="replace") for path in sorted(paths)})


def changed_files(root, commit):
    """A renamed file counts under both names."""
    tracked = git(root, "diff", "--name-only", "--no-renames", "--no-ext-diff", "--ignore-submodules=none", "-z", commit, "--")
    untracked = git(root, "ls-files", "-z", "--others", "--exclude-standard")
    return sorted({path for path in (tracked + untracked).split("\0") if path and path != PASSED})


def readers_of_documents(root, packages):
    """The packages whose tests name the folder docs/."""
    listed = git(root, "ls-files", "-z", "--cached", "--others", "--exclude-standard", "--", "*.cpp", "*.hpp", "*.py").split("\0")
    found = set()
    for path in listed:
        place = packages.of(path) if path else None
        if place and place[1].startswith("test/") and (root / path).is_file() and NAMES_DOCUMENTS.search((root / path).read_bytes()):
            found.add(place[0])
    return found


class Selection:
    """What is to be tested; `everything` is a reason, or empty."""

    def __init__(self, everything="", tested=None, built=()):
        self.everything = everything
        self.tested = tested or {}  # name -> reason
        self.built = sorted(built)  # folders

    def lines(self):
        if self.everything:
            return ["everything"]
        return [f"test {name}" for name in sorted(self.tested)] + [f"build {folder}" for folder in self.built]

    def reasons(self):
        if self.everything:
            return [f"everything is tested: {self.everything}"]
        if not self.tested:
            return ["no package is tested: none changed"]
        return [f"{name} is tested: {reason}" for name, reason in sorted(self.tested.items())]


def closure(names, edges):
    """{name: the neighbour that it was reached from, itself for a start} over {name: neighbours}."""
    reached = {name: name for name in names}
    pending = sorted(names)
    while pending:
        name = pending.pop(0)
        for other in sorted(edges.get(name, ())):
            if other not in reached:
                reached[other] = name
                pending.append(other)
    return reached


def select(root, commit):
    """The Selection for the difference between the commit and the working tree."""
    try:
        return _select(root, full_name(root, commit))
    except CannotCompare as error:
        return Selection(everything=str(error))


def _select(root, commit):
    before, now = packages_of_commit(root, commit), packages_now(root)
    changed, documents, at_top = {}, {}, False
    for path in changed_files(root, commit):
        places = {place for place in (before.of(path), now.of(path)) if place}
        if not places and TOP_DOCUMENT.fullmatch(path):
            at_top = True
        elif not places:
            return Selection(everything=f"{path} changed")
        for name, inside in places:
            (documents if PACKAGE_DOCUMENT.fullmatch(inside) else changed).setdefault(name, path)
    ground = sorted(GROUND & set(changed))
    if ground:
        return Selection(everything=f"the ground package {ground[0]} changed ({changed[ground[0]]})")
    if 2 * len(changed) > len(now.needs):
        return Selection(everything=f"{len(changed)} of {len(now.needs)} packages changed")
    return _with_dependents(before, now, changed, documents, readers_of_documents(root, now) if at_top else ())


def _with_dependents(before, now, changed, documents, readers):
    dependents = {}
    for packages in (before, now):
        for name, needs in packages.needs.items():
            for need in needs:
                dependents.setdefault(need, set()).add(name)
    tested = {name: "its tests read docs/" for name in readers}
    tested.update({name: f"{path} changed" for name, path in documents.items()})
    if changed:
        tested[COMMAND] = "it is the command"
    for name, source in closure(changed, dependents).items():
        tested[name] = f"{changed[name]} changed" if name == source else f"it depends on {source}"
    tested = {name: reason for name, reason in tested.items() if name in now.needs}
    needed = closure(tested, now.needs)
    return Selection(tested=tested, built=[folder for folder, name in now.folders.items() if name in needed])


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__, file=sys.stderr)
        return 2
    try:
        selection = select(ROOT, sys.argv[1])
    except BadCommit as error:
        print(f"affected.py: {error}", file=sys.stderr)
        return 2
    for reason in selection.reasons():
        print(reason, file=sys.stderr)
    for line in selection.lines():
        print(line)
    return 0


if __name__ == "__main__":
    sys.exit(main())
