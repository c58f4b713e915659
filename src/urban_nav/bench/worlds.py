#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Visual odometry in the simulated worlds: how hard they are, and how good it is there.

Drives each world, maps what the stereo camera saw with the shipped parameters and as a plain method would (the last frame alone, nothing kept, whole
pixels), and compares both with the truth. The stereo streams stay in the folder, so that other systems can run on the very same frames; give their
poses with --peer.
"""
import argparse
import json
import subprocess
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[3]
WORLDS = ("quad", "begbroke", "street")
PLAIN = ("swf_vo.window=1", "swf_vo.forget=delete", "swf_vo.subpixel=false")
COLUMNS = ("world", "system", "10 frames", "10 m", "position, rms, mm", "NEES", "frames not OK", "ms a frame, median")


def run(*arguments):
    result = subprocess.run([TOP / "urban_nav", *map(str, arguments)], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"urban_nav {' '.join(map(str, arguments))}:\n{result.stderr[-2000:]}")


def simulate(world, arguments):
    folder = arguments.folder / f"{world}{arguments.seed}"
    if not (folder / "poses.txt").exists():
        print(f"drives {world} for {arguments.duration} s", file=sys.stderr)
        run("simulate", "--world", world, "--seed", arguments.seed, "--duration", arguments.duration, "--sensors", "stereo",
            "--folder", folder, "-o", f"{folder}.bag")
    return folder


def row(world, system, found):
    span, vo = found["spans"].get("10m"), found.get("swf_vo")
    cells = [world, system, f"{found['rpe_percent']:.2f} %, {found['rpe_deg_per_m']:.4f} deg/m",
             f"{span['percent']:.2f} %, {span['deg_per_m']:.4f} deg/m" if span else "-", f"{1e3 * found['ate_m']:.1f}"]
    if not vo:
        return [*cells, "", "", ""]
    not_ok = sum(n for status, n in vo["status_counts"].items() if status != "OK")
    return [*cells, f"{found['nees_mean']:.1f}", str(not_ok), f"{vo['ms_median']:.1f}"]


def rows_of(world, arguments):
    folder = simulate(world, arguments)
    rows = []
    for system, settings in (("swf_vo", ()), ("plain", PLAIN)):
        out = arguments.folder / f"{folder.name}_{system}"
        run("map", folder, "--stages", "vo", "--out", out, *(word for s in settings for word in ("--set", s)))
        rows.append(row(world, system, json.loads((out / "summary.json").read_text())))
    for name, of, poses in (peer.split("=", 2) for peer in arguments.peer):
        if of == world:
            found = arguments.folder / f"{folder.name}_{name}.json"
            run("evaluate", "--truth", folder / "poses.txt", "--estimate", poses, "--spans", "10m", "--json", found)
            rows.append(row(world, name, json.loads(found.read_text())))
    return rows


def show(table):
    lines = [table["columns"], *table["rows"]]
    widths = [max(len(line[i]) for line in lines) for i in range(len(table["columns"]))]
    for line in lines:
        print("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip())
    print("\n".join(table["notes"]))


def machine():
    info = Path("/proc/cpuinfo").read_text().splitlines()
    names = [line.split(":", 1)[1].strip() for line in info if line.startswith("model name")]
    return f"{names[0] if names else 'unknown'} ({len(names)} cores)"


def commit():
    def git(*words):
        return subprocess.run(["git", "-C", TOP, *words], capture_output=True, text=True).stdout.strip()
    return git("rev-parse", "--short", "HEAD") + ("+" if git("status", "--porcelain") else "")


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
    table = {"machine": machine(), "commit": before, "command": " ".join(["worlds.py", *(Path(w).name for w in sys.argv[1:])]),
             "columns": list(COLUMNS), "rows": rows,
             "notes": [f"{arguments.duration} s each, seed {arguments.seed}. Plain: {', '.join(PLAIN)}. NEES: 6 is right."]}
    show(table)
    if arguments.output:
        arguments.output.write_text(json.dumps(table, indent=1, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    main()
