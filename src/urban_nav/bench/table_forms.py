# SPDX-License-Identifier: BSD-3-Clause
"""Reads one table in the formats of common programs by the commands that read tables, and compares the results.

  table_forms.py [-o FILE.json] [--work DIR]
"""
import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np

from support import TOP, commit, show


def quoted(cells):
    return ['"' + cell + '"' for cell in cells]


def plain(cells):
    return list(cells)


def with_commas(cells):
    """Writes decimal commas in numbers; names of files keep their points."""
    return [cell.replace(".", ",") if cell.replace(".", "").lstrip("-").isdigit() else cell for cell in cells]


def written(header, rows, separator=",", cells=plain, head=plain, before="", mark="", end="\n", each="", last=True, encoding="utf-8", between="", lead=""):
    """Returns a table as bytes. `before`: lines before the header; `mark`: before the header; `each`: at the end of a row; `between`: between two rows."""
    lines = [*([mark + separator.join(head(header)) + each] if header else []), *(lead + separator.join(cells(row)) + each for row in rows)]
    text = before + (end + between).join(lines) + (end if last else "")
    return text.encode(encoding)


BOM = "\ufeff"
FORMS = {
    "commas": {}, "semicolons": {"separator": ";"}, "tabs": {"separator": "\t"}, "a blank": {"separator": " "}, "several blanks": {"separator": "   "},
    "comma and blank": {"separator": ", "}, "blank, semicolon, blank": {"separator": " ; "}, "blanks before a row": {"separator": " ", "lead": "  "},
    "semicolons, decimal commas": {"separator": ";", "cells": with_commas}, "tabs, decimal commas": {"separator": "\t", "cells": with_commas},
    "blanks, decimal commas": {"separator": " ", "cells": with_commas}, "quoted header": {"head": quoted}, "all quoted": {"head": quoted, "cells": quoted},
    "quoted, decimal commas": {"head": quoted, "cells": lambda row: quoted(with_commas(row))}, "lines of Windows": {"end": "\r\n"}, "lines of old Macs": {"end": "\r"},
    "no end of the last line": {"last": False}, "blank lines": {"between": "\n"}, "separator at the end": {"each": ","}, "semicolon at the end": {"separator": ";", "each": ";"},
    "header after #": {"mark": "# "}, "header after %": {"mark": "% "}, "header after //": {"mark": "//", "separator": " "}, "comments before": {"before": "# made by a program\n# in 2026\n"},
    "sep= in the first line": {"separator": ";", "before": "sep=;\n"}, "byte order mark": {"before": BOM}, "UTF-16": {"before": BOM, "encoding": "utf-16-le"},
    "UTF-16, other order": {"before": BOM, "encoding": "utf-16-be"}, "UTF-16, tabs, decimal commas": {"before": BOM, "encoding": "utf-16-le", "separator": "\t", "cells": with_commas, "end": "\r\n"},
    "capitals": {"head": lambda names: [name.upper() for name in names]},
}


def run(*words):
    result = subprocess.run([TOP / "urban_nav", *map(str, words)], capture_output=True, text=True)
    return result.returncode


def numbers(values, digits):
    return [f"{value:.{digits}f}" for value in values]


def trajectory():
    t = np.arange(0, 20, 0.1)
    half = 0.05 * t
    return ("timestamp", "x", "y", "z", "qx", "qy", "qz", "qw"), np.stack([1.5e9 + t, 10 * np.sin(0.1 * t), 10 - 10 * np.cos(0.1 * t), 0.01 * t, 0 * t, 0 * t, np.sin(half), np.cos(half)], 1)


def cloud():
    """Three walls of a room with a pillar."""
    u, v = (a.ravel() for a in np.meshgrid(np.arange(0.05, 6, 0.15), np.arange(0.05, 3, 0.15)))
    pillar = np.stack([2 + 0.4 * np.cos(u), 3 + 0.4 * np.sin(u), v], 1)
    return ("x", "y", "z"), np.concatenate([np.stack([u, 0 * u, v], 1), np.stack([0 * u, u, v], 1), np.stack([u, v * 2, 0 * u], 1), pillar])


SENSOR = """rate_hz: 20
resolution: [64, 48]
camera_model: pinhole
intrinsics: [60.0, 60.0, 32.0, 24.0]
distortion_model: radial-tangential
distortion_coefficients: [0.0, 0.0, 0.0, 0.0]
T_BS:
  cols: 4
  rows: 4
  data: [1.0, 0.0, 0.0, %.1f, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]
"""


class Tables:
    """Returns a table for each command, and the result of the command for each format: bytes, or None if rejected."""

    def __init__(self, work):
        self.work = work
        names, rows = trajectory()
        (work / "truth.tum").write_bytes(written((), [numbers(row, 6) for row in rows], " "))
        moved = rows.copy()
        moved[:, 1:4] += 0.05 * np.sin(np.arange(len(rows)))[:, None]
        axes, points = cloud()
        turn = np.array([[np.cos(0.05), -np.sin(0.05), 0], [np.sin(0.05), np.cos(0.05), 0], [0, 0, 1]])
        (work / "target.csv").write_bytes(written(axes, [numbers(p, 4) for p in points @ turn.T + [0.1, 0.05, 0.02]]))
        device = np.arange(0, 30, 0.0125)
        arrival = 1_500_000_000_000_000_000 + (1e9 * device).astype(np.int64) + 1_000_000 * (np.arange(len(device)) * 7 % 11)
        images = 1_500_000_000_000_000_000 + 50_000_000 * np.arange(40, dtype=np.int64)
        for camera in (0, 1):
            folder = work / f"folder/mav0/cam{camera}"
            (folder / "data").mkdir(parents=True, exist_ok=True)
            (folder / "sensor.yaml").write_text(SENSOR % (0.1 * camera))
            (folder / "data.csv").write_bytes(written(("timestamp", "filename"), [[str(s), f"{s}.png"] for s in images]))
            for k, stamp in enumerate(images):
                cv2.imwrite(str(folder / f"data/{stamp}.png"), np.full((48, 64), 100 + k, np.uint8))
        self.of = {"evaluate": (names, [numbers(row, 6) for row in moved]), "icp": (axes, [numbers(p, 4) for p in points]),
                   "device stamp": (("device_s", "arrival_ns"), [[f"{d:.4f}", str(a)] for d, a in zip(device, arrival)]),
                   "info": (("timestamp", "filename"), [[str(s), f"{s}.png"] for s in images])}

    def result(self, command, table):
        out, path = self.work / "result", self.work / "table.csv"
        out.unlink(missing_ok=True)
        path.write_bytes(table)
        if command == "evaluate":
            tum = path.rename(self.work / "table.tum")
            run("evaluate", "--truth", self.work / "truth.tum", "--estimate", tum, "--json", out)
        elif command == "icp":
            run("icp", path, self.work / "target.csv", "--json", out)
        elif command == "device stamp":
            run("device", "stamp", path, "-o", out)
        else:
            path.rename(self.work / "folder/mav0/cam0/data.csv")
            run("info", self.work / "folder", "--json", out)
        return re.sub(rb'"[a-z_]*(ms|_s|seconds)": [0-9.e+-]+,?', b"", out.read_bytes()) if out.exists() else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--work", type=Path)
    arguments = parser.parse_args()
    measured = commit()
    work = arguments.work or Path(tempfile.mkdtemp())
    work.mkdir(parents=True, exist_ok=True)
    tables = Tables(work)
    rows, total = [], 0
    for command, (header, cells) in tables.of.items():
        sound = tables.result(command, written(header, cells))
        if sound is None:
            sys.exit(f"{command} refuses the plain table")
        wrong = []
        for name, form in FORMS.items():
            result = tables.result(command, written(header, cells, **form))
            if result != sound:
                wrong.append(f"{name} ({'refused' if result is None else 'another result'})")
        total += len(FORMS) - len(wrong)
        rows.append([command, str(len(FORMS)), str(len(FORMS) - len(wrong)), ", ".join(wrong)])
    notes = [f"{total} of {len(FORMS) * len(rows)} give the result of the plain table to all digits. Forms: {', '.join(FORMS)}."]
    show(("command", "forms", "equal", "others"), rows, notes, measured, arguments.output)


if __name__ == "__main__":
    main()
