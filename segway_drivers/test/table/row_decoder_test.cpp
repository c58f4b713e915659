// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/table/row_decoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "segway_drivers/lms291/commands.hpp"
#include "segway_drivers/segway_rmp/can_frame.hpp"
#include "segway_drivers/segway_rmp/units.hpp"
#include "segway_drivers/xsens_mti/message.hpp"
#include "urban_nav_core/testing/fuzz.hpp"

namespace segway_drivers {
namespace {

std::string toText(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

/// Several messages of each serial kind, and the log of a CAN bus.
std::vector<std::pair<std::string, std::string>> makeSeeds() {
  const std::string packet = toText(makeRmpPacket(makeRmpVelocity(0.5, 0.1)));
  const std::string config = toText(mtiGoToConfigCommand()), query = toText(lmsStatusCommand());
  return {{"lms291", query + query},
          {"xsens_mti", config + config},
          {"segway_rmp", packet + packet},
          {"segway_rmp_can",
           "(1700000000.010000) can0 401#0010FFF800040000\n(1700000000.020000) can0 402#0001000200030004\n"},
          {"gps", "$GPGGA,100000,5145.0000,N,00115.0000,W,1,08,1.0,110.0,M,47.0,M,,*49\r\n"}};
}

/// Rows of a text that arrives in chunks.
std::string decodeInChunks(const std::string& kind, const std::string& text, std::size_t chunk) {
  std::string rows;
  const auto decoder = makeRowDecoder(kind, Parameters(), {"", ""}, [&](const DeviceRow& row) {
    rows += std::to_string(row.offset) + "," + row.cells + "\n";
  });
  for (std::size_t at = 0; at < text.size(); at += chunk)
    decoder->feed(ByteView(reinterpret_cast<const std::uint8_t*>(text.data()), text.size())
                      .sub(at, std::min(chunk, text.size() - at)),
                  {0, 0});
  decoder->finish();
  return rows;
}

TEST(RowDecoder, DamagedInputOfEveryKindGivesTheSameRowsInChunksOfAnySize) {
  for (const auto& [kind, seed] : makeSeeds()) {
    SCOPED_TRACE(kind);
    const auto result = urban_nav_core::testing::fuzzText({seed, seed + seed}, [&](const std::string& text) {
      EXPECT_EQ(decodeInChunks(kind, text, 1), decodeInChunks(kind, text, 4096));
    });
    EXPECT_EQ(result.failure, "");
  }
}

}  // namespace
}  // namespace segway_drivers
