// SPDX-License-Identifier: BSD-3-Clause
#include "live/specific_force_buffer.hpp"

#include <gtest/gtest.h>

namespace pose_graph {
namespace {

using urban_nav_core::StampNs;

constexpr StampNs kPose = 50'000'000, kSample = 9'700'000;

SpecificForce sampleAt(StampNs stamp) {
  const double s = 1e-9 * static_cast<double>(stamp);
  return {stamp, {std::sin(s), std::cos(3.0 * s), 9.81 + 0.1 * std::sin(7.0 * s)}};
}

std::vector<StampNs> posesUpTo(int end) {
  std::vector<StampNs> stamps;
  for (int i = 0; i < end; ++i) stamps.push_back(i * kPose);
  return stamps;
}

/// Applies an answer as a graph does: it replaces the known forces from its first stamp on.
void put(const std::vector<SpecificForce>& forces, std::vector<SpecificForce>& known) {
  if (forces.empty()) return;
  while (!known.empty() && known.back().stamp >= forces.front().stamp) known.pop_back();
  known.insert(known.end(), forces.begin(), forces.end());
}

void expectSame(const std::vector<SpecificForce>& a, const std::vector<SpecificForce>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].stamp, b[i].stamp);
    EXPECT_EQ(a[i].force, b[i].force) << i;
  }
}

TEST(SpecificForceBuffer, EndsWithTheBitsOfAllAtOnce) {
  SpecificForceBuffer buffer;
  std::vector<SpecificForce> all, known;
  int poses = 0;
  for (StampNs stamp = -200'000'000; stamp < 60'000'000'000; stamp += kSample) {
    if (stamp > 30'000'000'000 && stamp < 31'000'000'000) continue;  // a gap of the accelerometer
    buffer.add(sampleAt(stamp));
    all.push_back(sampleAt(stamp));
    // Poses arrive 1.25 s late, and are requested at irregular times.
    poses = std::max(0, static_cast<int>((stamp - 1'250'000'000) / kPose));
    if (all.size() % 333 == 0) put(buffer.meansAt(posesUpTo(poses)), known);
  }
  put(buffer.meansAt(posesUpTo(poses + 20)), known);
  expectSame(known, forcesAt(posesUpTo(poses + 20), all));
  // Final means are not computed again.
  EXPECT_LT(buffer.meansAt(posesUpTo(poses + 20)).size(), 300u);
}

TEST(SpecificForceBuffer, ARecordingThatBeginsAgainIsForTheNextSession) {
  SpecificForceBuffer buffer;
  std::vector<SpecificForce> first, second;
  for (int i = 0; i < 500; ++i) first.push_back(sampleAt(i * kSample));
  for (int i = 0; i < 500; ++i) second.push_back({i * kSample, Eigen::Vector3d(1.0, 0.0, 9.7)});
  for (const SpecificForce& each : first) buffer.add(each);
  for (const SpecificForce& each : second) buffer.add(each);
  expectSame(buffer.meansAt(posesUpTo(80)), forcesAt(posesUpTo(80), first));
  buffer.beginSession();
  expectSame(buffer.meansAt(posesUpTo(80)), forcesAt(posesUpTo(80), second));
  buffer.beginSession();
  EXPECT_FALSE(buffer.meansAt(posesUpTo(80)).empty())
      << "a session that begins by hand continues with the same samples";
}

TEST(SpecificForceBuffer, WithoutForcesNothingIsKnown) {
  SpecificForceBuffer buffer;
  EXPECT_TRUE(buffer.meansAt(posesUpTo(10)).empty());
  buffer.add(sampleAt(0));
  EXPECT_TRUE(buffer.meansAt({}).empty());
}

}  // namespace
}  // namespace pose_graph
