#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Which packages a change selects, in small repositories of twelve packages."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import affected

# Package -> what it depends on, by kind of dependency.
PACKAGES = {
    "src/urban_nav_core": {},
    "src/urban_nav_store": {"depend": ["urban_nav_core"]},
    "sim": {"depend": ["urban_nav_core"]},
    "vo": {"depend": ["urban_nav_core"]},
    "loops": {"build_depend": ["urban_nav_store"]},
    "places": {"depend": ["urban_nav_store"]},
    "localization": {"test_depend": ["places"]},
    "graph": {"depend": ["urban_nav_core"]},
    "drivers": {"depend": ["urban_nav_core"]},
    "rviz": {},
    "src/urban_nav": {"depend": ["vo", "loops", "places", "graph", "drivers"]},
    "launch": {"exec_depend": ["urban_nav", "sim", "rviz", "localization"]},
}
ALL = {name.split("/")[-1] for name in PACKAGES}


def package_xml(name, depends):
    rows = "".join(f"<{kind}>{other}</{kind}>" for kind, others in depends.items() for other in others)
    return f'<package format="2"><name>{name}</name><buildtool_depend>catkin</buildtool_depend>{rows}</package>'


class Selection(unittest.TestCase):
    def setUp(self):
        self.root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
        author = {"GIT_AUTHOR_NAME": "a", "GIT_AUTHOR_EMAIL": "a@b", "GIT_COMMITTER_NAME": "a", "GIT_COMMITTER_EMAIL": "a@b"}
        patched = mock.patch.dict(os.environ, environment | author | {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1"}, clear=True)
        patched.start()
        self.addCleanup(patched.stop)
        self.git("init", "-q")
        for folder, depends in PACKAGES.items():
            self.write(f"{folder}/package.xml", package_xml(folder.split("/")[-1], depends))
            self.write(f"{folder}/src/a.cpp", "int a;\n" * 20)
            self.write(f"{folder}/README.md", "# A\n")
        self.write("README.md", "# Suite\n")
        self.write("docs/files.md", "# Files\n")
        self.write("run_tests.sh", "true\n")
        self.write(".gitignore", "/build\n")
        self.base = self.commit()

    def git(self, *arguments):
        return subprocess.run(["git", *arguments], cwd=self.root, check=True, capture_output=True, text=True).stdout.strip()

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text)

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-q", "--allow-empty", "-m", "change")
        return self.git("rev-parse", "HEAD")

    def select(self, commit=None):
        return affected.select(self.root, self.base if commit is None else commit)

    def expect_everything(self, reason, commit=None):
        selection = self.select(commit)
        self.assertRegex(selection.everything, reason)
        self.assertEqual(selection.lines(), ["everything"])
        self.assertIn("everything", selection.reasons()[0])

    def expect_tested(self, *names):
        selection = self.select()
        self.assertEqual(selection.everything, "")
        self.assertEqual(set(selection.tested), set(names))
        self.assertEqual([line for line in selection.lines() if line.startswith("test ")], [f"test {name}" for name in sorted(names)])
        self.assertTrue(all(any(line.startswith(f"{name} ") for line in selection.reasons()) for name in names))

    def test_nothing_changed(self):
        self.expect_tested()
        self.assertEqual(self.select().reasons(), ["no package is tested: none changed"])

    def test_a_package_with_its_dependents_and_the_command(self):
        self.write("vo/src/a.cpp", "int b;\n")
        self.commit()
        self.expect_tested("vo", "urban_nav", "launch")
        self.assertEqual(self.select().tested, {"vo": "vo/src/a.cpp changed", "urban_nav": "it depends on vo", "launch": "it depends on urban_nav"})

    def test_dependents_by_build_run_and_test(self):
        self.write("places/config/places.yaml", "a: 1\n")
        self.expect_tested("places", "localization", "urban_nav", "launch")
        shutil.rmtree(self.root / "places/config")
        self.write("loops/src/a.cpp", "int b;\n")
        self.expect_tested("loops", "urban_nav", "launch")
        self.git("checkout", "-q", "loops")
        self.write("sim/src/a.cpp", "int b;\n")
        self.expect_tested("sim", "launch", "urban_nav")

    def test_the_command_though_it_does_not_depend_on_the_change(self):
        self.write("rviz/rviz/a.rviz", "a: 1\n")
        self.expect_tested("rviz", "launch", "urban_nav")
        self.assertEqual(self.select().tested["urban_nav"], "it is the command")

    def test_what_the_tests_need_is_built_with_its_dependencies(self):
        self.write("localization/README.md", "# B\n")
        self.assertEqual(self.select().lines(), ["test localization", "build localization", "build places", "build src/urban_nav_core",
                                                 "build src/urban_nav_store"])

    def test_changes_that_are_not_committed_or_not_even_added(self):
        self.write("vo/src/a.cpp", "int b;\n")
        self.expect_tested("vo", "urban_nav", "launch")
        self.git("add", "-A")
        self.expect_tested("vo", "urban_nav", "launch")
        self.git("reset", "-q", "--hard")
        self.write("vo/src/new.cpp", "int b;\n")
        self.expect_tested("vo", "urban_nav", "launch")
        (self.root / "vo/src/new.cpp").unlink()
        self.write("build/ws/file", "")
        self.expect_tested()

    def test_the_tree_counts_and_not_the_history(self):
        self.write("vo/src/a.cpp", "int b;\n")
        self.commit()
        self.git("revert", "--no-edit", "HEAD")
        self.expect_tested()
        self.git("checkout", "-q", "--orphan", "other")
        self.write("graph/src/a.cpp", "int b;\n")
        self.commit()
        self.expect_tested("graph", "urban_nav", "launch")

    def test_a_file_that_moved_counts_for_both_packages(self):
        self.git("mv", "vo/src/a.cpp", "graph/src/b.cpp")
        self.expect_tested("vo", "graph", "urban_nav", "launch")
        self.commit()
        self.expect_tested("vo", "graph", "urban_nav", "launch")

    def test_a_deleted_package_counts_for_those_that_depended_on_it(self):
        shutil.rmtree(self.root / "places")
        self.write("localization/package.xml", package_xml("localization", {}))
        self.write("src/urban_nav/package.xml", package_xml("urban_nav", {"depend": ["vo", "loops", "graph", "drivers"]}))
        self.expect_tested("localization", "urban_nav", "launch")
        self.git("checkout", "-q", "localization", "src/urban_nav")
        self.commit()
        self.assertEqual(self.select().tested["localization"], "it depends on places")

    def test_a_renamed_package_counts_under_both_names(self):
        self.write("places/package.xml", package_xml("place_recognition", {"depend": ["urban_nav_store"]}))
        self.write("launch/package.xml", package_xml("launch", {"exec_depend": ["place_recognition"]}))
        self.commit()
        self.expect_tested("place_recognition", "localization", "urban_nav", "launch")

    def test_a_package_that_moved_to_another_folder(self):
        self.git("mv", "vo", "src/vo")
        self.commit()
        self.expect_tested("vo", "urban_nav", "launch")
        self.assertIn("build src/vo", self.select().lines())

    def test_a_new_package(self):
        self.write("radar/package.xml", package_xml("radar", {"depend": ["vo"]}))
        self.expect_tested("radar", "urban_nav")
        self.assertIn("build vo", self.select().lines())

    def test_documents_of_a_package_select_it_alone(self):
        self.write("vo/README.md", "# B\n")
        self.write("graph/bench/results/speed.json", "{}\n")
        self.write("src/urban_nav_core/README.md", "# B\n")
        self.expect_tested("vo", "graph", "urban_nav_core")

    def test_documents_at_the_top_select_the_packages_whose_tests_read_them(self):
        self.write("docs/files.md", "# Other\n")
        self.write("README.md", "# Other\n")
        self.expect_tested()
        self.write("graph/src/a.cpp", 'open("docs/files.md");\n')
        self.write("graph/test/a_test.py", '(top / "docs" / "files.md").read_text()\n')
        self.write("vo/test/a_test.cpp", "// documented elsewhere\n")
        self.base = self.commit()
        self.write("docs/files.md", "# Another\n")
        self.expect_tested("graph")

    def test_the_ground_the_scripts_and_the_build_select_everything(self):
        for path in ("src/urban_nav_core/src/a.cpp", "src/urban_nav_store/test/a.cpp", "src/urban_nav_core/cmake/x.cmake", "scripts/lib.sh",
                     "run_tests.sh", ".ci/run", "packages.apt", "src/loose.cpp", ".clang-tidy"):
            with self.subTest(path):
                self.write(path, "other\n")
                self.expect_everything(path)
                self.git("reset", "-q", "--hard")
                self.git("clean", "-qfd")

    def test_a_renamed_ground_package(self):
        self.write("src/urban_nav_store/package.xml", package_xml("shelf", {"depend": ["urban_nav_core"]}))
        self.expect_everything("ground package urban_nav_store")

    def test_more_than_half_of_the_packages(self):
        changed = ["sim", "vo", "loops", "places", "graph", "drivers"]
        for name in changed:
            self.write(f"{name}/src/a.cpp", "int b;\n")
        self.expect_tested(*changed, "localization", "urban_nav", "launch")
        self.write("rviz/src/a.cpp", "int b;\n")
        self.expect_everything("7 of 12 packages")

    def test_the_note_of_what_passed_selects_nothing(self):
        self.write(".ci/passed", self.base + "\n")
        self.commit()
        self.expect_tested()

    def test_an_unknown_commit(self):
        self.expect_everything("0123456789 is not in this repository", "0123456789")
        self.expect_everything("is not in this repository", "f" * 40)

    def test_a_shallow_clone(self):
        self.write("vo/src/a.cpp", "int b;\n")
        self.commit()
        clone = self.root / "build" / "clone"
        self.git("clone", "-q", "--depth", "1", f"file://{self.root}", str(clone))
        self.assertIn("is not in this repository", affected.select(clone, self.base).everything)

    def test_names_that_are_not_of_commits(self):
        for name in ("", "no_such_branch", "--all", "HEAD:README.md"):
            with self.subTest(name), self.assertRaisesRegex(affected.BadCommit, "is not the name of a commit"):
                self.select(name)
        self.assertEqual(self.select("HEAD").tested, {})

    def test_without_a_repository_or_git(self):
        shutil.rmtree(self.root / ".git")
        with mock.patch.dict(os.environ, {"GIT_CEILING_DIRECTORIES": str(self.root.parent)}):
            self.expect_everything("not a git repository")
        with mock.patch.dict(os.environ, {"PATH": ""}):
            self.expect_everything("git is not installed")

    def test_a_package_that_cannot_be_read(self):
        self.write("vo/package.xml", "<package><name>vo</name>")
        self.expect_everything("vo/package.xml: ")


class Repository(unittest.TestCase):
    def test_its_ground_packages_exist_and_the_command_does(self):
        names = set(affected.packages_now(affected.ROOT).needs)
        self.assertIn(affected.COMMAND, names)
        self.assertLessEqual(affected.GROUND, names)

    def test_a_stage_selects_the_command_and_the_launch_files(self):
        packages = affected.packages_now(affected.ROOT)
        selection = affected._with_dependents(packages, packages, {"swf_vo": "swf_vo/src/a.cpp"}, {}, ())
        self.assertEqual(set(selection.tested), {"swf_vo", "urban_nav", "urban_nav_launch", "urban_nav_python"})
        self.assertIn("src/urban_nav_core", selection.built)


class Script(unittest.TestCase):
    def run_tests(self, *arguments):
        return subprocess.run([affected.ROOT / "run_tests.sh", *arguments], capture_output=True, text=True)

    def test_an_argument_that_is_none_is_answered_by_the_usage(self):
        for arguments in (["--since"], ["--since", ""], ["--since", "--tidy"], ["--sense", "HEAD"], ["HEAD"]):
            with self.subTest(arguments):
                done = self.run_tests(*arguments)
                self.assertEqual(done.returncode, 2)
                self.assertIn("./run_tests.sh --since COMMIT", done.stderr)
                self.assertEqual(done.stdout, "")

    def test_continuous_integration_begins_at_the_commit_that_passed(self):
        root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, root)
        (root / ".ci").mkdir()
        shutil.copy(affected.ROOT / ".ci/run", root / ".ci/run")
        (root / "run_tests.sh").write_text('#!/bin/sh\necho "arguments: $*"\n')
        (root / "run_tests.sh").chmod(0o755)
        passed = "0123456789abcdef" * 2 + "01234567"
        for text, arguments in ((None, ""), ("", ""), ("none\n", ""), (passed[1:], ""), (f"{passed}\n{passed}\n", ""), (passed + "\n", f"--since {passed}")):
            with self.subTest(text):
                if text is not None:
                    (root / ".ci/passed").write_text(text)
                done = subprocess.run([root / ".ci/run"], capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stdout), (0, f"arguments: {arguments}\n"))
                self.assertEqual(bool(arguments), ".ci/passed" not in done.stderr)


if __name__ == "__main__":
    unittest.main()
