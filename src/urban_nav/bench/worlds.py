# SPDX-License-Identifier: BSD-3-Clause
"""Visual odometry in the simulated worlds: how hard they are, and how good it is there.

Drives each world, maps what the stereo camera saw with the shipped parameters and as a plain method would (the last frame alone, nothing kept, whole
pixels), and compares both with the truth. The stereo streams stay in the folder, so that other systems can run on the very same frames; give their
poses with --peer.
"""
import argparse
import json
from pathlib import Path

from support import WORLDS, commit, mapped, show, simulated, urban_nav

PLAIN = ("swf_vo.window=1", "swf_vo.marginalization=none", "swf_vo.subpixel=false")
COLUMNS = ("world", "system", "10 frames", "10 m", "position, rms, mm", "NEES", "frames not OK", "ms a frame, median")


def row(world, system, found):
    span, vo = found["spans"].get("10m"), found.get("swf_vo")
    cells = [world, system, f"{found['rpe_percent']:.2f} %, {found['rpe_deg_per_m']:.4f} deg/m",
             f"{span['percent']:.2f} %, {span['deg_per_m']:.4f} deg/m" if span else "-", f"{1e3 * found['ate_m']:.1f}"]
    if not vo:
        return [*cells, "", "", ""]
    not_ok = sum(n for status, n in vo["status_counts"].items() if status != "OK")
    return [*cells, f"{found['nees_mean']:.1f}", str(not_ok), f"{vo['ms_median']:.1f}"]


def rows_of(world, arguments):
    folder = simulated(arguments.folder / f"{world}{arguments.seed}", world, arguments.seed, arguments.duration)
    rows = []
    for system, settings in (("swf_vo", ()), ("plain", PLAIN)):
        out = arguments.folder / f"{folder.name}_{system}"
        rows.append(row(world, system, mapped(folder, out, *settings)))
    for name, of, poses in (peer.split("=", 2) for peer in arguments.peer):
        if of == world:
            found = arguments.folder / f"{folder.name}_{name}.json"
            urban_nav("evaluate", "--truth", folder / "poses.txt", "--estimate", poses, "--spans", "10m", "--json", found)
            rows.append(row(world, name, json.loads(found.read_text())))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="for what is simulated and mapped; what is there already is taken")
    parser.add_argument("--world", action="append", choices=WORLDS, help="default: all")
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--duration", type=int, default=60, help="s, of each (default 60)")
    parser.add_argument("--peer", action="append", default=[], metavar="NAME=WORLD=POSES", help="KITTI's poses.txt of another system")
    parser.add_argument("-o", "--output", type=Path, help="the table, for a README")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    before = commit()
    rows = [r for world in arguments.world or WORLDS for r in rows_of(world, arguments)]
    show(COLUMNS, rows, [f"{arguments.duration} s each, seed {arguments.seed}. Plain: {', '.join(PLAIN)}. NEES: 6 is right."], before, arguments.output)


if __name__ == "__main__":
    main()
