# SPDX-License-Identifier: BSD-3-Clause
"""Reliability of probabilities of places: the share of correct claims by stated probability. From claims.csv of places.py: all worlds, days, strangers and real images together, and by kind of images.

Neighbouring claims are alike, and are right or wrong together. So a stretch of 10 m (5 single images) gives one claim to each range of probabilities, the first; intervals follow from their
number (Wilson, 95 %).
"""
import argparse
import csv
import math
from collections import namedtuple
from pathlib import Path

from support import commit, show

COLUMNS = ("claims of", "stated", "claims", "right", "one for each stretch", "right", "stated, mean", "share that is right", "95 % interval", "fewest right in 99 of 100 cases, if as stated")
LIMITS = (0.0, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0)
REAL = "streets, a car"  # world of the real images in claims.csv
KINDS = {"all": lambda claim: True, "single images of real streets": lambda claim: claim.source.startswith(REAL), "simulated drives": lambda claim: not claim.source.startswith(REAL)}
COLOURS = {"single images of real streets": ("#1f4e9e", "#7fa3d8"), "simulated drives": ("#a04a28", "#d9744f")}  # of dots and bars

Claim = namedtuple("Claim", "source probability right stretch")
Bin = namedtuple("Bin", "low high claims right stretches stretches_right stated")


def wilson(right, number, z=1.959964):
    """Returns the interval of a share with `right` of `number` (Wilson 1927)."""
    centre, spread = (right + z * z / 2) / (number + z * z), z * math.sqrt(right * (number - right) / number + z * z / 4) / (number + z * z)
    return max(0.0, centre - spread), min(1.0, centre + spread)


def fewest(number, probability, level=0.01):
    """Returns the largest k that a binomial count is below with a probability of at most `level`."""
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


def calibration_error(bins):
    """Mean distance of stated probability and share, of claims over 0.5."""
    sure = [each for each in bins if each.low >= 0.5]
    number = sum(each.stretches for each in sure)
    return sum(abs(each.stated * each.stretches - each.stretches_right) for each in sure) / number if number else 0.0


def row_of(name, each):
    low, high = wilson(each.stretches_right, each.stretches)
    return [name, f"{each.low:g} to {each.high:g}", str(each.claims), str(each.right), str(each.stretches), str(each.stretches_right), f"{each.stated:.3f}",
            f"{each.stretches_right / each.stretches:.3f}", f"{low:.3f} to {high:.3f}", str(fewest(each.stretches, each.stated))]


def draw(path, bins):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(6.0, 5.2))
    axes.plot([0, 1], [0, 1], color="#888888", linestyle="--", linewidth=1, label="as stated")
    for name, (dots, bars) in COLOURS.items():
        some = bins[name]
        stated, right = [each.stated for each in some], [each.stretches_right / each.stretches for each in some]
        intervals = [wilson(each.stretches_right, each.stretches) for each in some]
        spread = [[max(0.0, r - low) for r, (low, _) in zip(right, intervals)], [max(0.0, high - r) for r, (_, high) in zip(right, intervals)]]
        axes.errorbar(stated, right, spread, fmt="o", color=dots, ecolor=bars, capsize=3, markersize=5, label=name)
        for each, x, (low, high) in zip(some, stated, intervals):
            at, aside, align = ((x, low), (-4, -10), "right") if x > 0.9 else ((x, high), (0, 4), "center")
            axes.annotate(f"{each.stretches_right} of {each.stretches}", at, xytext=aside, textcoords="offset points", fontsize=8, color=dots, ha=align)
    axes.set(xlabel="stated probability", ylabel="share that is right", xlim=(-0.02, 1.02), ylim=(-0.03, 1.08))
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, 0.97), frameon=False, fontsize=9)
    axes.grid(color="#e6e6e6")
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("claims", type=Path)
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    parser.add_argument("--picture", type=Path, help="the diagram, PNG; needs python3-matplotlib")
    arguments = parser.parse_args()
    measured = commit()
    claims = read_claims(arguments.claims)
    bins = {name: binned([claim for claim in claims if of_kind(claim)]) for name, of_kind in KINDS.items()}
    rows = [row_of(name, each) for name, some in bins.items() for each in some]
    errors = ", ".join(f"{name} {calibration_error(some):.3f}" for name, some in bins.items())
    show(COLUMNS, rows, [f"A stretch of 10 m (5 single images) counts once in each range. Calibration error of claims over 0.5: {errors}."], measured, arguments.output)
    if arguments.picture:
        draw(arguments.picture, bins)


if __name__ == "__main__":
    main()
