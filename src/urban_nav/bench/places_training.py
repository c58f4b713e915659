# SPDX-License-Identifier: BSD-3-Clause
"""Duration of training of words and tree by `urban_nav places train` from panoramas, including features, without calibration.

Each SRC is a bag with panoramas, or a folder of images; none should be given twice, since equal panoramas are learnt quickly.
"""
import argparse
import os
import re
import subprocess
import tempfile
import time
from pathlib import Path

from support import TOP, commit, show

COLUMNS = ("step", "size", "processor time, s", "on a machine busy with other work, s")
STEPS = ("vocabulary", "Chow-Liu tree")
FEATURES = re.compile(r"(.+): (\d+) images in ")


def processor_s(process):
    """Returns the processor time of all threads."""
    fields = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("src", type=Path, nargs="+")
    parser.add_argument("--words", type=int, default=10000)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("-o", "--output", type=Path, help="output table for a README")
    arguments = parser.parse_args()
    measured = commit()
    panoramas, moments = 0, []
    with tempfile.TemporaryDirectory() as folder:
        command = [TOP / "urban_nav", "places", "train", *arguments.src, "--words", arguments.words, "--threads", arguments.threads, "-o", Path(folder) / "model"]
        begun = time.monotonic()
        process = subprocess.Popen(list(map(str, command)), stderr=subprocess.PIPE, text=True)
        for line in process.stderr:
            now = processor_s(process), time.monotonic() - begun
            if found := FEATURES.match(line):
                panoramas += int(found[2])
                moments[:] = [now]
            elif any(line.startswith(f"{step}: 100 %") for step in STEPS):
                moments.append(now)
            if len(moments) > len(STEPS):
                break
        process.kill()
    if len(moments) <= len(STEPS):
        parser.error("the training failed: try `urban_nav places train` with these inputs")
    names = ((f"features of {panoramas} panoramas", "decoding included"), ("words", str(arguments.words)), ("Chow-Liu tree", ""))
    before = ((0.0, 0.0), *moments)
    rows = [[*name, *(f"{b - a:.0f}" for a, b in zip(earlier, later))] for name, earlier, later in zip(names, before, moments)]
    rows.append(["all", f"{arguments.threads} threads", *(f"{value:.0f}" for value in moments[-1])])
    show(COLUMNS, rows, ["Processor time of all threads: with two free cores, training takes half of it or somewhat more."], measured, arguments.output)


if __name__ == "__main__":
    main()
