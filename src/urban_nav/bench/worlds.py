# SPDX-License-Identifier: BSD-3-Clause
"""Visual odometry in the simulated worlds: difficulty and accuracy.

Drives each world, maps what the stereo camera saw with the shipped parameters, runs plain odometry on it (swf_vo-bench-plain: a window of one frame,
without a prior, with corners at whole pixels), and compares both with the truth. The stereo streams stay in the folder, so that other systems can run
on the very same frames; give their poses with --peer. Needs the programs of bench/ (target urban_nav_benches).
"""
import argparse
import json
import subprocess
import sys
from pathlib import Path

from support import TOP, WORLDS, commit, mapped, show, simulated, urban_nav

PLAIN = TOP / "build" / "ws" / "devel" / "lib" / "swf_vo" / "swf_vo-bench-plain"
COLUMNS = ("world", "system", "10 frames", "10 m", "position, rms, mm", "NEES", "frames not OK", "ms a frame, median")


def row(world, system, found):
    span, vo = found["spans"].get("10m"), found.get("swf_vo")
    cells = [world, system, f"{found['rpe_percent']:.2f} %, {found['rpe_deg_per_m']:.4f} deg/m",
             f"{span['percent']:.2f} %, {span['deg_per_m']:.4f} deg/m" if span else "-", f"{1e3 * found['ate_m']:.1f}"]
    if not vo:
        return [*cells, "", "", ""]
    not_ok = sum(n for status, n in vo["status_counts"].items() if status != "OK")
    return [*cells, f"{found['nees_mean']:.1f}", str(not_ok), f"{vo['ms_median']:.1f}"]


def evaluated(folder, poses, found):
    """Compares poses of the left camera of a folder with the truth in it; `found`: file for the figures."""
    urban_nav("evaluate", "--truth", folder / "poses.txt", "--estimate", poses, "--spans", "10m", "--json", found)
    return json.loads(found.read_text())


def plain(folder, out):
    """Runs plain odometry on a folder; returns its figures, as support.mapped() does."""
    result = subprocess.run([PLAIN, folder, out], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{PLAIN.name} {folder} {out}:\n{result.stderr[-2000:]}")
    return {**evaluated(folder, out / "poses.txt", out / "evaluation.json"), "swf_vo": json.loads((out / "summary.json").read_text())}


def rows_of(world, arguments):
    folder = simulated(arguments.folder / f"{world}{arguments.seed}", world, arguments.seed, arguments.duration)
    rows = []
    for system, run in (("swf_vo", mapped), ("plain", plain)):
        rows.append(row(world, system, run(folder, arguments.folder / f"{folder.name}_{system}")))
    for name, of, poses in (peer.split("=", 2) for peer in arguments.peer):
        if of == world:
            rows.append(row(world, name, evaluated(folder, poses, arguments.folder / f"{folder.name}_{name}.json")))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of simulated sessions and maps; existing ones are used")
    parser.add_argument("--world", action="append", choices=WORLDS, help="default: all")
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--duration", type=int, default=60, help="s, duration of each (default 60)")
    parser.add_argument("--peer", action="append", default=[], metavar="NAME=WORLD=POSES", help="poses.txt (KITTI) of another system")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    before = commit()
    rows = [r for world in arguments.world or WORLDS for r in rows_of(world, arguments)]
    note = (f"{arguments.duration} s each, seed {arguments.seed}. Plain: a window of one frame, without a prior, with corners at whole pixels. "
            "NEES: 6 is expected.")
    show(COLUMNS, rows, [note], before, arguments.output)


if __name__ == "__main__":
    main()
