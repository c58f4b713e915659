# SPDX-License-Identifier: BSD-3-Clause
"""The package as a whole: names, docstrings, stubs, time of import, and the folder for PYTHONPATH."""
import ast
import os
import subprocess
import sys
from pathlib import Path

import urban_nav

sys.path.insert(0, str(Path(__file__).resolve().parent))
from case import PROGRAM, FolderCase  # noqa: E402


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
            self.assertTrue((getattr(urban_nav, name).__doc__ or "").strip(), name)
        for name in ("kind", "topics", "start_ns", "end_ns", "warnings", "messages"):
            self.assertTrue((getattr(urban_nav.Recording, name).__doc__ or "").strip(), name)

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


if __name__ == "__main__":
    import rosunit
    rosunit.unitrun("urban_nav_python", "package", "__main__")
