# SPDX-License-Identifier: BSD-3-Clause
"""Whether probabilities of places are true: of claims of 80 %, are 80 % right? From the claims.csv of places.py, of all worlds, days, strangers and real images in it together.

Neighbouring claims are alike, and are right or wrong together. So a stretch of 10 m (5 single images) gives one claim to each range of probabilities, the first; intervals follow from their
number (Wilson, 95 %). --table adds the counts of a table of places.py whose claims were not kept: three ranges, in which twenty claims count as one, as they do in calibration.
"""
import argparse
import csv
import json
import math
from collections import namedtuple
from pathlib import Path

from support import commit, show

COLUMNS = ("claims of", "stated", "claims", "right", "one for each stretch", "right", "stated, mean", "share that is right", "95 % interval", "fewest right in 99 of 100 cases, if as stated")
LIMITS = (0.0, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0)

ALL_EVIDENCE, RANGES = "+ second look", (("0.05 to 0.9", 0.05, 0.9), ("0.9 to 0.99", 0.9, 0.99), ("above 0.99", 0.99, 1.0))  # of a table of places.py
ALIKE = 20

Claim = namedtuple("Claim", "source probability right stretch")
Bin = namedtuple("Bin", "low high claims right stretches stretches_right stated")


def wilson(right, number, z=1.959964):
    """Interval of a share, of which `right` of `number` are known (Wilson 1927)."""
    centre, spread = (right + z * z / 2) / (number + z * z), z * math.sqrt(right * (number - right) / number + z * z / 4) / (number + z * z)
    return max(0.0, centre - spread), min(1.0, centre + spread)


def fewest(number, probability, level=0.01):
    """The largest k that a binomial count stays below in at most `level` of all cases."""
    total = 0.0
    for k in range(number + 1):
        total += math.comb(number, k) * probability**k * (1.0 - probability) ** (number - k)
        if total > level:
            return k
    return number


def read_claims(path):
    with path.open() as file:
        return [Claim(f"{row['world']}, {row['drives']}", float(row["probability"]), row["verdict"] == "right", row["stretch"])
                for row in csv.DictReader(file) if row["verdict"] != "neither"]


def binned(claims):
    bins = []
    for low, high in zip(LIMITS, LIMITS[1:]):
        some = [claim for claim in claims if low < claim.probability <= high or (low == claim.probability == 0.0)]
        first = list({(claim.source, claim.stretch): claim for claim in reversed(some)}.values())
        if first:
            bins.append(Bin(low, high, len(some), sum(claim.right for claim in some), len(first), sum(claim.right for claim in first),
                            sum(claim.probability for claim in first) / len(first)))
    return bins


def tabled(table):
    """(low, high, claims, right) of the ranges of a table of places.py, with all evidence."""
    rows = [row for row in table["rows"] if row[2] == ALL_EVIDENCE and row[0] != "all"]
    counts = []
    for name, low, high in RANGES:
        at = table["columns"].index(name)
        claims, right = (sum(int(row[k]) for row in rows) for k in (at, at + 1))
        if claims:
            counts.append((low, high, claims, right))
    return counts


def tabled_interval(claims, right):
    return wilson(right / ALIKE, claims / ALIKE)


def calibration_error(bins):
    """Mean distance of stated probability and share, of claims over 0.5."""
    sure = [each for each in bins if each.low >= 0.5]
    number = sum(each.stretches for each in sure)
    return sum(abs(each.stated * each.stretches - each.stretches_right) for each in sure) / number if number else 0.0


def row_of(name, each):
    low, high = wilson(each.stretches_right, each.stretches)
    return [name, f"{each.low:g} to {each.high:g}", str(each.claims), str(each.right), str(each.stretches), str(each.stretches_right), f"{each.stated:.3f}",
            f"{each.stretches_right / each.stretches:.3f}", f"{low:.3f} to {high:.3f}", str(fewest(each.stretches, each.stated))]


def row_of_table(name, low, high, claims, right):
    interval = "{:.3f} to {:.3f}".format(*tabled_interval(claims, right))
    return [name, f"{low:g} to {high:g}", str(claims), str(right), "", "", "", f"{right / claims:.3f}", interval, ""]


def draw_claims(axes, name, bins):
    stated, right = [each.stated for each in bins], [each.stretches_right / each.stretches for each in bins]
    intervals = [wilson(each.stretches_right, each.stretches) for each in bins]
    spread = [[max(0.0, r - low) for r, (low, _) in zip(right, intervals)], [max(0.0, high - r) for r, (_, high) in zip(right, intervals)]]
    axes.errorbar(stated, right, spread, fmt="o", color="#1f4e9e", ecolor="#7fa3d8", capsize=3, markersize=5, label=name)
    for each, x, y, (low, _) in zip(bins, stated, right, intervals):
        sure = x > 0.9  # room is left under the interval only
        axes.annotate(f"{each.stretches_right} of {each.stretches}", (x, low if sure else y), xytext=(-4, -9) if sure else (7, 5), textcoords="offset points", fontsize=8, color="#1f4e9e",
                      ha="right" if sure else "left")


def draw_table(axes, name, counts):
    for low, high, claims, right in counts:
        share, interval = right / claims, tabled_interval(claims, right)
        axes.fill_between([low, high], *([value, value] for value in interval), color="#d9744f", alpha=0.25, linewidth=0)
        axes.plot([low, high], [share, share], color="#d9744f", linewidth=3, solid_capstyle="butt", label=name)
        axes.annotate(f"{right} of {claims}", (min(0.5 * (low + high), 0.88), share), xytext=(0, -3 if low > 0.8 else -13), textcoords="offset points", fontsize=8, color="#a04a28",
                      ha="right" if low > 0.8 else "center")
        name = None


def draw(path, bins, counts, names):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(6.0, 5.2))
    axes.plot([0, 1], [0, 1], color="#888888", linestyle="--", linewidth=1, label="as stated")
    draw_table(axes, names[1], counts)
    draw_claims(axes, names[0], bins)
    axes.set(xlabel="stated probability", ylabel="share that is right", xlim=(-0.02, 1.02), ylim=(-0.03, 1.05))
    axes.legend(loc="upper left", frameon=False, fontsize=9)
    axes.grid(color="#e6e6e6")
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("claims", type=Path)
    parser.add_argument("--table", type=Path, help="JSON of places.py")
    parser.add_argument("--name", default="all", help="what the claims are of (default: all)")
    parser.add_argument("-o", "--output", type=Path, help="the table, for a README")
    parser.add_argument("--picture", type=Path, help="the diagram, PNG; needs python3-matplotlib")
    arguments = parser.parse_args()
    measured = commit()
    bins = binned(read_claims(arguments.claims))
    counts = tabled(json.loads(arguments.table.read_text())) if arguments.table else []
    names = (arguments.name, "simulated panoramas, in three ranges")
    rows = [*(row_of(names[0], each) for each in bins), *(row_of_table(names[1], *each) for each in counts)]
    notes = [f"A stretch of 10 m (5 single images) counts once in each range. Calibration error of claims over 0.5, {names[0]}: {calibration_error(bins):.3f}."]
    if counts:
        notes.append(f"Simulated panoramas: two days and strangers, three worlds; in their intervals {ALIKE} neighbouring claims count as one.")
    show(COLUMNS, rows, notes, measured, arguments.output)
    if arguments.picture:
        draw(arguments.picture, bins, counts, names)


if __name__ == "__main__":
    main()
