# SPDX-License-Identifier: BSD-3-Clause
"""Metric loop closures: two days in a simulated world, processed by the complete `urban_nav map` from odometry to graph.

Each case is WORLD:SEED and then the days, each SECONDS or SECONDS/ROUTE. The candidates are pairs of stamps, true ones from ground truth (closures.py) and
false ones; transforms are computed by the stage. Two configurations:
  both     defaults: keyframes, and clouds if keyframes fail
  views    loop_metric.icp=false: keyframes only (Figs. 19 and 20 of the paper)

Two tables. KINDS: the true candidates by direction of the second pass, their verdicts, and the errors of the accepted ones. MAPS: the trajectory of all days after
relaxation, in one frame, with the first pose of the first day at its true pose. Odometry has no such frame: its error is that of each day relative to its first
pose, which is favourable.
"""
import argparse
import json
import sqlite3
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "src/urban_nav/bench"))
import bags as bag_reader  # noqa: E402
import closures  # noqa: E402
from end_to_end import both_truths, root_mean_square  # noqa: E402
from support import commit, driven, show, urban_nav  # noqa: E402
from truth import angle, inverse  # noqa: E402

WAYS = {"both": (), "views": ("--set", "loop_metric.icp=false")}
KINDS = ("world, seed", "way", "candidates", "count", "by views", "by clouds", "accepted", "wrong", "with free directions", "error, cm: median (95 %)", "deg: median (95 %)",
         "NEES: mean (median)")
MAPS = ("world, seed", "way", "driven, m", "false ones in the map", "days in one map", "odometry, rms, m", "mapped, rms, m", "of the way", "times better",
        "each day rigidly laid upon its truth, m", "between days, m: median (largest)", "NEES of poses")
POSE = ("x", "y", "z", "qx", "qy", "qz", "qw")
WRONG_M, WRONG_DEG = 0.5, 3.0
DIRECTIONS = ("same direction", "across", "opposite direction", "another place")


def candidates(bags, percent, seed, path):
    """Writes pairs of stamps; returns their rows and which of them are true."""
    sessions = [closures.Session(bag) for bag in bags]
    rows, true = closures.rows_of(sessions, percent, 0.0, 0.0, seed)
    path.write_text("".join(",".join(map(str, row[:5])) + "\n" for row in (closures.COLUMNS, *rows)))
    return rows, true


def direction_of(pose, true):
    if not true:
        return DIRECTIONS[3]
    turn = abs(np.degrees(np.arctan2(pose[1, 0], pose[0, 0])))
    return DIRECTIONS[0] if turn < 45 else DIRECTIONS[2] if turn > 135 else DIRECTIONS[1]


def matrix(blob):
    """Returns a symmetric matrix from the bytes of a store: 36 numbers, or the 21 of the upper triangle."""
    numbers = np.frombuffer(blob, "<f8")
    if len(numbers) == 36:
        return numbers.reshape(6, 6)
    result = np.zeros((6, 6))
    result[np.triu_indices(6)] = numbers
    return result + np.triu(result, 1).T


def pose_of(numbers):
    """Returns a pose from x, y, z, qx, qy, qz, qw."""
    pose = np.eye(4)
    pose[:3, :3] = bag_reader.rotation(np.array([numbers[3:]], float))[0]
    pose[:3, 3] = numbers[:3]
    return pose


def error_of(pose, truth):
    """[Exp(phi) R, t + rho], both in the frame of a."""
    return np.r_[pose[:3, 3] - truth[:3, 3], closures.cv2.Rodrigues(pose[:3, :3] @ truth[:3, :3].T)[0].ravel()]


def candidates_of(bags, rows, true, out):
    """Returns direction, kind and acceptance of each candidate."""
    truths = {bag.stem: closures.Session(bag).truth for bag in bags}
    result = []
    for row, right in closures.outcomes(out / "closures.csv", rows, true):
        ends = [truths[row[f"session_{end}"]].at([int(row[f"stamp_{end}_ns"]) * 1e-9])[0] for end in "ab"]
        result.append((direction_of(inverse(ends[0]) @ ends[1], right), row["kind"], row["verdict"] == "accepted"))
    return result


def accepted_of(bags, out):
    """Returns the accepted closures in the store by direction: error along constrained directions in m and deg, whether a direction is free, and the squared error by
    the information (scaled to six directions)."""
    truths = {bag.stem: closures.Session(bag).truth for bag in bags}
    found = {direction: [] for direction in DIRECTIONS}
    with sqlite3.connect(f"file:{out / 'session.db'}?mode=ro", uri=True) as store:
        names = {key: Path(name).stem for key, name in store.execute("SELECT id, name FROM session")}
        rows = store.execute(f"SELECT session_a, stamp_a_ns, session_b, stamp_b_ns, information, {', '.join(POSE)} FROM edge "
                             "WHERE kind IN ('stereo', 'icp') AND verdict = 'accepted'").fetchall()
    for a, stamp_a, b, stamp_b, blob, *numbers in rows:
        truth = inverse(truths[names[a]].at([stamp_a * 1e-9])[0]) @ truths[names[b]].at([stamp_b * 1e-9])[0]
        error, information = error_of(pose_of(numbers), truth), matrix(blob)
        values, vectors = np.linalg.eigh(information)
        held = vectors[:, values > 1e-9 * values[-1]]
        along = held @ (held.T @ error)
        found[direction_of(truth, np.linalg.norm(truth[:3, 3]) < closures.OTHER_PLACE)].append(
            {"m": np.linalg.norm(along[:3]), "deg": np.degrees(np.linalg.norm(along[3:])), "free": held.shape[1] < 6,
             "nees": 6 / held.shape[1] * error @ information @ error})
    return found


def spread(values, scale, digits):
    return f"{scale * np.median(values):.{digits}f} ({scale * np.quantile(values, 0.95):.{digits}f})"


def kinds_of(label, way, judged, accepted):
    rows = []
    for direction in DIRECTIONS:
        kinds = [kind for place, kind, taken in judged if place == direction and taken]
        count = sum(place == direction for place, _, _ in judged)
        if not count:
            continue
        row = [label, way, direction, str(count), *(str(kinds.count(kind)) for kind in ("stereo", "icp"))]
        if direction == DIRECTIONS[3]:
            rows.append([*row, str(len(kinds)), str(len(kinds)), "0", "-", "-", "-"])
            continue
        these = accepted[direction]
        row += [f"{100 * len(kinds) / count:.0f} %", str(sum(each["m"] > WRONG_M or each["deg"] > WRONG_DEG for each in these)), str(sum(each["free"] for each in these))]
        nees = [each["nees"] for each in these]
        rows.append([*row, *((spread([each["m"] for each in these], 100, 1), spread([each["deg"] for each in these], 1, 2),
                              f"{np.mean(nees):.1f} ({np.median(nees):.1f})") if these else ("-", "-", "-"))])
    return rows


def trajectory(path):
    rows = np.loadtxt(path)
    return rows[:, 0], rows[:, 1:4]


def between_days(bags, out):
    """Returns the error of the offset between days in the map, m, at each time of a later day at a place of the first one."""
    sessions = [closures.Session(bag) for bag in bags]
    stamps, places = trajectory(out / "trajectory.tum")

    def mapped(stamp):
        return np.array([np.interp(stamp * 1e-9, stamps, places[:, i]) for i in range(3)])
    gaps = []
    for later in sessions[1:]:
        for a, b in closures.in_common(sessions[0], later):
            truth = [session.at([stamp])[0][:3, 3] for session, stamp in ((sessions[0], a), (later, b))]
            gaps.append(abs(np.linalg.norm(mapped(b) - mapped(a)) - np.linalg.norm(truth[1] - truth[0])))
    return gaps


def map_of(label, way, bags, judged, out, folder):
    summary = json.loads((out / "summary.json").read_text())
    urban_nav("evaluate", "--truth", both_truths(bags, folder / "truth.tum"), "--estimate", out / "trajectory.tum", "--json", out / "errors.json")
    errors, graph = json.loads((out / "errors.json").read_text()), summary["pose_graph"]
    days = graph["per_session"]
    frames = [day["frames"] for day in days]
    before, after = root_mean_square([day["ate_m_odometry"] for day in days], frames), errors["ate_m"]
    lengths = [np.linalg.norm(np.diff(closures.Session(bag).places, axis=0), axis=1).sum() for bag in bags]
    false = [taken for place, _, taken in judged if place == DIRECTIONS[3]]
    gaps = between_days(bags, out)
    return [label, way, " + ".join(f"{length:.0f}" for length in lengths), f"{sum(false)} of {len(false)}", f"{graph['sessions_joined']} of {len(days)}", f"{before:.3f}",
            f"{after:.3f}", f"{100 * after / sum(lengths):.3f} %", f"{before / after:.1f}", ", ".join(f"{day['ate_se3_m']:.3f}" for day in days),
            f"{np.median(gaps):.3f} ({max(gaps):.3f})" if gaps else "-", f"{np.average([day['nees'] for day in days], weights=frames):.1f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="for what is simulated and mapped; sessions and maps that are there already are taken")
    parser.add_argument("--case", action="append", help="WORLD:SEED:SECONDS[/ROUTE]:..., repeatable (default quad:7:300:300/reversed)")
    parser.add_argument("--way", action="append", choices=WAYS, help="repeatable (default: all)")
    parser.add_argument("--false", type=float, default=20.0, metavar="PERCENT", help="false candidates, of the number of true ones (default 20)")
    parser.add_argument("--seed", type=int, default=1, help="of the false ones")
    parser.add_argument("--kinds", type=Path, help="the table of candidates, for a README")
    parser.add_argument("--maps", type=Path, help="the table of maps, for a README")
    arguments = parser.parse_args()
    measured = commit()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    kinds, maps = [], []
    for case in arguments.case or ["quad:7:300:300/reversed"]:
        bags, label = driven(arguments.folder, case), " ".join(case.split(":")[:2])
        for way in arguments.way or WAYS:
            out = arguments.folder / f"{bags[0].stem.rsplit('_', 1)[0]}_{way}"
            rows, true = candidates(bags, arguments.false, arguments.seed, arguments.folder / f"{out.name}.csv")
            if not (out / "summary.json").exists():
                urban_nav("map", *bags, "--closures", arguments.folder / f"{out.name}.csv", "--truth", both_truths(bags, arguments.folder / "truth.tum"), "--out", out, *WAYS[way])
            judged = candidates_of(bags, rows, true, out)
            kinds += kinds_of(label, way, judged, accepted_of(bags, out))
            maps.append(map_of(label, way, bags, judged, out, arguments.folder))
    notes = [f"{arguments.false:.0f} % as many false candidates as true ones, seed {arguments.seed}. Wrong: off by more than {WRONG_M} m or {WRONG_DEG:.0f} deg along the directions that the closure measures; errors are along these too. NEES: 6 is expected, with a median of 5.3."]
    show(KINDS, kinds, notes, measured, arguments.kinds)
    show(MAPS, maps, ["Between days: distance of two days in the map less that in the truth, at places of both. NEES: 6 is expected."], measured, arguments.maps)


if __name__ == "__main__":
    main()
