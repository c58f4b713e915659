#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs one command of a job of the workflow, with its output in a log.

A recording that cannot be mapped is a result, not an error: OUTPUT then holds {"failed": REASON, "exit_status": N}. A
command that is killed, or fails in any other job, makes the job fail, so that the engine repeats it. Two runs of one
job never overlap: the log stays locked until the command ends, also if the engine does not live as long.
"""
import argparse
import fcntl
import json
import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from fleet import sessions

ERROR = "error: "  # begins the errors that urban_nav prints
UNSUITABLE = (1, 2)  # exit statuses of urban_nav: the data, or what was asked for


def run(command, log):
    """Runs a command, appends its output to a log that no other run writes; returns its exit status, 128 + N if it was
    killed by signal N."""
    log = Path(log)
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("ab") as file:
        fcntl.flock(file, fcntl.LOCK_EX)  # held by the command too, which inherits the file
        file.truncate(0)
        status = subprocess.run(command, stdout=file, stderr=file, check=False).returncode
    return status if status >= 0 else 128 - status


def write_json(path, content):
    """Writes a file that is complete whenever it is there."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(path.name + ".part")
    part.write_text(json.dumps(content, indent=2, ensure_ascii=False) + "\n")
    os.replace(part, path)


def error_in(log):
    """Returns the error that a command printed last; its last line if it printed none."""
    lines = [line.strip() for line in Path(log).read_text(errors="replace").splitlines() if line.strip()]
    errors = [line[len(ERROR):] for line in lines if line.startswith(ERROR)]
    return (errors or lines or ["no output"])[-1]


def map_recording(arguments):
    output = Path(arguments.output)
    output.unlink(missing_ok=True)
    status = run(arguments.command, arguments.log)
    if status in UNSUITABLE and not output.exists():  # with map --strict it is there
        write_json(output, {"failed": error_in(arguments.log), "exit_status": status})
    return 0 if status in (0, *UNSUITABLE) else status


def examine(arguments):
    output = Path(arguments.output)
    output.unlink(missing_ok=True)
    status = run(arguments.command, arguments.log)
    if status in UNSUITABLE and not output.exists():
        write_json(output, {"usable": False, "sessions": [], "findings": [], "failed": error_in(arguments.log)})
    return 0 if status in (0, *UNSUITABLE) else status


def run_command(arguments):
    status = run(arguments.command, arguments.log)
    if status:
        sys.stderr.write(f"exit status {status}: {error_in(arguments.log)} ({arguments.log})\n")
    return status


def plan(arguments):
    stores, failed = sessions.split_summaries(arguments.summaries)
    for name, reason in failed.items():
        sys.stderr.write(f"{name}: left out: {reason}\n")
    if not stores:
        sys.stderr.write(f"expected a recording that can be mapped, found {len(failed)} that cannot\n")
        return 1
    folder = Path(arguments.output).parent
    shutil.rmtree(folder, ignore_errors=True)  # pieces of an earlier plan
    arguments.command = [*shlex.split(arguments.program), "join", *stores.values(), "--plan", str(folder), "--threads",
                         str(arguments.threads)]
    return run_command(arguments)


def list_sessions(arguments):
    doctors = {Path(report).stem: report for report in arguments.doctor}
    rows = sessions.list_states(arguments.summaries, arguments.plan, arguments.joined, doctors)
    write_json(arguments.output, {"sessions": rows})
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    steps = parser.add_subparsers(required=True, metavar="STEP")
    for name, function, text in (("map", map_recording, "maps a recording"), ("doctor", examine, "examines a recording"),
                                 ("run", run_command, "runs any command")):
        step = steps.add_parser(name, help=text)
        step.set_defaults(function=function)
        step.add_argument("--output", required=True, help="what the command writes last")
        step.add_argument("--log", required=True)
        step.add_argument("command", nargs="+")
    step = steps.add_parser("plan", help="plans the join of the recordings that were mapped")
    step.set_defaults(function=plan)
    step.add_argument("--output", required=True, help="plan.json")
    step.add_argument("--log", required=True)
    step.add_argument("--program", required=True)
    step.add_argument("--threads", type=int, default=1)
    step.add_argument("summaries", nargs="+")
    step = steps.add_parser("list", help="lists the state of each recording")
    step.set_defaults(function=list_sessions)
    step.add_argument("--output", required=True, help="fleet.json")
    step.add_argument("--plan", required=True)
    step.add_argument("--joined", required=True, help="the summary of join --finish")
    step.add_argument("--doctor", nargs="*", default=[], help="the reports of doctor, NAME.json each")
    step.add_argument("summaries", nargs="+")
    arguments = parser.parse_args()
    return arguments.function(arguments)


if __name__ == "__main__":
    sys.exit(main())
