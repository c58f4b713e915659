# SPDX-License-Identifier: BSD-3-Clause
"""Visual odometry in the simulated worlds: consistency of covariance, effects of faults, motion from a start at 2 cm/s.

    python3 bars.py consistency FOLDER [--seed N]... [-o bars_consistency.json]
    python3 bars.py faults FOLDER [--seed N]... [--peer NAME=PROGRAM] [-o bars_faults.json]
    python3 bars.py creep FOLDER [--seed N]... [--peer NAME=PROGRAM] [-o bars_creep.json]

Shipped parameters; sessions are simulated into FOLDER unless they exist. Another system for comparison: PROGRAM FOLDER POSES reads a KITTI folder and writes
poses of KITTI.
"""
import argparse
import csv
import json
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from support import WORLDS, commit, mapped, show, simulated, urban_nav

FRAMES = (50, 100, 200, 400)  # number of frames after which the last pose is evaluated
SEEDS, LENGTH = (7, 8, 9), 20  # s
FAULT_SEEDS = (7, 8, 9, 10, 11)
BEGIN, DURATION, SHORT = 1.5, 1.0, 4  # s: start and duration of a fault, duration of its session
FAULTS = (("drop", ":0.3"), ("freeze", ""), ("swap", ""), ("corrupt", ":0.3"), ("jump", ""), ("unplug", ""), ("nan", ""))
CREPT, CREEP = (0.01, 0.02, 0.05), 5  # m, s
RATE = 20  # Hz


def first_frames(folder, count):
    """Makes a KITTI folder of links to the first frames of another."""
    part = folder.with_name(f"{folder.name}_{count}")
    if part.exists():
        shutil.rmtree(part)
    for side in ("image_0", "image_1"):
        (part / side).mkdir(parents=True)
        for i in range(count):
            (part / side / f"{i:06d}.png").symlink_to((folder / side / f"{i:06d}.png").resolve())
    shutil.copy(folder / "calib.txt", part)
    for name in ("times.txt", "poses.txt"):
        (part / name).write_text("\n".join((folder / name).read_text().splitlines()[:count]) + "\n")
    return part


def ended(summary):
    """Returns the number of frames that are not OK, and the error of the last pose."""
    counts = summary["swf_vo"]["status_counts"]
    return sum(n for status, n in counts.items() if status != "OK"), summary["end"]


def peer_poses(peer, folder):
    name, program = peer.split("=", 1)
    poses = folder.with_name(f"{folder.name}_{name}.txt")
    subprocess.run([program, folder, poses], check=True, capture_output=True)
    return name, poses


def consistency(arguments):
    rows, everything = [], []
    for world in WORLDS:
        found = []
        for seed in arguments.seed or SEEDS:
            folder = arguments.folder / f"{world}{seed}"
            if arguments.there and not (folder / "poses.txt").exists():
                continue
            simulated(folder, world, seed, LENGTH)
            ends = [ended(mapped(part, part.with_name(part.name + "_out")))[1] for part in (first_frames(folder, count) for count in FRAMES)]
            found.append([end["nees"] for end in ends])
            print(world, seed, found[-1], flush=True)
            last = ends[-1]
            rows.append([world, str(seed), *(f"{nees:.1f}" for nees in found[-1]), f"{1e3 * last['error_m']:.1f} mm, {last['error_deg']:.3f} deg"])
        everything += found
    rows.append(["all", "mean", *(f"{nees:.1f}" for nees in np.mean(everything, 0)), ""])
    runs = len(everything)
    notes = [f"Normalised squared error of the last frame, first poses aligned; 6 is expected. {runs} runs: 99 % of means over as many runs are within "
             f"{band(runs)[0]:.2f}...{band(runs)[1]:.2f}."]
    return ("world", "seed", *(f"frame {count}" for count in FRAMES), f"error at {FRAMES[-1]}"), rows, notes


def band(runs):
    """Returns the 99 % interval of the mean of chi-square values with 6 degrees of freedom (Wilson and Hilferty 1931)."""
    freedom = 6 * runs
    return [freedom * (1 - 2 / (9 * freedom) + z * np.sqrt(2 / (9 * freedom))) ** 3 / runs for z in (-2.5758, 2.5758)]


def named(out):
    """Returns received frames from the start of the fault until it is reported (status not OK, or a reason); the reason; the last status."""
    with open(out / "stats.csv", newline="") as file:
        frames = list(csv.DictReader(file))
    begin = int(frames[0]["stamp_ns"]) + int(1e9 * BEGIN)
    late = [frame for frame in frames if int(frame["stamp_ns"]) >= begin - 1_000_000]
    for i, frame in enumerate(late):
        if frame["status"] != "OK" or frame["reason"] not in ("", "none"):
            return f"{i}: {frame['reason']}", frames[-1]["status"]
    return "-", frames[-1]["status"]


def faults(arguments):
    rows = []
    for world in WORLDS:
        fair = [Outcome.of(arguments, world, seed) for seed in arguments.seed or FAULT_SEEDS]
        fair_error = rms(one.error for one in fair)
        rows.append([world, "none", f"{1e3 * fair_error:.1f}", "1.0", f"{np.mean([one.nees for one in fair]):.1f}", "", "", "",
                     *(f"{1e3 * each:.1f}" for each in peers_rms(fair))])
        for kind, value in FAULTS:
            fault = f"{kind}:stereo:{BEGIN}:{DURATION}{value}"
            each = [Outcome.of(arguments, world, seed, kind, fault) for seed in arguments.seed or FAULT_SEEDS]
            error = rms(one.error for one in each)
            rows.append([world, fault, f"{1e3 * error:.1f}", f"{error / fair_error:.1f}", f"{np.mean([one.nees for one in each]):.1f}",
                         ", ".join(sorted({one.named for one in each})), str(round(np.mean([one.not_ok for one in each]))),
                         ", ".join(sorted({one.status for one in each})), *(f"{1e3 * peer:.1f}" for peer in peers_rms(each))])
            print(*rows[-1], sep=" | ", flush=True)
    names = [peer.split("=", 1)[0] for peer in arguments.peer]
    columns = ("world", "fault", "end off by, rms, mm", "over the undisturbed one's", "mean NEES at the end", "named after, frames", "frames not OK",
               "last status", *(f"{name}: end off by, rms, mm" for name in names))
    seeds = arguments.seed or FAULT_SEEDS
    low, high = band(len(seeds))
    return columns, rows, [f"{len(seeds)} sessions of {SHORT} s of each kind, seeds {', '.join(map(str, seeds))}; the fault from {BEGIN} s on for "
                           f"{DURATION:.0f} s; loops. 99 % of means over as many NEES are within {low:.2f}...{high:.2f}."]


@dataclass
class Outcome:
    """Result of one short session."""
    error: float  # m, of the last pose
    nees: float
    named: str  # frames until the fault was reported, and the report
    not_ok: int  # frames
    status: str  # of the last frame
    peers: list  # of their last poses, m

    @staticmethod
    def of(arguments, world, seed, kind="fair", *fault):
        options = ("--fault", *fault) if fault else ()
        folder = simulated(arguments.folder / f"{world}{seed}_{kind}", world, seed, SHORT, *options)
        out = folder.with_name(folder.name + "_out")
        not_ok, end = ended(mapped(folder, out))
        name, status = named(out)
        return Outcome(end["error_m"], end["nees"], name, not_ok, status,
                       [error_of(peer_poses(peer, folder)[1], folder) for peer in arguments.peer])


def rms(values):
    return float(np.sqrt(np.mean(np.square(list(values)))))


def peers_rms(outcomes):
    """Returns the values of each peer over the sessions."""
    return [rms(errors) for errors in zip(*(one.peers for one in outcomes))]


def error_of(poses, folder):
    found = poses.with_suffix(".json")
    urban_nav("evaluate", "--truth", folder / "poses.txt", "--estimate", poses, "--json", found)
    return json.loads(found.read_text())["end"]["error_m"]


def way_of(poses):
    """Returns the displacement of each frame from the first position, m."""
    places = np.loadtxt(poses).reshape(-1, 3, 4)[:, :, 3]
    return np.linalg.norm(places - places[0], axis=1)


def creep(arguments):
    rows = []
    for world in WORLDS:
        for seed in arguments.seed or SEEDS[:1]:
            folder = simulated(arguments.folder / f"{world}{seed}_creep", world, seed, CREEP, "--route", "creep")
            out = folder.with_name(folder.name + "_out")
            mapped(folder, out)
            systems = [("swf_vo", out / "trajectory.kitti"), *(peer_poses(peer, folder) for peer in arguments.peer)]
            true = way_of(folder / "poses.txt")
            at = [int(np.argmax(true >= length)) for length in CREPT]
            for name, poses in systems:
                estimated = way_of(poses)
                rows.append([world, str(seed), name, *(f"{100 * (estimated[i] / true[i] - 1):+.1f} %" if true[i] >= length else "not reached"
                                                       for i, length in zip(at, CREPT)), str(at[-1])])
    columns = ("world", "seed", "system", *(f"after {100 * length:.0f} cm" for length in CREPT), "frames until then")
    return columns, rows, ["Excess of the estimated distance of the left camera from its start over the true one, at these true distances. Route creep: at 2 cm/s."]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("consistency", "faults", "creep"))
    parser.add_argument("folder", type=Path, help="folder of simulated sessions and maps")
    parser.add_argument("--seed", type=int, action="append", help=f"default: {SEEDS}, of faults {FAULT_SEEDS}, of creep {SEEDS[0]}")
    parser.add_argument("--there", action="store_true", help="consistency: evaluate only existing sessions")
    parser.add_argument("--peer", action="append", default=[], metavar="NAME=PROGRAM")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    before = commit()
    columns, rows, notes = {"consistency": consistency, "faults": faults, "creep": creep}[arguments.what](arguments)
    show(columns, rows, notes, before, arguments.output)


if __name__ == "__main__":
    main()
