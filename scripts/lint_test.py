#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of lint.py: each rule on a small tree that keeps it and one that breaks it."""
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).parent))
import lint  # noqa: E402  pylint: disable=wrong-import-position


def tree(**files):
    """A tree of these files; `__` in a name stands for a slash, the last `_` for the dot."""
    text = {".".join(name.replace("__", "/").rsplit("_", 1)): content for name, content in files.items()}
    return SimpleNamespace(files=list(text), text=text, sources=[lint.Source(f, t) for f, t in text.items() if f.endswith((".cpp", ".hpp"))])


def breaches(rule, **files):
    return list(rule(tree(**files)))


class Scanner(unittest.TestCase):
    CODE = """
namespace a::b {
enum class Colour { Red, Green };
template <typename T, class U = int>
class Box : public Base<T> {
 public:
  struct Inner { int x{0}; };
  explicit Box(int n) : size_{n}, name_("}") {
    if (n > 0) { size_ = 1; }
  }
 private:
  int size_;
};
namespace {
constexpr double near = 1.0, far{2.0};  // { not a brace
const char* const brace = "{", quote = '"';
using Words = std::vector<std::string>;
std::function<double(int)> handler(const std::string& key, int n = 3) {
  return [n](int i) { return i + n; };
}
}  // namespace
int Box<int>::size() const { return 1'000; }
}
"""

    def setUp(self):
        self.source = lint.Source("a.cpp", self.CODE)

    def test_finds_types_with_what_is_around_them(self):
        self.assertEqual(self.source.types, [("a::b", "Colour", False), ("a::b", "Box", False), ("a::b::Box", "Inner", False)])

    def test_finds_functions_with_their_lines(self):
        self.assertEqual(self.source.functions, [("Box", 3), ("handler", 3), ("Box::size", 1)])

    def test_finds_names_in_unnamed_namespaces(self):
        self.assertEqual([(kind, name) for _, kind, name, _ in self.source.unnamed],
                         [("variable", "near"), ("variable", "far"), ("variable", "brace"), ("variable", "quote"), ("alias", "Words"),
                          ("function", "handler")])
        self.assertEqual(self.source.unnamed[-1][3], "const std::string&, int")


class Rules(unittest.TestCase):
    def check(self, rule, good, bad):
        self.assertEqual(breaches(rule, **good), [])
        self.assertEqual(len(breaches(rule, **bad)), 1)

    def test_lines_and_files(self):
        self.check(lint.long_lines, {"a_cpp": "x" * 120 + "\n"}, {"a_cpp": "x" * 121 + "\n"})
        self.check(lint.long_files, {"a_cpp": "\n" * 499}, {"a_cpp": "\n" * 500})
        body = "void f() {\n" + "  g();\n" * 60 + "}\n"
        self.check(lint.long_functions, {"a_cpp": body.replace("  g();\n", "", 5)}, {"a_cpp": body})

    def test_a_type_is_defined_once(self):
        one = "namespace n { struct Pair { int a; }; }"
        self.check(lint.double_types, {"a_hpp": one, "b_hpp": "namespace m { struct Pair {}; } namespace n { struct Pair; }"},
                   {"a_hpp": one, "b_hpp": "namespace n { class Pair {}; }"})

    def test_unnamed_names_are_unique_in_a_target(self):
        one = "namespace n { namespace { constexpr int most = 1; } }"
        self.check(lint.unity_names, {"p__src__a_cpp": one, "p__test__b_cpp": one}, {"p__src__a_cpp": one, "p__src__b_cpp": one})
        overload = "namespace n { namespace { int f(%s x) { return 0; } } }"
        self.check(lint.unity_names, {"p__src__a_cpp": overload % "int", "p__src__b_cpp": overload % "const A&"},
                   {"p__src__a_cpp": overload % "int", "p__src__b_cpp": overload % "int"})

    def test_unnamed_helpers_do_not_hide_those_of_a_header(self):
        header, test = "namespace n { inline int view(const M& m) { return 0; } }", "namespace n { namespace { int %s(const V& v) { return 0; } } }"
        self.check(lint.unity_names, {"p__test__h_hpp": header, "p__test__a_cpp": test % "other"},
                   {"p__test__h_hpp": header, "p__test__a_cpp": test % "view"})

    def test_gtest_is_named_from_the_root(self):
        self.check(lint.gtest_names, {"a_cpp": "class A : public ::testing::Test {};"}, {"a_cpp": "class A : public testing::Test {};"})

    def test_lower_folders_do_not_include_higher_ones(self):
        low, high = lint.COMMAND_FOLDERS[0][0], lint.COMMAND_FOLDERS[-1][0]
        self.check(lint.command_includes, {f"src__urban_nav__src__{high}__a_cpp": f'#include "{low}/b.hpp"\n'},
                   {f"src__urban_nav__src__{low}__a_cpp": f'#include "{high}/b.hpp"\n'})

    def test_words_and_names(self):
        self.check(lint.long_readmes, {"p__README_md": "word " * 2500}, {"p__README_md": "word " * 2501})
        self.check(lint.ros_spelling, {"launch__localization_launch": ""}, {"launch__localise_launch": ""})
        self.check(lint.word_counts, {"a_cpp": "felt " * 15 + "feltForce " * 0}, {"a_cpp": "felt_force isFelt FeltForce felt " * 4})
        self.assertEqual(breaches(lint.word_counts, a_cpp="toldest behindhand " * 20), [])
        names = "".join(f"int x{chr(97 + i)}Of() {{ return 0; }}\n" for i in range(21))
        self.assertEqual(breaches(lint.of_functions, a_cpp=names.split("\n", 1)[1]), [])
        self.assertEqual(len(breaches(lint.of_functions, a_cpp=names)), 21)

    def test_renamed_names_do_not_come_back(self):
        glossary = "## Renamed\n| old | new |\n|---|---|\n| `OldName`, `older` | `NewName` |\n| `Moment` (core) | `Time` |\n"
        self.check(lint.old_names, {"docs__glossary_md": glossary, "a_cpp": "struct Moment { NewName x; };  // OldName\n"},
                   {"docs__glossary_md": glossary, "a_cpp": "struct A { OldName x; };\n"})

    def test_nodelets_are_short_and_of_ros(self):
        ros = "#include <ros/ros.h>\n"
        self.check(lint.nodelet_includes, {"p__nodelet__a_hpp": ros, "p__nodelet__a_cpp": '#include "a.hpp"\n'}, {"p__nodelet__b_cpp": "int x;\n"})
        self.check(lint.nodelet_lines, {"swf_vo__nodelet__a_cpp": "\n" * 300}, {"swf_vo__nodelet__a_cpp": "\n" * 301})


if __name__ == "__main__":
    unittest.main()
