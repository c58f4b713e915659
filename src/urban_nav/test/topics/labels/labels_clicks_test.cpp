// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "topics/labels/label_clicks.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

TEST(LabelClicks, AreReadLineByLine) {
  const urban_nav_input::testing::TemporaryFolder folder;
  urban_nav_input::testing::writeFile(
      folder.file("c.csv"),
      "bag,side,stamp_ns,beam,class\nday.bag,left,1225719872000000000,17,dirt_path\nday.bag,right,5,0,wall\n");
  EXPECT_EQ(LabelClicks(folder.file("c.csv")).size(), 2U);
}

TEST(LabelClicks, AreRefusedByLineIfTheyNameNothing) {
  const urban_nav_input::testing::TemporaryFolder folder;
  const std::string header = "bag,side,stamp_ns,beam,class,trajectory\n";
  for (const char* line :
       {"a.bag,up,5,0,wall,", "a.bag,left,5,0,gravel,", "a.bag,left,5,-1,wall,", "a.bag,left,5,70000,wall,",
        "a.bag,left,x,0,wall,", "a.bag,left,5,0", "a.bag,left,5,0,wall,t.tum\na.bag,left,6,0,wall,u.tum"}) {
    urban_nav_input::testing::writeFile(folder.file("c.csv"), header + line + "\n");
    EXPECT_THROW(LabelClicks(folder.file("c.csv")), urban_nav_core::UserError) << line;
  }
}

TEST(LabelClicks, ThrowUserErrorsAloneForAnyBytes) {
  const urban_nav_input::testing::TemporaryFolder folder;
  const std::string good = "bag,side,stamp_ns,beam,class\na.bag,left,5,0,wall\nb.bag,right,6,1,grass\n";
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    std::string text = good;
    for (int change = 0; change < 3; ++change) text[random() % text.size()] = static_cast<char>(random() % 256);
    urban_nav_input::testing::writeFile(folder.file("c.csv"), text);
    try {
      LabelClicks(folder.file("c.csv"));
    } catch (const urban_nav_core::UserError&) {
    }
  }
}

}  // namespace
}  // namespace urban_nav
