// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/session/session_odometry.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "live/odometry_rows.hpp"

namespace loop_metric {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::RelativePose;
using urban_nav_core::StampNs;
using urban_nav_registration::readOdometry;
using urban_nav_registration::SessionOdometry;
using urban_nav_store::Access;
using urban_nav_store::Store;

constexpr StampNs kRowPeriod = 100'000'000;

RelativePose stepTo(int i) {
  RelativePose step;
  step.from = (i - 1) * kRowPeriod + 1;
  step.to = i * kRowPeriod + 1;
  step.T_from_to = Pose(urban_nav_core::expSo3(Eigen::Vector3d(0, 0.01, 0.1)), Eigen::Vector3d(0.3, 0.01 * i, 0.0));
  step.covariance = 1e-4 * (1.0 + i) * urban_nav_core::Matrix6d::Identity();
  step.drift_covariance = 0.25 * step.covariance;
  step.source = "swf_vo";
  return step;
}

TEST(SessionOdometry, AGapBeginsAPartOfItsOwn) {
  SessionOdometry odometry;
  EXPECT_TRUE(odometry.empty());
  for (const int i : {1, 2, 3, 5, 6}) EXPECT_TRUE(odometry.add(stepTo(i)));
  ASSERT_EQ(odometry.parts().size(), 2U);
  EXPECT_EQ(odometry.newest(), 6 * kRowPeriod + 1);
  EXPECT_EQ(odometry.partAt(2 * kRowPeriod), 0U);
  EXPECT_EQ(odometry.partAt(5 * kRowPeriod), 1U);
  EXPECT_FALSE(odometry.add(stepTo(4))) << "back in time";
  EXPECT_FALSE(odometry.add(stepTo(6))) << "twice";
  RelativePose broken = stepTo(7);
  broken.covariance(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(odometry.add(broken));
}

TEST(SessionOdometry, ComesBackFromAStoreWithItsGaps) {
  const std::string path = ::testing::TempDir() + "loop_metric_session_odometry.db";
  urban_nav_store::removeStore(path);
  SessionOdometry expected;
  {
    Store store(path, Access::Write);
    store.sessions().put(urban_nav_store::Session{"0123456789abcdef0123", "a", "", "", 1, false});
    OdometryRows rows;
    for (const int i : {1, 2, 3, 5, 6, 7}) {
      ASSERT_TRUE(expected.add(stepTo(i)));
      std::vector<urban_nav_store::Node> nodes;
      std::optional<urban_nav_store::Edge> edge;
      ASSERT_TRUE(rows.write("0123456789abcdef0123", stepTo(i), nodes, edge));
      for (const auto& node : nodes) store.graph().put("0123456789abcdef0123", node);
      store.graph().put(*edge);
    }
    std::vector<urban_nav_store::Node> nodes;
    std::optional<urban_nav_store::Edge> edge;
    EXPECT_FALSE(rows.write("0123456789abcdef0123", stepTo(2), nodes, edge)) << "back in time";
    EXPECT_TRUE(nodes.empty());
    store.commit();
  }
  Store store(path, Access::Read);
  const SessionOdometry read = readOdometry(store, "0123456789abcdef0123");
  ASSERT_EQ(read.parts().size(), expected.parts().size());
  for (std::size_t i = 0; i < expected.parts().size(); ++i) {
    EXPECT_TRUE(isApprox(read.parts()[i]->trajectory(), expected.parts()[i]->trajectory(), 1e-12));
    const StampNs first = expected.parts()[i]->trajectory().front().stamp,
                  last = expected.parts()[i]->trajectory().back().stamp;
    EXPECT_TRUE(read.parts()[i]
                    ->between(first, last)
                    ->covariance.isApprox(expected.parts()[i]->between(first, last)->covariance, 1e-12));
  }
  EXPECT_TRUE(readOdometry(store, "another").empty());
  urban_nav_store::removeStore(path);
}

}  // namespace
}  // namespace loop_metric
