#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Holds the sources against the rules of the house; prints each breach, or the count of a rule that does not hold yet.

Exit status 0 if no enforced rule is broken. `--all` prints the breaches of the others as well; `--rule NAME` applies one;
`--lower` writes the present numbers into the table of words where they are below its ceilings.
"""
import argparse
import sys

from lint import COUNTED, RULES, Tree, words


def lower_ceilings(tree):
    table = words.Table(words.TABLE.read_text())
    words.TABLE.write_text(table.lowered(words.count_words(tree, table)[0]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--lower", action="store_true")
    parser.add_argument("--rule", action="append", choices=[rule.__name__ for rule in RULES])
    arguments = parser.parse_args()
    tree = Tree()
    if arguments.lower:
        lower_ceilings(tree)
    failed = False
    for rule in RULES:
        if arguments.rule and rule.__name__ not in arguments.rule:
            continue
        breaches = list(rule(tree))
        enforced = rule.__name__ not in COUNTED
        if breaches and (enforced or arguments.all or arguments.rule):
            print(f"{rule.__name__}: {rule.__doc__}")
            for breach in breaches:
                print(f"  {breach}")
        elif breaches:
            print(f"{rule.__name__}: not yet, {len(breaches)}")
        failed = failed or (enforced and bool(breaches))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
