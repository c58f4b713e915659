// SPDX-License-Identifier: BSD-3-Clause
#include "blocks/scan_block.hpp"

#include <gtest/gtest.h>

#include <limits>

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
