#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the commands in the documents against the programs that they call.

    scripts/document_commands.py [--program FILE] [DOCUMENT...]        all READMEs and docs/ by default
    scripts/document_commands.py --run DOCUMENT...                     runs them, too

Commands are the lines of code blocks without a language or with `sh`, and code spans that begin with a program's name. Of `urban_nav`
the subcommand, its options, words with a fixed list of values and the parameters of --set are compared with --help and --help-all; of
`roslaunch` and `rosrun` the package, file or program, and the arguments; of scripts of the repository the options.

--run executes the `sh` blocks of the documents in their order, from the top of the repository and with --program in place of ./urban_nav.
It leaves out blocks marked `sh not-run` (a robot, a ROS master, or a recording of the reader's own) and ends at the first failure.

Exit status 0 if no command is wrong.
"""
import argparse
import re
import shlex
import subprocess
import sys
import xml.etree.ElementTree as xml
from functools import lru_cache
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build" / "ws" / "devel" / "lib" / "urban_nav" / "urban_nav"
BLOCK = re.compile(r"^```([^\n]*)\n(.*?)^```\s*$", re.S | re.M)
SPAN = re.compile(r"(?<!`)`([^`]+)`(?!`)")
URBAN_NAV = re.compile(r"(?:(?:\./|(?:\.\./)+)|\S*/)?urban_nav$")
STARTS = re.compile(r"(?:(?:\./|(?:\.\./)+)?urban_nav |roslaunch |rosrun |(?:\./)?run_(?:demo|tests)\.sh)")
PLACEHOLDER = re.compile(r"[A-Z][A-Z0-9_]*(?:\.\.\.)?$")
SEPARATORS = {"&&", "||", ";", "|", "&", "(", ")"}
IGNORED_PARTS = ("CHANGELOG.md",)


def commands_of(text):
    """(line number, command, is run) of the commands of a document, without comments, continued lines joined."""
    found = []
    for block in BLOCK.finditer(text):
        info = block.group(1).split()
        if info and info[0] not in ("sh", "bash"):
            continue
        line = text.count("\n", 0, block.start()) + 2
        number, joined = line, ""
        for row in block.group(2).split("\n"):
            joined = joined + row if joined else row
            if joined.endswith("\\"):
                joined = joined[:-1]
            else:
                if joined.strip():
                    found.append((number, joined.strip(), info == ["sh"]))
                number, joined = line + 1, ""
            line += 1
    prose = BLOCK.sub(lambda block: "\n" * block.group(0).count("\n"), text)
    for span in SPAN.finditer(prose):
        command = " ".join(span.group(1).split()).replace("\\|", "|")
        if STARTS.match(command):
            found.append((prose.count("\n", 0, span.start()) + 1, command, False))
    return sorted(found)


def split_command(command):
    """The simple commands of a line, each as its words; substitutions are commands of their own."""
    inner = re.findall(r"\$\(([^()]*)\)", command)
    simple = [words for part in inner for words in split_command(part)]
    lexer = shlex.shlex(re.sub(r"\$\([^()]*\)", "SUBSTITUTED", command), posix=True, punctuation_chars=True)
    lexer.whitespace_split = True
    words = []
    for word in [*lexer, ";"]:
        if word in SEPARATORS:
            if words:
                simple.append(words)
            words = []
        elif words or not re.match(r"\w+=", word):
            words.append(word)
    return simple


class Help:
    """What the text of --help lists: actions, options, positional words and their values."""

    def __init__(self, text):
        self.actions, self.takes_value, self.values = set(), {}, {}
        usage = re.search(r"^usage: \S+ (.*?)(?: {2,}.*)?$", text, re.M)
        self.positional = [word for word in (usage.group(1).split() if usage else []) if re.fullmatch(r"[A-Z0-9]+(?:\.\.\.)?", word)]
        for line in text.split("\n\n", 2)[-1].splitlines():
            option = re.match(r"  (?:(-\w) )?(--[\w-]+)(?: (\S+))?(?:  |$)", line)
            action = re.match(r"  ([a-z][\w-]*) +[A-Z]", line)
            word = re.match(r"  ([A-Z0-9]+)(?:\.\.\.)?  +(.*)$", line)
            if option:
                self.takes_value.update({name: option.group(3) is not None for name in option.groups()[:2] if name})
            elif action:
                self.actions.add(action.group(1))
            elif word:
                values = re.search(r": ([a-z][\w-]*(?:, [a-z][\w-]*)+)$", word.group(2))
                self.values[word.group(1)] = set(values.group(1).split(", ")) if values else None


class Checker:
    """Compares commands with the help texts of `urban_nav` and the launch files below a root."""

    def __init__(self, root, help_of):
        """help_of(words): the output of urban_nav with these words, None where there is no program."""
        self.root = root
        self.help_of = lru_cache(maxsize=None)(help_of)

    def faults(self, command):
        """A sentence for each word of the command that does not exist."""
        try:
            simple = split_command(command)
        except ValueError as error:
            yield f"is not a command of a shell: {error}"
            return
        for words in simple:
            name = words[0]
            if URBAN_NAV.match(name):
                yield from self.urban_nav(words[1:])
            elif name in ("roslaunch", "rosrun"):
                yield from (self.roslaunch if name == "roslaunch" else self.rosrun)(words[1:])
            elif re.search(r"\.(?:sh|py)$", name) and not PLACEHOLDER.match(name):
                yield from self.script(name, words[1:])

    def urban_nav(self, words):
        if words[:1] and words[0].startswith("-") or self.help_of(("--help",)) is None:
            return
        listed = Help(self.help_of(("--help",)))
        if not words or PLACEHOLDER.match(words[0]):
            return
        if words[0] not in listed.actions:
            yield f"urban_nav has no command {words[0]}"
            return
        path, words = words[:1], words[1:]
        text = self.help_of((*path, "--help"))
        if re.search(r"^usage: .* ACTION \[options\] .*ACTION --help", text, re.M) and words[:1] and re.match(r"[a-z]", words[0]):
            if words[0] not in Help(text).actions:
                yield f"urban_nav {path[0]} has no action {words[0]}"
                return
            path, words = [*path, words[0]], words[1:]
            text = self.help_of((*path, "--help"))
        yield from self.arguments(" ".join(path), words, Help(text), tuple(path))

    def arguments(self, name, words, listed, path):
        places = [re.sub(r"\.\.\.$", "", word) for word in listed.positional]
        at = 0
        words = [word.strip("[]") for word in words]
        while words:
            word = words.pop(0)
            option, given, value = word.partition("=")
            if re.match(r"--?[A-Za-z]", word):
                if option not in listed.takes_value and option not in ("--help", "--help-all", "-h"):
                    yield f"urban_nav {name} has no option {option}"
                elif listed.takes_value.get(option):
                    value = value if given else (words.pop(0) if words else "")
                    if option == "--set":
                        yield from self.parameter(path, value)
                continue
            values = listed.values.get(places[at]) if at < len(places) else None
            if values and word and not PLACEHOLDER.match(word) and re.match(r"[a-z]", word) and word not in values:
                yield f"urban_nav {name}: {word} is not one of {', '.join(sorted(values))}"
            at += 1

    def parameter(self, path, setting):
        key = setting.partition("=")[0]
        if re.search(r"[A-Z]", key):
            return
        if not re.search(rf"^  {re.escape(key)} = ", self.help_of((*path, "--help-all")), re.M):
            yield f"urban_nav {' '.join(path)} has no parameter {key}"

    def package(self, name):
        for folder in (self.root / name, self.root / "src" / name, *([self.root / "launch"] if name == "urban_nav_launch" else [])):
            if (folder / "package.xml").is_file():
                return folder
        return None

    def roslaunch(self, words):
        words = [word for word in words if not word.startswith("-")]
        if len(words) < 2 or not words[0].startswith("urban_nav_"):
            return
        folder = self.package(words[0])
        file = next(iter(folder.glob(f"**/{words[1]}")), None) if folder else None
        if file is None:
            yield f"{words[0]} has no launch file {words[1]}"
            return
        declared = {arg.get("name") for arg in xml.parse(file).getroot().iter("arg") if arg.get("value") is None}
        for word in words[2:]:
            name, given, _ = word.partition(":=")
            if given and name not in declared:
                yield f"{words[1]} has no argument {name}"

    def rosrun(self, words):
        folder = self.package(words[0]) if words else None
        if folder and len(words) > 1:
            programs = {path.stem for path in folder.rglob("*") if path.is_file()}
            names = "".join(path.read_text() for path in folder.rglob("CMakeLists.txt"))
            if words[1] not in programs and not re.search(rf"\b{re.escape(words[1])}\b", names):
                yield f"{words[0]} has no program {words[1]}"
        elif words[:3] == ["nodelet", "nodelet", "standalone"] and len(words) > 3:
            yield from self.nodelet(words[3], words[4:])

    def nodelet(self, name, words):
        folder = self.package(name.split("/")[0])
        plugins = folder / "nodelet_plugins.xml" if folder else None
        if plugins is None or not plugins.is_file() or f'name="{name}"' not in plugins.read_text():
            yield f"there is no nodelet {name}"
            return
        documented = "".join(path.read_text() for path in folder.glob("*.md"))
        for word in words:
            key, given, _ = word.partition(":=")
            if given and key.startswith("_") and not re.search(rf"^\| `(?:\w+\.)*{re.escape(key[1:])}` \|", documented, re.M):
                yield f"{name} has no parameter {key[1:]}"

    def script(self, name, words):
        path = self.root / re.sub(r"^(?:\.\./)+|^\./", "", name)
        if not path.is_file():
            if name.startswith(("./", "scripts/")):
                yield f"there is no script {name}"
            return
        text = path.read_text()
        for word in words:
            if word.startswith("--") and word.partition("=")[0] not in text:
                yield f"{name} has no option {word.partition('=')[0]}"


def documents(root):
    names = subprocess.run(["git", "ls-files", "-z", "*.md"], cwd=root, capture_output=True, text=True, check=True).stdout.split("\0")
    return [root / name for name in names if name and name not in IGNORED_PARTS]


def run(document, program):
    """Runs the blocks marked `sh`; returns whether all commands ended with status 0."""
    for number, command, is_run in commands_of(document.read_text()):
        if not is_run:
            continue
        print(f"{document.name}:{number}: {command}", flush=True)
        called = re.sub(r"(?:^|(?<=\s))\./urban_nav(?=\s)", shlex.quote(str(program)), command)
        done = subprocess.run(["bash", "-c", called], cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=False)
        if done.returncode != 0:
            print(f"{document.name}:{number}: exit status {done.returncode}", file=sys.stderr)
            return False
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, default=PROGRAM, help="urban_nav; default: that of the workspace")
    parser.add_argument("--run", action="store_true", help="executes the commands of the documents that are named")
    parser.add_argument("documents", nargs="*", type=Path)
    options = parser.parse_args()
    if options.run and not options.documents:
        parser.error("--run: the documents to run are missing")
    if not options.program.is_file():
        print(f"{options.program} is not built: commands of urban_nav are not checked", file=sys.stderr)

    def help_of(words):
        if not options.program.is_file():
            return None
        return subprocess.run([str(options.program), *words], capture_output=True, text=True, check=True).stdout

    checker = Checker(ROOT, help_of)
    chosen = [path.resolve() for path in options.documents] or documents(ROOT)
    failed = False
    for path in chosen:
        for number, command, _ in commands_of(path.read_text()):
            for fault in checker.faults(command):
                name = path.relative_to(ROOT) if path.is_relative_to(ROOT) else path
                print(f"{name}:{number}: {fault}", file=sys.stderr)
                failed = True
    if options.run and not failed:
        failed = not all(run(path, options.program) for path in chosen)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
