// SPDX-License-Identifier: BSD-3-Clause
// The page in a headless Chromium that a script drives by clicks and keys. Skipped where there is no chromium-driver or
// no python3-selenium.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "edits/circle_store.hpp"
#include "edits/edge_list.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "view/served_store.hpp"
#include "view/tiled_store.hpp"

namespace urban_nav {
namespace {

using testing::ServedStore;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_store::Access;
using urban_nav_store::Store;

constexpr int kNotHere = 77;  // exit status of the script without a browser
constexpr int kManyClosures = 10'000;

/// Runs a part of the script on a page; returns its exit status and what it printed.
std::pair<int, std::string> clickThrough(const std::string& part, const ServedStore& served,
                                         const TemporaryFolder& folder, const std::string& words = "") {
  const std::string script = (std::filesystem::path(__FILE__).parent_path() / "page_clicks.py").string();
  const std::string log = folder.file("clicks.log");
  const int status = std::system(
      ("python3 '" + script + "' " + part + " '" + served.address() + "' " + words + " >'" + log + "' 2>&1").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(log)};
}

/// Adds rejected closures within Monday.
void addRejectedClosures(Store& store, int count) {
  std::vector<urban_nav_core::StampNs> stamps;
  store.graph().forEachNode(testing::kMondayId,
                            [&](const urban_nav_store::Node& node) { stamps.push_back(node.stamp); });
  for (int k = 0; k < count; ++k) {
    urban_nav_store::Edge edge;
    const std::size_t a = static_cast<std::size_t>(k) % 400, b = 450 + static_cast<std::size_t>(k) / 400;
    edge.a = {testing::kMondayId, stamps.at(a)};
    edge.b = {testing::kMondayId, stamps.at(b)};
    edge.kind = urban_nav_store::EdgeKind::Stereo;
    edge.source = "loop_metric";
    edge.verdict = urban_nav_core::ClosureVerdict::Rejected;
    edge.reason = "few_inliers";
    store.graph().put(edge);
  }
}

TEST(PageInABrowser, ClicksAreEditsAndPagesAgree) {
  const TemporaryFolder folder;
  const std::string path = folder.file("s.db"), before = folder.file("before.db");
  testing::writeCircleStore(path);
  std::filesystem::copy_file(path, before);
  {
    const ServedStore served(path, false, before);
    const auto [status, text] = clickThrough("edits", served, folder);
    if (status == kNotHere) GTEST_SKIP() << text;
    EXPECT_EQ(status, 0) << text;
  }
  Store store(path, Access::Read);
  const std::vector<ListedEdit> edits = listEdits(store);
  ASSERT_EQ(edits.size(), 2U);
  EXPECT_TRUE(edits[0].undone);
  EXPECT_FALSE(edits[1].undone);
}

TEST(PageInABrowser, ShowsTenThousandClosures) {
  const TemporaryFolder folder;
  const std::string path = folder.file("s.db");
  testing::writeCircleStore(path);
  {
    Store store(path, Access::Write);
    addRejectedClosures(store, kManyClosures);
    store.commit();
  }
  const ServedStore served(path, true);
  const auto [status, text] = clickThrough("many", served, folder);
  if (status == kNotHere) GTEST_SKIP() << text;
  EXPECT_EQ(status, 0) << text;
}

TEST(PageInABrowser, ShowsTheLevelsOfTheMapAndMovesThemAfterAnEdit) {
  const TemporaryFolder folder;
  const std::string path = folder.file("s.db");
  testing::writeCircleStore(path);
  const std::size_t points = testing::addTiles(path);
  const ServedStore served(path);
  const auto [status, text] = clickThrough("tiles", served, folder, std::to_string(points));
  if (status == kNotHere) GTEST_SKIP() << text;
  EXPECT_EQ(status, 0) << text;
}

}  // namespace
}  // namespace urban_nav
