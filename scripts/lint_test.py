#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of lint: each rule on a small tree that keeps it and one that breaks it."""
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).parent))
import lint  # noqa: E402  pylint: disable=wrong-import-position
from lint import folders, words  # noqa: E402  pylint: disable=wrong-import-position


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
        self.check(lint.long_lines, {"a_cpp": "x" * 120 + '\nconst char* a = R"(' + "x" * 121 + ')";\n'}, {"a_cpp": "x" * 121 + "\n"})
        self.assertEqual(len(breaches(lint.long_lines, a_cpp='auto a = "' + "x" * 111 + '";\n')), 1)
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
        low, high = folders.COMMAND_FOLDERS[0][0], folders.COMMAND_FOLDERS[-1][0]
        self.check(lint.command_includes, {f"src__urban_nav__src__{high}__a_cpp": f'#include "{low}/b.hpp"\n'},
                   {f"src__urban_nav__src__{low}__a_cpp": f'#include "{high}/b.hpp"\n'})

    def test_words_and_names(self):
        self.check(lint.long_readmes, {"p__README_md": "word " * 1200}, {"p__README_md": "word " * 1201})
        self.check(lint.ros_spelling, {"launch__localization_launch": ""}, {"launch__localise_launch": ""})
        many = "".join(f"int x{chr(97 + i)}Of() {{ return 0; }}\n" for i in range(21))
        self.assertEqual(breaches(lint.of_functions, a_cpp=many.split("\n", 1)[1]), [])
        self.assertEqual(len(breaches(lint.of_functions, a_cpp=many)), 21)

    def test_words_are_as_many_as_their_ceilings(self):
        table = words.Table("# a comment: 3\nbelieve 3: believe believes believed\nis none 1: /\\bis none\\b/\n")

        def found(**files):
            return [breach.split(",")[0] for breach in lint.word_counts(tree(**files), table)]

        self.assertEqual(found(a_cpp="believed isBelieved unbelievable", p__README_md="It believes; a rotation is none.",
                               scripts__lint_py="believe"), [])
        self.assertEqual(found(a_msg="believe believes believed beLIEVE", b_hpp="kBelieved  // is none"), ["believe: 4 times"])
        self.assertEqual(found(a_cpp="believed believed", b_md="is none"), ["believe: 2 times"], "a ceiling above today's number")
        self.assertEqual(found(a_cpp="believed " * 3 + "this none"), ["is none: 0 times"])

    def test_ceilings_only_fall(self):
        table = words.Table("# words\nbelieve 3: believe\nway 5: way ways")
        self.assertEqual(table.lowered({"believe": 2, "way": 9}), "# words\nbelieve 2: believe\nway 5: way ways")

    def test_constants_are_of_one_style(self):
        good = """
namespace n {
constexpr double kNear = 1.0, kFar{2.0};
inline constexpr std::array<int, 2> kSizes = {1, 2};
const Pose kT_base_camera(1.0), kOrigin;
const char* const kName = "a";
extern "C" const unsigned char begin_of_file[];
const char* last_message = nullptr;
const Table<int>& table();
constexpr int square(int x) { return x * x; }
template <int N>
constexpr int size(const int (&)[N]) { return N; }
struct Box {
  static constexpr int kSide = 3;
  static const Table& table(int x);
  constexpr explicit Box(int a) : a_{a} {}
  const int width = 4;
  int a_;
};
void f(const int x) {
  constexpr int kSteps = 4;
  const int steps = kSteps;
  if constexpr (kSteps > 3) g(steps);
}
}
"""
        self.assertEqual(breaches(lint.constant_names, p__a_cpp=good), [])
        bad = {"kNear": "near", "kFar": "far", "kSizes": "sizes", "kT_base_camera": "T_base_camera", "kOrigin": "origin", "kName = ": "text = ",
               "kSide": "side", "kSteps": "steps_at_most"}
        for new, old in bad.items():
            expected = "T_base_camera" if old == "origin" else old.split(" ")[0]
            if old != "origin":  # the second constant after arguments is not seen
                self.assertEqual(breaches(lint.constant_names, p__a_cpp=good.replace(new, old)), [f"p/a.cpp: {expected}"])

    def test_tests_are_named_in_upper_camel_case(self):
        self.check(lint.test_names, {"a_cpp": "TEST(Box, HasTwoSides) {\n}\nTYPED_TEST(Box2, A) {}\nTEST_P(Box, DISABLED_Grows) {}\n"},
                   {"a_cpp": "TEST_F(Box, hasSides) {\n}\n"})

    def test_topics_are_named_in_one_place(self):
        header = {"src__urban_nav_ros__include__urban_nav_ros__topics_hpp": 'constexpr const char* kCloud = "map/cloud", *kClock = "/clock";'}
        self.check(lint.topic_names,
                   {"a__src__b_cpp": '#include "map/cloud.hpp"\n// "map/cloud"\nauto s = "the map/cloud", t = "maps/cloud", u = topics::kCloud;',
                    "a__test__b_cpp": 'keep("map/cloud");', **header},
                   {"a__nodelet__b_cpp": 'auto s = "/map/tiles";', **header})
        self.assertEqual(len(breaches(lint.topic_names, a__src__b_cpp='f("/clock", "map/cloud", "clock");', **header)), 2)
        self.assertEqual(breaches(lint.topic_names, a__src__b_cpp='\n  p = nh.advertise<A>("battery", 1); t.add("battery");', **header),
                         ['a/src/b.cpp:2: "battery"'])

    def test_only_some_folders_open_recordings(self):
        opened = "rosbag::Bag bag;"
        self.check(lint.bag_readers, {"src__urban_nav_input__src__a_cpp": opened, "src__urban_nav__src__convert__a_cpp": opened,
                                      "src__urban_nav__test__a_cpp": opened}, {"src__urban_nav_sim__nodelet__a_cpp": opened})

    def test_states_of_closures_are_no_strings(self):
        self.check(lint.closure_states, {"p__src__a_cpp": 'x == Verdict::Accepted || y == "icp2"', "p__test__a_cpp": 'x == "accepted"'},
                   {"p__src__a_cpp": 'if (row.verdict == "accepted")'})

    def test_renamed_names_do_not_come_back(self):
        glossary = "## Renamed\n| old | new |\n|---|---|\n| `OldName`, `older` | `NewName` |\n| `Moment` (core) | `Time` |\n"
        self.check(lint.old_names, {"docs__glossary_md": glossary, "a_cpp": "struct Moment { NewName x; };  // OldName\n"},
                   {"docs__glossary_md": glossary, "a_cpp": "struct A { OldName x; };\n"})

    def test_nodelets_are_short_and_of_ros(self):
        ros = "#include <ros/ros.h>\n"
        self.check(lint.nodelet_includes, {"p__nodelet__a_hpp": ros, "p__nodelet__a_cpp": '#include "a.hpp"\n'}, {"p__nodelet__b_cpp": "int x;\n"})
        self.check(lint.nodelet_lines, {"q__nodelet__a_cpp": "\n" * 150, "q__nodelet__b_hpp": "\n" * 150}, {"src__q__nodelet__a_cpp": "\n" * 301})
        package, most = next(iter(folders.NODELET_LINES.items()))
        path = f"{package.replace('/', '__')}__nodelet__a_cpp"
        self.check(lint.nodelet_lines, {path: "\n" * (most - 49)}, {path: "\n" * (most + 1)})
        self.assertEqual(len(breaches(lint.nodelet_lines, **{path: "\n" * (most - 50)})), 1, "a limit above today's number")


class Links(unittest.TestCase):
    def test_links_lead_to_files_and_headings(self):
        page = "# A `b` page\n\n## How good, it is\n"
        text = "[a](docs/page.md) [b](docs/page.md#how-good-it-is) [c](#top) [d](docs) [e](https://b.c/d)\n# Top\n"
        self.assertEqual(breaches(lint.broken_links, README_md=text, docs__page_md=page), [])
        self.assertEqual(breaches(lint.broken_links, README_md="[a](docs/none.md)\n```\n[b](c.md)\n```\n[d](docs/page.md#how-good)\n", docs__page_md=page),
                         ["README.md: docs/none.md: there is no such file", "README.md: docs/page.md#how-good: there is no such heading"])


class Versions(unittest.TestCase):
    def test_packages_have_the_version_of_the_change_log(self):
        package = "<package><version>{}</version></package>"
        log = "# Changes\n\n## 1.2.3 (today)\n\n## 1.2.2\n"
        self.assertEqual(breaches(lint.versions, CHANGELOG_md=log, a__package_xml=package.format("1.2.3")), [])
        self.assertEqual(breaches(lint.versions, CHANGELOG_md=log, a__package_xml=package.format("1.2.2")),
                         ["a/package.xml: version 1.2.2, in CHANGELOG.md 1.2.3"])
        self.assertEqual(len(breaches(lint.versions, CHANGELOG_md="## next\n")), 1)
        self.assertEqual(len(breaches(lint.versions)), 1)


if __name__ == "__main__":
    unittest.main()
