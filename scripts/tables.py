#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Keeps the tables of the documents equal to the measurements they show.

`<!-- table: swf_vo/bench/accuracy -->` ... `<!-- end -->` in any README.md or file of docs/ holds the rendering of
swf_vo/bench/results/accuracy.json: {"columns": [...], "rows": [[...], ...], "machine": ..., "commit": ..., "command": ..., "notes": [...]}.
`<!-- table: swf_vo/bench/accuracy; columns: sequence | NEES; where: system = swf_vo, now | ORB-SLAM2 -->` holds these columns of the rows
that have one of these values, without notes and command, for a README whose docs/results shows the whole table.
Without an option the texts are compared and a difference is an error; --write renders them anew.
"""
import argparse
import difflib
import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TABLE = re.compile(r"(<!-- table: ([^\s;]+)(;[^\n]*)? -->\n)(.*?)(<!-- end -->)", re.S)
START = re.compile(r"<!-- table:")


def documents():
    found = [*ROOT.rglob("README.md"), *(ROOT / "docs").rglob("*.md")]
    return sorted({p for p in found if p.relative_to(ROOT).parts[0] not in ("build", "out", ".git")})


def select(data, selection):
    """The columns and rows of a table that a selection keeps, `; columns: A | B; where: A = x | y`."""
    columns, rows = data["columns"], data["rows"]
    kept = range(len(columns))
    for part in filter(None, (part.strip() for part in selection.split(";"))):
        key, _, value = part.partition(": ")
        column, _, values = value.partition(" = ")
        wanted = [word.strip() for word in (value if key == "columns" else values).split("|")]
        unknown = [name for name in (wanted if key == "columns" else [column]) if name not in columns]
        if key not in ("columns", "where") or unknown:
            raise ValueError(f"selection {part!r}: expected columns: or where: with names among {', '.join(columns)}")
        if key == "columns":
            kept = [columns.index(name) for name in wanted]
        else:
            rows = [row for row in rows if str(row[columns.index(column)]) in wanted]
            if not rows:
                raise ValueError(f"selection {part!r}: no row has such a value")
    return [columns[i] for i in kept], [[row[i] for i in kept] for row in rows]


def render(name, selection=""):
    """The Markdown of one table; numbers stand as the file writes them."""
    path = (ROOT / name).parent / "results" / (Path(name).name + ".json")
    if not path.is_file():
        raise ValueError(f"{path.relative_to(ROOT)} does not exist")
    data = json.loads(path.read_text(), parse_float=str, parse_int=str)
    missing = [key for key in ("columns", "rows", "machine", "commit", "command") if key not in data]
    if missing:
        raise ValueError(f"{path.relative_to(ROOT)} lacks {', '.join(missing)}")
    wrong = [row for row in data["rows"] if len(row) != len(data["columns"])]
    if wrong:
        raise ValueError(f"{path.relative_to(ROOT)}: {len(data['columns'])} columns, but a row is {wrong[0]}")
    columns, selected = select(data, selection or "")
    rows = [columns, ["---"] * len(columns), *selected]
    lines = ["| " + " | ".join("" if cell is None else str(cell) for cell in row) + " |" for row in rows]
    if selection:
        return "\n".join(lines) + f"\n\n<sub>{data['machine']}, commit {data['commit']}</sub>\n"
    notes = "".join(f"{note}\n" for note in data.get("notes", []))
    return "\n".join(lines) + f"\n\n{notes}<sub>`{data['command']}` on {data['machine']}, commit {data['commit']}</sub>\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="render the tables into the documents")
    write = parser.parse_args().write
    errors = 0
    for path in documents():
        old = path.read_text()
        try:
            if len(START.findall(old)) != len(TABLE.findall(old)):
                raise ValueError("a table has no <!-- end -->")
            new = TABLE.sub(lambda match: match[1] + render(match[2], match[3]) + match[5], old)
        except ValueError as error:
            print(f"{path.relative_to(ROOT)}: {error}", file=sys.stderr)
            errors += 1
            continue
        if new == old:
            continue
        if write:
            path.write_text(new)
            continue
        print(f"{path.relative_to(ROOT)} is not what was measured; scripts/tables.py --write renders it", file=sys.stderr)
        sys.stderr.writelines(difflib.unified_diff(old.splitlines(True), new.splitlines(True), "README.md", "measured", n=1))
        errors += 1
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
