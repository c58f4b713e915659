// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/closure_bytes.hpp"

#include <gtest/gtest.h>

#include <random>

namespace urban_nav {
namespace {

using urban_nav_core::MetricClosure;

MetricClosure makeClosure(const std::string& name) {
  MetricClosure closure;
  closure.a = {"monday", 1'000'000'000'000'000'001};
  closure.b = {name, -5};
  closure.measured.T_a_b = urban_nav_core::Pose(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {1.0 / 3.0, -2.0, 1e-300});
  closure.measured.information = 7.0 * urban_nav_core::Matrix6d::Identity();
  closure.free_directions = {urban_nav_core::Vector6d::Unit(2)};
  closure.probability = 0.75;
  closure.method = urban_nav_core::ClosureMethod::Icp;
  closure.odometry_gate = true;
  closure.verdict = urban_nav_core::ClosureVerdict::Accepted;
  closure.reason = 3;
  closure.reason_name = "not_registered";
  closure.sentence = "words, with \"quotes\" and\nlines";
  closure.evidence = std::string("\0\xff", 2);
  closure.source = "loop_metric";
  return closure;
}

TEST(ClosureBytes, ComeBackToTheLastBit) {
  EXPECT_TRUE(unpackClosures(packClosures({}))->empty());
  const std::string bytes = packClosures({makeClosure("tuesday"), MetricClosure(), makeClosure("")});
  const auto closures = unpackClosures(bytes);
  ASSERT_TRUE(closures);
  ASSERT_EQ(closures->size(), 3U);
  EXPECT_EQ(packClosures(*closures), bytes);
  EXPECT_EQ(closures->front().a, makeClosure("tuesday").a);
  EXPECT_EQ(closures->front().measured.information, makeClosure("").measured.information);
  EXPECT_EQ(closures->front().sentence, makeClosure("").sentence);
}

TEST(ClosureBytes, DamageIsNoticed) {
  const std::string bytes = packClosures({makeClosure("tuesday")});
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(unpackClosures(std::string_view(bytes).substr(0, size))) << size;
  EXPECT_FALSE(unpackClosures(bytes + "x"));
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {  // no crash, and nothing that is not finite
    std::string damaged = bytes;
    for (int i = 0; i < 3; ++i) damaged[random() % damaged.size()] = static_cast<char>(random());
    if (const auto closures = unpackClosures(damaged)) {
      EXPECT_TRUE(closures->front().measured.T_a_b.isFinite() && closures->front().measured.information.allFinite());
    }
  }
}

}  // namespace
}  // namespace urban_nav
