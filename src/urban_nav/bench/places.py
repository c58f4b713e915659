# SPDX-License-Identifier: BSD-3-Clause
"""Claims of the default model of places between days, within one day, and in other worlds, for simulated worlds used neither for training nor for calibration.

two days     a site driven on two days; the second is matched with both, and with only the first (places of the second day are no candidates)
reversed     as two days, matched with only the first; counted where the second day is driven in the opposite direction
left images  as two days, by only the left image of the stereo head, two per second
lights       a site by day, and on the second day at dusk and at night, matched with both; by all evidence
one day      a drive that returns to its start, matched with itself
strangers    other sites of the same world: each is matched with all previous ones, and every match is wrong
real images  425 images of a car, with revisits: of $URBAN_NAV_DATA, if it is set

Panoramas unless stated otherwise. A match within 7.5 m is right, beyond 10 m wrong. Counted are the matches of the second day with either day, and those of strangers with other drives.
FOLDER/claims.csv keeps each claim with all evidence, for places_reliability.py.
"""
import argparse
import csv
import os
import sys
from collections import namedtuple
from pathlib import Path

import numpy as np

from localisation import places_at, trajectory
from support import commit, show, simulated_bag, urban_nav

try:
    import rosbag
except ImportError:
    rosbag = None

COLUMNS = ("world", "drives", "evidence", "compared", "revisits", "right place first", "recall at 100 % precision", "above 0.99", "right", "0.9 to 0.99", "right", "0.05 to 0.9", "right")
CLAIM_COLUMNS = ("world", "drives", "probability", "verdict", "stretch")
TWO_DAYS = ("quad:930001:40", "street:930002:40", "begbroke:930003:30")
OTHER_SITES = ("quad:930001:40,930004:20,930007:20", "street:930002:40,930005:20,930008:20", "begbroke:930003:30,930006:20,930009:20")
ONE_DAY = "begbroke:930003:200"  # around the building in 170 s
LIGHTS = ("street:930002:25:20", "quad:930001:25:20")  # s of the first day, and of the second in each light
REVERSED = "quad:930001:40"  # to the archway
RETURN_SECONDS = 60  # to the archway and back
LEFT_IMAGES = "quad:930001:25"
LEFT_TOPIC = "/stereo/left/image_raw"
EVIDENCE = {"words alone": ("--second-look", "off", "--sequence", "off"), "+ sequence": ("--second-look", "off"), "+ second look": ()}  # the last one is the default
SAME_M, ELSEWHERE_M, REVISIT_M = 7.5, 10.0, 2.0
SAME_IMAGES, ELSEWHERE_IMAGES = 3, 20  # of the real images, a quarter of a second apart
STRETCH_M, STRETCH_IMAGES = 10.0, 5
MASK_NS = 20 * 10**9
FIRST_DAY_ALONE = ("--mask", 1000)  # s, longer than any second day
OPPOSITE_DEG = 135.0
KINDS = ("two days", "reversed", "left images", "lights", "one day", "strangers", "real images")

Match = namedtuple("Match", "drive_a stamp_a drive_b stamp_b probability")  # a: the earlier place, b: the query
Claim = namedtuple("Claim", "probability right revisit stretch")  # right: True, False, or None for neither


def matches(model, inputs, csv_path, options):
    urban_nav("places", "query", model, *inputs, *options, "-o", csv_path)
    drives = {Path(each).stem: k for k, each in enumerate(inputs)}
    with csv_path.open() as file:
        return [Match(drives[r["session_a"]], int(r["stamp_a_ns"]), drives[r["session_b"]], int(r["stamp_b_ns"]), float(r["probability"])) for r in csv.DictReader(file)]


def drive(folder, world, seed, duration, day=1, route="loops", sensors="ladybug", light="day"):
    name = "_".join(map(str, (world, seed, day, *((route,) if route != "loops" else ()), *((duration, sensors) if sensors != "ladybug" else ()), *((light,) if light != "day" else ()))))
    return simulated_bag(folder / f"{name}.bag", world, seed, duration, "--day", day, "--route", route, "--sensors", sensors, "--light", light)


def left_images(bag):
    """Writes two left images per second of a bag as a bag; an existing one is used."""
    thinned = bag.with_name(f"{bag.stem}_left.bag")
    if not thinned.exists():
        with rosbag.Bag(str(bag)) as source, rosbag.Bag(str(thinned), "w") as target:
            for i, (topic, message, stamp) in enumerate(source.read_messages(topics=[LEFT_TOPIC], raw=True)):
                if i % 10 == 0:
                    target.write(topic, message, stamp, raw=True)
    return thinned


class Drive:
    """Returns the true path of a bag."""

    def __init__(self, bag):
        self.path = bag.with_suffix(".truth") / "trajectory.tum"
        self.stamps, self.places = trajectory(self.path)
        x, y, z, w = np.array([line.split()[4:8] for line in self.path.read_text().splitlines() if not line.startswith("#")], float).T
        self.headings = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
        self.travelled = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(self.places, axis=0), axis=1))])

    def place(self, stamp):
        return places_at((self.stamps, self.places), [stamp])[0]

    def index(self, stamp):
        return min(int(np.searchsorted(self.stamps, stamp)), len(self.stamps) - 1)


def nearest(earlier, query, stamp):
    """Returns the distance (m) from `query` at a time to the path of `earlier`, and the angle (deg) between the headings."""
    until = int(np.searchsorted(earlier.stamps, stamp - MASK_NS)) if earlier is query else len(earlier.stamps)
    if until == 0:
        return np.inf, 0.0
    off = np.linalg.norm(earlier.places[:until] - query.place(stamp), axis=1)
    at = int(off.argmin())
    turn = earlier.headings[at] - query.headings[query.index(stamp)]
    return off[at], abs(np.degrees(np.arctan2(np.sin(turn), np.cos(turn))))


def judged(found, bags, one_site, only_opposite=False):
    """Returns the claims of matches with drives of one site or several."""
    drives = [Drive(bag) for bag in bags]
    claims = []
    for match in found:
        a, b = drives[match.drive_a], drives[match.drive_b]
        distance, angle = min(nearest(earlier, b, match.stamp_b) for earlier in drives[:match.drive_b] or [b]) if one_site else (np.inf, 0.0)
        if only_opposite and not (distance <= REVISIT_M and angle >= OPPOSITE_DEG):
            continue
        off = np.linalg.norm(a.place(match.stamp_a) - b.place(match.stamp_b)) if one_site else np.inf
        right = True if off <= SAME_M else False if off > ELSEWHERE_M else None
        stretch = f"{match.drive_b}:{int(b.travelled[b.index(match.stamp_b)] / STRETCH_M)}"
        claims.append(Claim(match.probability, right, bool(distance <= REVISIT_M), stretch))
    return claims


def evaluated_images(found, positions, stamps):
    claims = []
    index = {round(stamp * 1e9): i for i, stamp in enumerate(stamps)}
    for match in found:
        i, j = index[match.stamp_a], index[match.stamp_b]
        off = abs(positions[i] - positions[j])
        right = True if off <= SAME_IMAGES else False if off > ELSEWHERE_IMAGES else None
        revisit = any(abs(positions[j] - positions[k]) <= SAME_IMAGES for k in range(len(positions)) if stamps[k] * 1e9 <= match.stamp_b - MASK_NS)
        claims.append(Claim(match.probability, right, revisit, f"0:{int(j / STRETCH_IMAGES)}"))
    return claims


def peer_matches(path):
    """Reads matches of another system: a CSV of query,match,score with 0-based images."""
    with path.open() as file:
        return [Match(0, round(0.25e9 * int(r["match"])), 0, round(0.25e9 * int(r["query"])), float(r["score"])) for r in csv.DictReader(file)]


def summary(name, claims, is_calibrated=True):
    wrong_most = max((claim.probability for claim in claims if claim.right is False), default=-1.0)
    revisits = [claim for claim in claims if claim.revisit]
    counts = []
    for low, high in ((0.99, 1.0), (0.9, 0.99), (0.05, 0.9)) if is_calibrated else ():
        some = [claim.right for claim in claims if low < claim.probability <= high and claim.right is not None]
        counts += [str(len(some)), str(sum(some))]
    first = [claim for claim in revisits if claim.right]
    recall = f"{sum(claim.probability > wrong_most for claim in first) / len(revisits):.0%}" if revisits else ""
    return [*name, str(len(claims)), str(len(revisits)), str(len(first)), recall, *(counts or [""] * 6)]


class Bench:
    def __init__(self, model, folder, models, probabilities, peers):
        self.model, self.folder, self.models, self.probabilities, self.peers = model, folder, models, probabilities, peers
        self.rows, self.claims = [], []  # claims: (world, drives, Claim) with all evidence

    def add(self, world, drives, inputs, judge, keep=lambda match: match.drive_b > 0, options=(), is_pooled=True, evidences=tuple(EVIDENCE)):
        print(f"looks for {world}, {drives}", file=sys.stderr)
        for evidence, switches in ((each, EVIDENCE[each]) for each in evidences):
            found = matches(self.model, inputs, self.folder / "matches.csv", (*switches, *options))
            claims = judge([match for match in found if keep(match)])
            self.rows.append(summary((world, drives, evidence), claims))
        self.claims += [(world, drives, claim) for claim in claims if is_pooled]

    def add_days(self, world, drives, bags, **options):
        self.add(world, drives, bags, lambda found: judged(found, bags, True), **options)

    def two_days(self):
        for case in TWO_DAYS:
            world, seed, duration = case.split(":")
            bags = [drive(self.folder, world, seed, duration, day) for day in (1, 2)]
            for drives, options, is_pooled in (("two days", (), True), ("two days, in the first alone", FIRST_DAY_ALONE, False)):
                self.add_days(world, drives, bags, options=options, is_pooled=is_pooled)

    def reversed(self):
        world, seed, duration = REVERSED.split(":")
        bags = [drive(self.folder, world, seed, duration), drive(self.folder, world, seed, RETURN_SECONDS, 2, "return")]
        self.add(world, "two days, reversed", bags, lambda found: judged(found, bags, True, only_opposite=True), options=FIRST_DAY_ALONE)

    def left_images(self):
        world, seed, duration = LEFT_IMAGES.split(":")
        if rosbag is None:
            sys.exit("left images need python3-rosbag")
        whole = [drive(self.folder, world, seed, duration, day, sensors="stereo") for day in (1, 2)]
        self.add(world, "two days, left images", [left_images(bag) for bag in whole], lambda found: judged(found, whole, True), options=("--topic", f"left:={LEFT_TOPIC}"))

    def lights(self):
        for case in LIGHTS:
            world, seed, first, second = case.split(":")
            by_day = drive(self.folder, world, seed, first)
            for light in ("day", "dusk", "night"):
                bags = [by_day, drive(self.folder, world, seed, second, 2, light=light)]
                self.add_days(world, f"two days, the second {'by day' if light == 'day' else f'at {light}'}", bags, is_pooled=False, evidences=tuple(EVIDENCE)[-1:])

    def one_day(self):
        world, seed, duration = ONE_DAY.split(":")
        bags = [simulated_bag(self.folder / f"{world}_{seed}_{duration}s.bag", world, seed, duration, "--sensors", "ladybug")]
        self.add(world, "one day", bags, lambda found: judged(found, bags, True), keep=lambda match: True)

    def strangers(self):
        for case in OTHER_SITES:
            world, drives = case.split(":", 1)
            bags = [drive(self.folder, world, *each.split(":")) for each in drives.split(",")]
            self.add(world, "strangers", bags, lambda found, bags=bags: judged(found, bags, False), keep=lambda match: match.drive_a != match.drive_b)

    def real_images(self):
        source = Path(os.environ.get("URBAN_NAV_DATA", "")) / "places/malaga_07"
        if not source.is_dir():
            print("URBAN_NAV_DATA names no folder with places/malaga_07: no real images", file=sys.stderr)
            return
        with (source / "truth.csv").open() as file:
            truth = list(csv.DictReader(file))
        images = self.folder / "route"
        images.mkdir(exist_ok=True)
        for row in truth:
            link = images / Path(row["image"]).name
            if not link.exists():
                link.symlink_to(source / "images" / link.name)
        stamps = [0.25 * i for i in range(len(truth))]
        (images / "times.txt").write_text("".join(f"{stamp}\n" for stamp in stamps))
        positions = [float(row["position"]) for row in truth]
        self.add("streets, a car", "one day, single images", [images], lambda found: evaluated_images(found, positions, stamps), keep=lambda match: True)
        for other in self.models:
            name, model = other.split("=", 1)
            found = matches(model, [images], self.folder / "matches.csv", ())
            self.rows.append(summary(("streets, a car", "one day, single images", name), evaluated_images(found, positions, stamps)))
        for peers, is_calibrated in ((self.probabilities, True), (self.peers, False)):
            for peer in peers:
                name, path = peer.split("=", 1)
                self.rows.append(summary(("streets, a car", "one day, single images", name), evaluated_images(peer_matches(Path(path)), positions, stamps), is_calibrated))

    def write_claims(self):
        with (self.folder / "claims.csv").open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(CLAIM_COLUMNS)
            for world, drives, claim in self.claims:
                verdict = {True: "right", False: "wrong", None: "neither"}[claim.right]
                writer.writerow((world, drives, claim.probability, verdict, claim.stretch))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of simulated sessions; existing bags are used")
    parser.add_argument("--kind", action="append", choices=KINDS, help="repeatable (default: all)")
    parser.add_argument("--model", default="default")
    parser.add_argument("--other-model", action="append", default=[], metavar="NAME=MODEL", help="another model for the real images; repeatable")
    parser.add_argument("--probabilities", action="append", default=[], metavar="NAME=FILE.csv", help="as --peer, with calibrated probabilities as scores, of fabmap_node-bench-opencv_features; repeatable")
    parser.add_argument("--peer", action="append", default=[], metavar="NAME=FILE.csv", help="what another system says of the real images: query,match,score, images counted from 0; repeatable")
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    measured = commit()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    bench = Bench(arguments.model, arguments.folder, arguments.other_model, arguments.probabilities, arguments.peer)
    for kind in arguments.kind or KINDS:
        getattr(bench, kind.replace(" ", "_"))()
    bench.write_claims()
    if len(arguments.kind or KINDS) > 1:
        bench.rows.append(summary(("all", "", "+ second look"), [claim for _, _, claim in bench.claims]))
    show(COLUMNS, bench.rows, ["Right within 7.5 m, wrong beyond 10 m, distances between are not counted; every match of unrelated places is wrong. All: without the rows in the first day alone. Real images: within 3 images, beyond 20. "
                               "Otherwise default mask and parameters."], measured, arguments.output)


if __name__ == "__main__":
    main()
