# SPDX-License-Identifier: BSD-3-Clause
"""The package as a whole: names, docstrings, stubs, time of import, the folder for PYTHONPATH, and the example."""
import ast
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import urban_nav

sys.path.insert(0, str(Path(__file__).resolve().parent))
from case import PROGRAM, FolderCase, stereo_bag  # noqa: E402

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "first_map.ipynb"


def public_names(tree):
    """{name: names of its public functions} of the classes and functions in a module."""
    names = {}
    for node in tree.body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and not node.name.startswith("_"):
            body = node.body if isinstance(node, ast.ClassDef) else []
            names[node.name] = {each.name for each in body if isinstance(each, ast.FunctionDef) and not each.name.startswith("_")}
    return names


class Package(FolderCase):
    def test_every_public_name_has_a_docstring(self):
        for name in urban_nav.__all__:
            thing = getattr(urban_nav, name)
            self.assertTrue((thing.__doc__ or "").strip(), name)
            for member in vars(thing) if isinstance(thing, type) and not issubclass(thing, tuple) else ():
                if not member.startswith("_") and member not in getattr(thing, "__slots__", ()):
                    self.assertTrue((getattr(thing, member).__doc__ or "").strip(), f"{name}.{member}")

    def test_stubs_name_what_the_module_has(self):
        folder = Path(urban_nav.__file__).parent
        self.assertTrue((folder / "py.typed").exists())
        stubs = public_names(ast.parse((folder / "__init__.pyi").read_text()))
        self.assertEqual(set(stubs), set(urban_nav.__all__))
        sources = {}
        for path in folder.glob("_*.py"):
            sources.update(public_names(ast.parse(path.read_text())))
        for name, members in stubs.items():
            self.assertEqual(members, sources[name], name)

    def test_import_is_quick(self):
        code = "import time, numpy; a = time.process_time(); import urban_nav; print(time.process_time() - a)"
        spent = min(float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout) for _ in range(3))
        self.assertLess(spent, 0.3)

    def test_the_program_names_a_folder_that_works(self):
        done = subprocess.run([str(PROGRAM), "--python-path"], capture_output=True, text=True, check=True)
        environment = {**os.environ, "PYTHONPATH": done.stdout.strip()}
        code = "import urban_nav; print(urban_nav.__file__)"
        found = subprocess.run(["/usr/bin/python3", "-c", code], capture_output=True, text=True, env=environment, cwd=self.folder, check=True)
        self.assertEqual(Path(found.stdout.strip()), Path(urban_nav.__file__))


class Example(FolderCase):
    def test_its_cells_run(self):
        import matplotlib

        matplotlib.use("Agg")
        stereo_bag(self.folder / "session.bag", 3)
        cells = [cell for cell in json.loads(EXAMPLE.read_text())["cells"] if cell["cell_type"] == "code"]
        self.assertGreater(len(cells), 3)
        names = {}
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        for cell in cells:
            exec(compile("".join(cell["source"]), EXAMPLE.name, "exec"), names)
        self.assertGreater(names["summary"]["frames"], 10)
        self.assertTrue((self.folder / "trajectory.png").stat().st_size > 1000)


if __name__ == "__main__":
    import rosunit
    rosunit.unitrun("urban_nav_python", "package", "__main__")
