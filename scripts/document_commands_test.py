#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of document_commands.py: which commands it finds in a document, and which words of them it refuses."""
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import document_commands  # noqa: E402  pylint: disable=wrong-import-position

HELP = {
    ("--help",): "urban_nav: maps.\n\nusage: urban_nav COMMAND [options]\n\n  map       Maps recordings.\n  disparity Matches a pair.\n"
                 "  edge      Edits.\n  places    Recognises.\n\nexit status: 0 done\n",
    ("map", "--help"): "Maps.\n\nusage: urban_nav map INPUT... --out DIR [options]\n\n  INPUT...  recordings (repeatable)\n"
                       "  -o --out DIR               folder\n  --calibrate                lasers, too\n  --set STAGE.KEY=VALUE      one parameter\n\n"
                       "examples:\n  urban_nav map a.bag --out out\n",
    ("map", "--help-all"): "Maps.\n\nall parameters:\n  swf_vo.window = 10  (default)\n      Poses.\n",
    ("disparity", "--help"): "Matches.\n\nusage: urban_nav disparity LEFT RIGHT [options]\n\n  LEFT  image\n  RIGHT  image\n  --rectified  as they are\n",
    ("edge", "--help"): "Edits.\n\nusage: urban_nav edge STORE ACTION ARGUMENT... [options]\n\n  STORE     session.db\n"
                        "  ACTION    reject ID; undo: list, reject, undo\n  ARGUMENT...  what the action takes\n  --sigma M  deviation\n",
    ("places", "--help"): "Places.\n\nusage: urban_nav places ACTION [options]      (urban_nav places ACTION --help says more)\n\n"
                          "  train     Trains.\n  query     Asks.\n",
    ("places", "train", "--help"): "Trains.\n\nusage: urban_nav places train SRC... [options]\n\n  SRC...  folders\n  --words N  size\n",
}


class Found(unittest.TestCase):
    def commands(self, text):
        return [(number, command) for number, command, _ in document_commands.commands_of(text)]

    def test_lines_of_shell_blocks_and_spans_that_call_a_program(self):
        text = "Call `urban_nav\ninfo` or `map`.\n\n```sh\n./urban_nav map \\\n  a.bag\n\ncd b\n```\n```cpp\nurban_nav::map();\n```\n```\n./urban_nav view\n```\n"
        self.assertEqual(self.commands(text), [(1, "urban_nav info"), (5, "./urban_nav map   a.bag"), (8, "cd b"), (14, "./urban_nav view")])

    def test_blocks_that_are_run_are_those_of_the_shell_without_a_mark(self):
        text = "```sh\na\n```\n```sh not-run\nb\n```\n```\nc\n```\n"
        self.assertEqual([is_run for _, _, is_run in document_commands.commands_of(text)], [True, False, False])

    def test_a_line_is_divided_into_simple_commands(self):
        self.assertEqual(document_commands.split_command("A=1 ./urban_nav map 'a b' && cd x  # then"), [["./urban_nav", "map", "a b"], ["cd", "x"]])
        self.assertEqual(document_commands.split_command("PYTHONPATH=$(./urban_nav --python-path) python3"), [["./urban_nav", "--python-path"], ["python3"]])


class Faults(unittest.TestCase):
    def setUp(self):
        self.root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        self.write("launch/package.xml", "<package/>")
        self.write("launch/launch/bag.launch", '<launch><arg name="bag"/><arg name="fixed" value="1"/><group><arg name="rate" default="1"/></group></launch>')
        self.write("src/urban_nav_sim/package.xml", "<package/>")
        self.write("src/urban_nav_sim/nodelet_plugins.xml", '<library><class name="urban_nav_sim/SimulatorNodelet"/></library>')
        self.write("src/urban_nav_sim/README.md", "| parameter |\n| `rate` | `1` |\n| `device.bag` | |\n")
        self.write("drivers/package.xml", "<package/>")
        self.write("drivers/scripts/install_rules", "")
        self.write("run_tests.sh", "case $1 in --since) ;; esac\n")
        self.checker = document_commands.Checker(self.root, HELP.get)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def faults(self, command):
        return list(self.checker.faults(command))

    def test_what_exists_is_accepted(self):
        for command in ("./urban_nav map a.bag --out out --calibrate --set swf_vo.window=5", "../../urban_nav disparity l.png r.png --rectified",
                        "urban_nav edge out/session.db reject 12", "urban_nav edge STORE ACTION ...", "urban_nav places train a b --words 10",
                        "urban_nav COMMAND --help", "urban_nav map --help-all", "urban_nav --version", "urban_nav map INPUT... --out DIR [--calibrate]",
                        "roslaunch urban_nav_launch bag.launch bag:=$PWD/a.bag rate:=2", "rosrun drivers install_rules",
                        "rosrun nodelet nodelet standalone urban_nav_sim/SimulatorNodelet _rate:=0 _bag:=a", "./run_tests.sh --since main", "ls -l"):
            self.assertEqual(self.faults(command), [], command)

    def test_what_does_not_exist_is_named(self):
        for command, fault in (("urban_nav mapp a.bag", "urban_nav has no command mapp"), ("urban_nav map a.bag --output x", "urban_nav map has no option --output"),
                               ("urban_nav places trian a", "urban_nav places has no action trian"),
                               ("urban_nav map a.bag --set swf_vo.windows=5", "urban_nav map has no parameter swf_vo.windows"),
                               ("urban_nav edge out/session.db refuse 12", "urban_nav edge: refuse is not one of list, reject, undo"),
                               ("roslaunch urban_nav_launch bags.launch", "urban_nav_launch has no launch file bags.launch"),
                               ("roslaunch urban_nav_launch bag.launch fixed:=2", "bag.launch has no argument fixed"),
                               ("rosrun drivers remove_rules", "drivers has no program remove_rules"),
                               ("rosrun nodelet nodelet standalone urban_nav_sim/Simulator", "there is no nodelet urban_nav_sim/Simulator"),
                               ("rosrun nodelet nodelet standalone urban_nav_sim/SimulatorNodelet _speed:=1",
                                "urban_nav_sim/SimulatorNodelet has no parameter speed"),
                               ("./run_tests.sh --fast", "./run_tests.sh has no option --fast"), ("scripts/absent.py", "there is no script scripts/absent.py"),
                               ("cd a && urban_nav mapp", "urban_nav has no command mapp"), ("urban_nav map 'a", "is not a command of a shell: No closing quotation")):
            self.assertEqual(self.faults(command), [fault], command)

    def test_without_a_program_launch_files_are_checked_alone(self):
        checker = document_commands.Checker(self.root, lambda words: None)
        self.assertEqual(list(checker.faults("urban_nav mapp")), [])
        self.assertEqual(len(list(checker.faults("roslaunch urban_nav_launch absent.launch"))), 1)


if __name__ == "__main__":
    unittest.main()
