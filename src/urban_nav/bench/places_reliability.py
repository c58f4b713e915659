# SPDX-License-Identifier: BSD-3-Clause
"""Whether probabilities of places are true: of claims of 80 %, are 80 % right? From the claims.csv of places.py, of all worlds, days, strangers and real images together.

Neighbouring claims are alike, and are right or wrong together. So a stretch of 10 m gives one claim to each range of probabilities, the first; intervals follow from their number (Wilson, 95 %).
"""
import argparse
import csv
import math
from collections import namedtuple
from pathlib import Path

from support import commit, show

COLUMNS = ("stated", "claims", "right", "one for each stretch", "right", "stated, mean", "share that is right", "95 % interval", "fewest right in 99 of 100 cases, if as stated")
LIMITS = (0.0, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0)

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


def calibration_error(bins):
    """Mean distance of stated probability and share, of claims over 0.5."""
    sure = [each for each in bins if each.low >= 0.5]
    number = sum(each.stretches for each in sure)
    return sum(abs(each.stated * each.stretches - each.stretches_right) for each in sure) / number if number else 0.0


def row_of(each):
    low, high = wilson(each.stretches_right, each.stretches)
    return [f"{each.low:g} to {each.high:g}", str(each.claims), str(each.right), str(each.stretches), str(each.stretches_right), f"{each.stated:.3f}",
            f"{each.stretches_right / each.stretches:.3f}", f"{low:.3f} to {high:.3f}", str(fewest(each.stretches, each.stated))]


def draw(bins, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, (shares, counts) = pyplot.subplots(2, 1, figsize=(6.0, 6.6), height_ratios=(3, 1), sharex=True)
    shares.plot([0, 1], [0, 1], color="#888888", linestyle="--", linewidth=1, label="as stated")
    stated, right = [each.stated for each in bins], [each.stretches_right / each.stretches for each in bins]
    intervals = [wilson(each.stretches_right, each.stretches) for each in bins]
    shares.errorbar(stated, right, [[max(0.0, r - low) for r, (low, _) in zip(right, intervals)], [max(0.0, high - r) for r, (_, high) in zip(right, intervals)]],
                    fmt="o", color="#1f4e9e", ecolor="#7fa3d8", capsize=3, markersize=5, label="measured, 95 % interval")
    for each, x, y in zip(bins, stated, right):
        on_the_right = x < 0.8
        shares.annotate(f"{each.stretches_right} of {each.stretches}", (x, y), xytext=(7 if on_the_right else -7, -3), textcoords="offset points", fontsize=8, color="#333333",
                        ha="left" if on_the_right else "right")
    shares.set_ylabel("share that is right")
    shares.set_ylim(-0.03, 1.03)
    shares.legend(loc="upper left", frameon=False, fontsize=9)
    shares.grid(color="#e6e6e6")
    edges = [each.low for each in bins]
    widths = [each.high - each.low for each in bins]
    counts.bar(edges, [each.right for each in bins], widths, align="edge", color="#5b9e5b", edgecolor="white", label="right")
    counts.bar(edges, [each.claims - each.right for each in bins], widths, [each.right for each in bins], align="edge", color="#d9744f", edgecolor="white", label="wrong")
    counts.set_xlabel("stated probability")
    counts.set_ylabel("claims")
    counts.set_xlim(-0.02, 1.02)
    counts.legend(loc="upper center", frameon=False, fontsize=9, ncols=2)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("claims", type=Path)
    parser.add_argument("-o", "--output", type=Path, help="the table, for a README")
    parser.add_argument("--picture", type=Path, help="the diagram, PNG; needs python3-matplotlib")
    arguments = parser.parse_args()
    measured = commit()
    claims = read_claims(arguments.claims)
    bins = binned(claims)
    sources = sorted({claim.source for claim in claims})
    show(COLUMNS, [row_of(each) for each in bins],
         [f"{len(claims)} claims of {len(sources)} comparisons. A stretch of 10 m (single images: 5 of them) counts once in each range. Calibration error of claims over 0.5: {calibration_error(bins):.3f}."],
         measured, arguments.output)
    if arguments.picture:
        draw(bins, arguments.picture)


if __name__ == "__main__":
    main()
