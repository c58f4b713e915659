// SPDX-License-Identifier: BSD-3-Clause
#include "view/edit_words.hpp"

#include <gtest/gtest.h>

#include <random>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

constexpr const char* kAssertion =
    R"({"action": "assert", "arguments": ["day1+3.5", "99.25"], "options": {"pose": "1,0,0,0,0,0,1", "sigma": "0.1,1"}})";

TEST(EditWords, AreThoseOfTheCommandLine) {
  const EditWords words = parseEditWords(kAssertion);
  EXPECT_EQ(words.action, "assert");
  EXPECT_EQ(words.arguments, (std::vector<std::string>{"day1+3.5", "99.25"}));
  EXPECT_EQ(words.options.at("pose"), "1,0,0,0,0,0,1");
  EXPECT_EQ(words.print(), "assert day1+3.5 99.25 --pose 1,0,0,0,0,0,1 --sigma 0.1,1");
  EXPECT_TRUE(parseEditWords(R"({"action": "undo"})").arguments.empty());
  EXPECT_EQ(parseEditWords(R"({"action": "cut", "arguments": ["<b>it's \"é\"</b>", "1"]})").arguments.front(),
            "<b>it's \"é\"</b>");
}

TEST(EditWords, RefuseWhatIsNoEdit) {
  const std::string deep(60'000, '['), long_word(2000, '7');
  for (const std::string& json :
       std::vector<std::string>{"",
                                "null",
                                "3",
                                "[]",
                                "{}",
                                deep,
                                "{\"a\":" + deep,
                                R"({"action": 3})",
                                R"({"action": "list"})",
                                R"({"action": "forget"})",
                                R"({"action": "reject"} trailing)",
                                R"({"action": "reject", "arguments": "3"})",
                                R"({"action": "reject", "arguments": [3]})",
                                R"({"action": "reject", "arguments": {"0": "3"}})",
                                R"({"action": "reject", "arguments": ["1", "2", "3", "4", "5"]})",
                                R"({"action": "reject", "arguments": ["3"], "STORE": "/etc/passwd"})",
                                R"({"action": "reject", "arguments": ["--config"]})",
                                R"({"action": "reject", "arguments": [")" + long_word + R"("]})",
                                R"({"action": "reject", "arguments": ["3\n4"]})",
                                R"({"action": "reject", "arguments": ["3\u0000"]})",
                                R"({"action": "pin", "options": {"config": "/etc/passwd"}})",
                                R"({"action": "pin", "options": {"STORE": "/etc/passwd"}})",
                                R"({"action": "pin", "options": {"json": "out.json"}})",
                                R"({"action": "pin", "options": {"at": 3}})",
                                R"({"action": "pin", "options": ["at"]})",
                                "{\"action\": \"\xff\xfe\"}"})
    EXPECT_THROW(parseEditWords(json), urban_nav_core::UserError) << json.substr(0, 80);
}

TEST(EditWords, AreReadOrRefusedWhateverTheBytes) {
  std::mt19937 random(69);
  const std::string valid = kAssertion, spices = "{}[]\",:\\u0n-e+.\x00\xff";
  std::size_t accepted = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::string bytes = valid;
    for (int change = static_cast<int>(random() % 6); change >= 0; --change) {
      const std::size_t at = random() % bytes.size();
      switch (random() % 4) {
        case 0: bytes[at] = static_cast<char>(random()); break;
        case 1: bytes.erase(at, 1 + random() % 8); break;
        case 2: bytes.insert(at, 1 + random() % 3, spices[random() % spices.size()]); break;
        default: bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 40)); break;
      }
      if (bytes.empty()) bytes = "{";
    }
    try {
      const EditWords words = parseEditWords(bytes);
      ++accepted;
      EXPECT_LE(words.arguments.size(), 4U);
      for (const std::string& word : words.arguments) EXPECT_EQ(word.find('\0'), std::string::npos);
      for (const auto& [name, value] : words.options) EXPECT_TRUE(name == "pose" || name == "sigma") << name;
    } catch (const urban_nav_core::UserError&) {
    }
  }
  EXPECT_GT(accepted, 100U) << "changes within texts are no faults";
  EXPECT_LT(accepted, 15'000U);
}

}  // namespace
}  // namespace urban_nav
