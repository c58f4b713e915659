// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/closure_tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "edits/edge_list.hpp"
#include "loop_metric/evidence.hpp"
#include "support/circle_drive.hpp"
#include "topics/graph/graph_store_export.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using testing::driveCircle;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;

constexpr const char* kCircleSession = "cccccccccccccccc";

/// A closure with the evidence of a single try.
MetricClosure withEvidence(MetricClosure closure, ClosureVerdict verdict, double matches) {
  loop_metric::Evidence evidence;
  evidence.tries.emplace_back();
  evidence.tries.back().method = urban_nav_core::ClosureMethod::Stereo;
  evidence.tries.back().verdict = verdict;
  evidence.tries.back().tests = {{"matches", matches, 50.0, true, matches >= 50.0}};
  closure.evidence = printEvidence(evidence);
  closure.source = "loop_metric";
  closure.verdict = verdict;
  if (verdict == ClosureVerdict::Rejected) closure.measured.information.setZero();
  return closure;
}

class ClosureTables : public ::testing::Test {
 protected:
  ClosureTables() {
    store_.sessions().put({kCircleSession, "monday", "", "", 0, true});
    for (const SmoothedFrame& settled : drive_.settled) {
      urban_nav_store::Node node;
      node.stamp = settled.stamp;
      node.T_odom_base = settled.T_odom_base.pose;
      store_.graph().put(kCircleSession, node);
    }
    run_ = runGraph({}, {&drive_}, {"monday"},
                    {withEvidence(testing::closure("monday", 20, "monday", 620), ClosureVerdict::Accepted, 51.0),
                     withEvidence(testing::closure("monday", 40, "monday", 640), ClosureVerdict::Accepted, 400.0),
                     withEvidence(testing::closure("monday", 60, "monday", 300), ClosureVerdict::Rejected, 12.0)});
    exportGraph(store_, {kCircleSession}, run_);
    run_.numbers = readClosureNumbers(store_, {kCircleSession}, run_);
  }

  const SessionOdometry drive_ = driveCircle(0, 700, 1e-4);
  const urban_nav_input::testing::TemporaryFolder folder_;
  urban_nav_store::Store store_{folder_.file("s.db"), urban_nav_store::Access::Write};
  GraphRun run_;
};

TEST_F(ClosureTables, RowsCarryTheIdOfTheStore) {
  const std::vector<StoredClosure> stored = listEditableClosures(store_);
  ASSERT_EQ(stored.size(), 3U);
  const PageTable table = closureTables(run_).front();
  ASSERT_EQ(table.rows.size(), 3U);
  ASSERT_EQ(table.attributes.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(table.attributes[i].edge, std::to_string(run_.numbers[i]));
    const auto same = std::find_if(stored.begin(), stored.end(),
                                   [&](const StoredClosure& each) { return each.id == run_.numbers[i]; });
    ASSERT_NE(same, stored.end());
    EXPECT_NEAR(urban_nav_core::secondsBetween(run_.closures[i].b.stamp, same->edge.b.stamp), 0.0, 0.1);
  }
}

TEST_F(ClosureTables, RowsLinkToAllTheirTestsAndNameTheNearest) {
  const std::vector<PageTable> tables = closureTables(run_);
  ASSERT_EQ(tables.size(), 2U);
  Page page;
  page.sections.push_back({"graph", "Relaxation", "", {}, {}, tables});
  const std::string html = renderPage(page);
  for (const std::int64_t number : run_.numbers) {
    const std::string id = std::to_string(number);
    EXPECT_NE(html.find("<tr data-edge=\"" + id + "\"><td><a href=\"#why-" + id + "\">" + id + "</a></td>"),
              std::string::npos);
    EXPECT_NE(html.find("<tr id=\"why-" + id + "\">"), std::string::npos);
  }
  EXPECT_NE(html.find("<td>matches = 51 (&gt;= 50)</td>"), std::string::npos);
  EXPECT_NE(html.find("<td>failed: matches = 12 (&gt;= 50)</td>"), std::string::npos);
  EXPECT_NE(html.find("failed  matches = 12 (&gt;= 50)"), std::string::npos);
}

TEST_F(ClosureTables, ClosuresThatAreNotStoredHaveNoId) {
  run_.numbers.clear();
  const std::vector<PageTable> tables = closureTables(run_);
  ASSERT_EQ(tables.size(), 1U);
  Page page;
  page.sections.push_back({"graph", "Relaxation", "", {}, {}, tables});
  EXPECT_EQ(renderPage(page).find("data-edge"), std::string::npos);
}

}  // namespace
}  // namespace urban_nav
