#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pages of the public headers with doxygen in build/api/html, and prints each defect of their comments.

    scripts/api_pages.py                  all public headers
    scripts/api_pages.py --since COMMIT   nothing if no public header, docs/Doxyfile or docs/api.dox differs from that commit

Defects are the warnings of doxygen (unknown commands and tags, references to nothing, names of parameters that do not exist) and types
of a namespace without a comment. A comment on a group of members or functions covers all of them. Exit status 1 if there is a defect.
"""
import argparse
import re
import shutil
import subprocess
import sys
from pathlib import Path

import affected

ROOT = Path(__file__).resolve().parent.parent
SOURCES = re.compile(r"(src/)?[^/]+/include/.*\.hpp|docs/Doxyfile|docs/api\.dox|scripts/api_pages\.py")
TYPE_OF_NAMESPACE = re.compile(r"Compound (?:[a-z]\w*::)+\w+ |Member \w+ \(enumeration\) of namespace ")


def is_defect(warning):
    """Whether a line of doxygen's output is a defect; a member without a comment is none."""
    return "is not documented" not in warning or bool(TYPE_OF_NAMESPACE.search(warning))


def configuration(root):
    """docs/Doxyfile with the folders of all public headers, which are also what #include lines are relative to."""
    folders = sorted(str(folder.relative_to(root)) for pattern in ("*/include", "src/*/include") for folder in root.glob(pattern))
    return (root / "docs/Doxyfile").read_text(encoding="utf-8") + f"INPUT = docs/api.dox {' '.join(folders)}\nSTRIP_FROM_INC_PATH = {' '.join(folders)}\n"


def make(root):
    """Returns the defects, each once."""
    pages = root / "build" / "api"
    shutil.rmtree(pages, ignore_errors=True)
    pages.mkdir(parents=True)
    done = subprocess.run(["doxygen", "-"], cwd=root, input=configuration(root), capture_output=True, text=True, check=False)
    defects = dict.fromkeys(line.replace(f"{root}/", "") for line in done.stderr.splitlines() if line and is_defect(line))
    return list(defects) or ([f"doxygen ended with status {done.returncode}"] if done.returncode != 0 else [])


def differs(root, commit):
    """Whether a source of the pages differs from the commit; True where that is unknown."""
    try:
        return any(SOURCES.fullmatch(path) for path in affected.changed_files(root, affected.full_name(root, commit)))
    except affected.CannotCompare:
        return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--since", metavar="COMMIT")
    arguments = parser.parse_args()
    try:
        if arguments.since and not differs(ROOT, arguments.since):
            print("no public header changed", file=sys.stderr)
            return 0
    except affected.BadCommit as error:
        parser.error(str(error))
    if not shutil.which("doxygen"):
        print("api_pages.py: doxygen is not installed", file=sys.stderr)
        return 1
    defects = make(ROOT)
    print("\n".join(defects) if defects else "build/api/html/index.html", file=sys.stderr)
    return 1 if defects else 0


if __name__ == "__main__":
    sys.exit(main())
