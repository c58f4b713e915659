#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks how programs and libraries were linked: check_binaries.py FOLDER...

Every ELF file below the folders must look for libraries in absolute folders or beside itself alone (an empty element of the list is the
current folder, whose files anybody may have put there), settle addresses of functions at its start (BIND_NOW, RELRO), and, if it is a
program, be loaded at any address (PIE). A file as large as the suite's cores must also hold guards of the stack, as
-fstack-protector-strong makes them, and some file the checked functions of _FORTIFY_SOURCE. Exit status 1 and one line for each fault."""
import os
import subprocess
import sys

LARGE = 300_000  # bytes of a file in which some function has an array on the stack


def elf_files(folders):
    for folder in folders:
        for place, _, names in os.walk(folder):
            for path in sorted(os.path.join(place, name) for name in names):
                if os.path.islink(path) or not os.path.isfile(path):
                    continue
                with open(path, "rb") as file:
                    if file.read(4) == b"\x7fELF":
                        yield path


def read_elf(path):
    return subprocess.run(["readelf", "-W", "-h", "-l", "-d", "--dyn-syms", path], check=True, capture_output=True,
                          text=True, env={**os.environ, "LC_ALL": "C"}).stdout


def find_faults(text, size):
    """Faults of a file in the output of readelf."""
    faults = []
    for line in text.splitlines():
        if "(RUNPATH)" in line or "(RPATH)" in line:
            elements = line[line.index("[") + 1:line.rindex("]")].split(":")
            faults += [f"looks for libraries in \"{e}\", a folder that depends on the current one" for e in elements
                       if not e.startswith(("/", "$ORIGIN"))]
    is_program = "INTERP" in text
    if "BIND_NOW" not in text:
        faults.append("is linked without -z now")
    if "GNU_RELRO" not in text:
        faults.append("is linked without -z relro")
    if is_program and "Type:                              DYN" not in text:
        faults.append("is no position-independent program")
    if size > LARGE and "__stack_chk_fail" not in text:
        faults.append("is compiled without -fstack-protector-strong")
    return faults


def is_fortified(text):
    """Whether a function is called whose checks _FORTIFY_SOURCE adds. That of the stack has another flag."""
    return any("_chk@" in line and "__stack_chk" not in line for line in text.splitlines())


def main(folders):
    if not folders:
        print(__doc__, file=sys.stderr)
        return 2
    texts = {path: read_elf(path) for path in elf_files(folders)}
    faults = [f"{path}: {fault}" for path, text in texts.items() for fault in find_faults(text, os.path.getsize(path))]
    if not texts:
        faults.append(f"{', '.join(folders)}: no programs or libraries")
    elif not any(is_fortified(text) for text in texts.values()):
        faults.append(f"{', '.join(folders)}: all is compiled without -D_FORTIFY_SOURCE")
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
