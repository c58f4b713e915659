// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/yaml.hpp"

#include "io/reader_check.hpp"

namespace urban_nav_core {
namespace {

TEST(Yaml, IsATreeWithLineNumbers) {
  const YamlNode root = parseYaml("a: 1\n\nb:\n  - x\n  - [1, 2.5]\nc: {d: ~}\n", "f.yaml");
  ASSERT_EQ(root.kind, YamlNode::Kind::Map);
  EXPECT_EQ(root.find("a")->scalar, "1");
  EXPECT_EQ(root.find("b")->line, 3);
  EXPECT_EQ(root.find("b")->list[1].list[1].scalar, "2.5");
  EXPECT_EQ(root.find("b")->list[1].line, 5);
  EXPECT_EQ(root.find("c")->find("d")->kind, YamlNode::Kind::Null);
  EXPECT_EQ(root.find("z"), nullptr);
  EXPECT_EQ(parseYaml("", "f.yaml").kind, YamlNode::Kind::Null);
}

TEST(Yaml, KeepsDoubledKeys) { EXPECT_EQ(parseYaml("a: 1\na: 2\n", "f").map.size(), 2U); }

TEST(Yaml, ReadsAfterOpenCvsHeader) {
  const YamlNode root = parseYaml("%YAML:1.0\n# comment\nrate_hz: 20\n", "sensor.yaml");
  EXPECT_EQ(requireNumber(root, "rate_hz", "sensor.yaml"), 20.0);
  EXPECT_EQ(root.find("rate_hz")->line, 3);
}

TEST(Yaml, NamesFileLineAndKey) {
  EXPECT_EQ(catchError([] { parseYaml("a: [1\nb: 2\n", "f.yaml"); }).rfind("f.yaml:", 0), 0U);
  EXPECT_EQ(catchError([] { parseYaml("? [1]\n: 2\n", "f.yaml"); }).rfind("f.yaml:1: a key that is not a word", 0), 0U);
  const YamlNode root = parseYaml("a: x\nb: [1, nan]\n", "f.yaml");
  EXPECT_EQ(catchError([&] { requireNumber(root, "z", "f.yaml"); }), "f.yaml:1: no key `z`");
  EXPECT_EQ(catchError([&] { requireNumber(root, "a", "f.yaml"); }), "f.yaml:1: a = x: expected a number");
  EXPECT_EQ(catchError([&] { requireNumbers(root, "b", 3, "f.yaml"); }),
            "f.yaml:2: b has 2 elements: expected 3 numbers in a list");
  EXPECT_EQ(catchError([&] { requireNumbers(root, "b", 2, "f.yaml"); }),
            "f.yaml:2: b holds `nan`: expected 2 numbers in a list");
}

TEST(Yaml, BombsAreRefused) {
  std::string deep = "a: ";
  for (int i = 0; i < 100; ++i) deep += "[";
  EXPECT_NE(catchError([&] { parseYaml(deep + std::string(100, ']'), "f"); }), "");
  std::string laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    laughs += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) laughs += (k == 0 ? "" : ", ") + before;
    laughs += "]\n";
  }
  EXPECT_NE(catchError([&] { parseYaml(laughs, "f"); }).find("too many values"), std::string::npos);
}

TEST(Yaml, Fuzzed) {
  expectSurvives(
      testing::fuzzText({"a: 1\nb:\n  - x\n  - [1, 2.5]\nc: {d: ~, e: \"q\"}\n", "%YAML:1.0\nx: &x [1, 2]\ny: *x\n"},
                        [](const std::string& text) { parseYaml(text, "f"); }));
}

}  // namespace
}  // namespace urban_nav_core
