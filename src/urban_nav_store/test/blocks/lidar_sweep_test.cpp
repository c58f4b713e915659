// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/tables/lidar_sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/deflate.hpp"

namespace urban_nav_store {
namespace {

using urban_nav_core::Beam;
using urban_nav_core::Scan;
using urban_nav_core::StampNs;
using urban_nav_core::Sweep;

constexpr StampNs kReference = 1'317'042'272'000'000'000;

/// 16 rings of 90 beams, column by column, from 0.05 s before the reference to 0.05 s after it.
Sweep someSweep() {
  Sweep sweep;
  sweep.reference = kReference;
  for (int column = 0; column < 90; ++column)
    for (int ring = 0; ring < 16; ++ring) {
      const double azimuth = M_PI - 0.0698 * column, elevation = -0.26 + 0.035 * ring;
      Beam beam;
      beam.stamp = kReference + (column - 45) * 1'111'111;
      beam.direction = Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                       std::sin(elevation))
                           .cast<float>();
      beam.range = 5.0F + 0.3F * static_cast<float>(column) + 0.001F * static_cast<float>(ring);
      beam.intensity = static_cast<float>((3 * column + ring) % 256);
      beam.ring = static_cast<std::uint16_t>(ring);
      sweep.beams.push_back(beam);
    }
  return sweep;
}

LidarSweep storedSweep(std::string packed) { return {"s", "points0", kReference, std::move(packed)}; }

TEST(LidarSweeps, ComeBackRingByRing) {
  const Sweep sweep = someSweep();
  const std::vector<Scan> rings = storedSweep(LidarSweep::pack(sweep)).rings();
  ASSERT_EQ(rings.size(), 16U);
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    ASSERT_EQ(rings[ring].beams.size(), 90U);
    for (std::size_t column = 0; column < 90; ++column) {
      const Beam &back = rings[ring].beams[column], &was = sweep.beams[16 * column + ring];
      EXPECT_EQ(back.ring, ring);
      EXPECT_LT((back.direction - was.direction).norm(), 6e-5F);
      EXPECT_NEAR(back.range, was.range, 0.00101F);
      EXPECT_NEAR(back.intensity, was.intensity, 0.5F);
      EXPECT_LE(std::abs(back.stamp - was.stamp), 10'000);
    }
  }
}

TEST(LidarSweeps, TakeFewBytesABeam) {
  const Sweep sweep = someSweep();
  EXPECT_LT(LidarSweep::pack(sweep).size(), 4 * sweep.beams.size());
}

TEST(LidarSweeps, LeaveOutWhatCannotBeEncoded) {
  Sweep sweep = someSweep();
  sweep.beams[0].range = std::numeric_limits<float>::quiet_NaN();
  sweep.beams[1].direction.x() = std::numeric_limits<float>::infinity();
  sweep.beams[2].range = 200.0F;
  sweep.beams[3].stamp += 2'000'000'000;
  std::size_t beams = 0;
  for (const Scan& ring : storedSweep(LidarSweep::pack(sweep)).rings()) beams += ring.beams.size();
  EXPECT_EQ(beams, sweep.beams.size() - 4);
  sweep.beams.clear();
  EXPECT_TRUE(storedSweep(LidarSweep::pack(sweep)).rings().empty());
}

TEST(LidarSweeps, SurviveAnything) {
  Sweep few = someSweep();
  few.beams.resize(40);
  const std::string packed = LidarSweep::pack(few), plain = *inflated(packed, 1 << 20);
  for (const bool inside : {false, true}) {
    const auto result = urban_nav_core::testing::fuzzText({inside ? plain : packed}, [&](const std::string& text) {
      for (const Scan& ring : storedSweep(inside ? deflated(text) : text).rings())
        for (const Beam& beam : ring.beams) ASSERT_TRUE(beam.direction.allFinite() && std::isfinite(beam.range));
    });
    EXPECT_EQ(result.failure, "");
    EXPECT_GT(result.accepted, 0);
    EXPECT_GT(result.refused, 0);
  }
}

}  // namespace
}  // namespace urban_nav_store
