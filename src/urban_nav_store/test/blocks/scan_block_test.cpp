// SPDX-License-Identifier: BSD-3-Clause
#include "blocks/scan_block.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "support/contents.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/deflate.hpp"

namespace urban_nav_store {
namespace {

using urban_nav_core::Scan;

std::vector<Scan> someScans() {
  testing::Drawn drawn(1);
  std::vector<Scan> scans;
  for (int i = 0; i < 75; ++i) scans.push_back(drawn.scan(1'000'000'000'000 + 13'333'333 * i, i == 3 ? 0 : 181));
  scans[5].beams[7].stamp -= 1'000'000;  // beams within a scan may be in any order
  return scans;
}

TEST(ScanBlock, RoundTripIsExact) {
  const std::vector<Scan> scans = someScans();
  const auto back = unpackScans(packScans(scans));
  ASSERT_TRUE(back);
  ASSERT_EQ(back->size(), scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) EXPECT_TRUE(isApprox((*back)[i], scans[i], 0.0)) << i;
  EXPECT_TRUE(unpackScans(packScans({}))->empty());
}

TEST(ScanBlock, DirectionsThatRepeatCostNothing) {
  const std::vector<Scan> scans = someScans();
  std::size_t beams = 0;
  for (const Scan& scan : scans) beams += scan.beams.size();
  EXPECT_LT(packScans(scans).size(), beams * 8) << "random ranges and intensities take four bytes each";
}

/// Scans of a scanner at rest that outputs whole millimetres and intensities, with noise of `sigma_m`.
std::vector<Scan> wholeScans(float sigma_m) {
  std::vector<Scan> scans = someScans();
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0.0F, sigma_m);
  for (Scan& scan : scans)
    for (std::size_t i = 0; i < scan.beams.size(); ++i) {
      const float range = 2.0F + 0.05F * static_cast<float>(i) + noise(random);
      scan.beams[i].range = static_cast<float>(std::round(1000.0 * static_cast<double>(range)) / 1000.0);
      scan.beams[i].intensity = static_cast<float>(i % 40);
    }
  for (std::size_t s = 0; s < scans.size(); ++s)  // beams without an echo
    if (!scans[s].beams.empty()) scans[s].beams.erase(scans[s].beams.begin() + static_cast<std::ptrdiff_t>(s));
  return scans;
}

TEST(ScanBlock, WholeMillimetresTakeWhatTheirNoiseTakes) {
  constexpr float kSigma = 0.01F;
  const std::vector<Scan> scans = wholeScans(kSigma);
  std::size_t beams = 0;
  for (const Scan& scan : scans) beams += scan.beams.size();
  const std::string packed = packScans(scans);
  // The entropy of a difference of two ranges is log2(sigma sqrt(2) sqrt(2 pi e) / 1 mm) = 5.9 bits; directions, stamps
  // and the code of deflate take the rest of 10 bits a beam. As floats, range and intensity take 64.
  EXPECT_LT(packed.size(), beams * 10 / 8);
  const auto back = unpackScans(packed);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->size(), scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) EXPECT_TRUE(isApprox((*back)[i], scans[i], 0.0)) << i;
}

TEST(ScanBlock, IsExactForAnyFloat) {
  const std::vector<float> values = {-0.0F, 0.0F, 1e-3F, -1e-3F, 0.0015F, 1e30F, -1e30F, 1e-40F, 1073741.75F, 2e6F};
  for (const float value : values)
    for (const bool in_range : {false, true}) {
      std::vector<Scan> scans = wholeScans(0.01F);
      (in_range ? scans[4].beams[9].range : scans[4].beams[9].intensity) = value;
      const auto back = unpackScans(packScans(scans));
      ASSERT_TRUE(back) << value;
      for (std::size_t i = 0; i < scans.size(); ++i)
        for (std::size_t k = 0; k < scans[i].beams.size(); ++k) {
          const urban_nav_core::Beam &a = (*back)[i].beams[k], &b = scans[i].beams[k];
          ASSERT_TRUE(a.range == b.range && std::signbit(a.range) == std::signbit(b.range)) << value;
          ASSERT_TRUE(a.intensity == b.intensity && std::signbit(a.intensity) == std::signbit(b.intensity)) << value;
        }
    }
}

TEST(ScanBlock, ReadsBlocksOfOlderStores) {
  std::vector<Scan> scans = someScans();
  scans.resize(2);
  std::string bytes;
  appendInteger32(bytes, 2);
  for (const Scan& scan : scans) {
    appendInteger(bytes, static_cast<std::uint64_t>(scan.stamp));
    appendInteger32(bytes, static_cast<std::uint32_t>(scan.beams.size()));
  }
  for (const Scan& scan : scans)
    for (std::size_t i = 0; i < scan.beams.size(); ++i)
      appendInteger(bytes,
                    static_cast<std::uint64_t>(scan.beams[i].stamp - (i > 0 ? scan.beams[i - 1].stamp : scan.stamp)));
  for (int column = 0; column < 5; ++column)
    for (const Scan& scan : scans)
      for (const urban_nav_core::Beam& beam : scan.beams)
        appendFloat(bytes, column < 3 ? beam.direction(column) : column == 3 ? beam.range : beam.intensity);
  const auto back = unpackScans(deflated(bytes));
  ASSERT_TRUE(back);
  ASSERT_EQ(back->size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(isApprox((*back)[i], scans[i], 0.0)) << i;
}

TEST(ScanBlock, RefusesWhatIsNotFinite) {
  std::vector<Scan> scans = someScans();
  scans[1].beams[2].range = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(unpackScans(packScans(scans)));
}

TEST(ScanBlock, SurvivesAnything) {
  std::vector<Scan> few = someScans();
  few.resize(2);
  // Damage inside the compressed data too.
  const std::string plain = *inflated(packScans(few), 1 << 20);
  for (const bool inside : {false, true}) {
    const auto result =
        urban_nav_core::testing::fuzzText({inside ? plain : packScans(few)}, [&](const std::string& text) {
          const auto scans = unpackScans(inside ? deflated(text) : text);
          if (!scans) throw urban_nav_core::DataError("x", "refused", "");
          for (const Scan& scan : *scans)
            for (const urban_nav_core::Beam& beam : scan.beams) ASSERT_TRUE(beam.direction.allFinite());
        });
    EXPECT_EQ(result.failure, "");
    EXPECT_GT(result.accepted, 0);
    EXPECT_GT(result.refused, 0);
  }
}

}  // namespace
}  // namespace urban_nav_store
