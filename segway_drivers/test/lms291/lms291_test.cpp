// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "segway_drivers/lms291/commands.hpp"
#include "segway_drivers/lms291/scan.hpp"
#include "segway_drivers/lms291/stream.hpp"
#include "segway_drivers/lms291/telegram.hpp"
#include "urban_nav_core/testing/fuzz.hpp"

namespace segway_drivers {
namespace {

/// Telegram of a laser with `count` ranges of 1 mm, 2 mm ... and as many reflectivities.
Bytes makeScanTelegram(std::size_t count, std::uint8_t index, std::uint16_t word_0 = 1) {
  Bytes payload = {0xC4};
  appendLittle(payload, static_cast<std::uint16_t>(0x4000U | count));
  for (std::size_t i = 0; i < count; ++i) appendLittle(payload, i == 0 ? word_0 : static_cast<std::uint16_t>(i + 1));
  appendLittle(payload, static_cast<std::uint16_t>(count));
  appendLittle(payload, 1);
  appendLittle(payload, static_cast<std::uint16_t>(count));
  for (std::size_t i = 0; i < count; ++i) payload.push_back(static_cast<std::uint8_t>(i));
  payload.push_back(index);
  payload.push_back(0x10);
  Bytes telegram = {0x02, 0x80};
  appendLittle(telegram, static_cast<std::uint16_t>(payload.size()));
  telegram.insert(telegram.end(), payload.begin(), payload.end());
  appendLittle(telegram, computeLmsCrc(telegram));
  return telegram;
}

TEST(LmsTelegram, CommandsEqualPublishedBytes) {
  EXPECT_EQ(printHex(lmsStreamAllCommand()), "02 00 02 00 20 24 34 08");
  EXPECT_EQ(printHex(lmsStopCommand()), "02 00 02 00 20 25 35 08");
  EXPECT_EQ(printHex(lmsStreamReflectivitiesCommand()), "02 00 06 00 20 50 01 00 B5 00 68 B6");
  EXPECT_EQ(printHex(lmsInstallationCommand()), "02 00 0A 00 20 00 53 49 43 4B 5F 4C 4D 53 BE C5");
  EXPECT_EQ(printHex(*lmsBaudCommand(500000)), "02 00 02 00 20 48 58 08");
  EXPECT_FALSE(lmsBaudCommand(115200));
}

TEST(LmsTelegram, LengthsThatACommandCannotHaveAreNoFrames) {
  EXPECT_EQ(probeLmsTelegram(Bytes{0x02, 0x80, 0xFF, 0xFF, 0xC4}).kind, FrameProbe::Kind::NoFrame);
  EXPECT_EQ(probeLmsTelegram(Bytes{0x02, 0x80, 0x09, 0x00, 0xA0}).kind, FrameProbe::Kind::NoFrame);
  EXPECT_EQ(probeLmsTelegram(Bytes{0x02, 0x80, 0x03, 0x00, 0xA0}).kind, FrameProbe::Kind::Incomplete);
  EXPECT_EQ(probeLmsTelegram(*parseHex("02 80 03 00 A0 00 10 16 0A")).kind, FrameProbe::Kind::Frame);
  EXPECT_EQ(probeLmsTelegram(*parseHex("02 80 03 00 A0 01 10 16 0A")).kind, FrameProbe::Kind::BadChecksum);
}

TEST(LmsScan, CodesBecomeInfinityOrNaN) {
  for (const int bits : {13, 14, 15}) {
    for (unsigned minus = 1; minus < 10; ++minus) {
      const auto telegram = makeScanTelegram(181, 7, static_cast<std::uint16_t>((1U << bits) - minus));
      const auto scan = decodeLmsScan(lmsPayload(telegram), {bits, true});
      ASSERT_TRUE(scan);
      const bool open_air = minus == 1 || minus == 6 || minus == 9;
      EXPECT_EQ(std::isinf(scan->ranges[0]), open_air) << minus;
      EXPECT_EQ(std::isnan(scan->ranges[0]), !open_air) << minus;
      EXPECT_EQ(scan->codes[minus], 1);
      EXPECT_FLOAT_EQ(scan->ranges[180], 0.181F);
      EXPECT_EQ(scan->reflectivities[180], 180);
      EXPECT_EQ(scan->index, 7);
    }
  }
}

TEST(LmsScan, FlagsAboveTheRangeAreMaskedOut) {
  const auto telegram = makeScanTelegram(181, 0, 0x8000U | 1234U);
  EXPECT_FLOAT_EQ(decodeLmsScan(lmsPayload(telegram), {15, true})->ranges[0], 1.234F);
  EXPECT_FALSE(LmsRangeFormat::fromConfiguration(0x3F, 1));
  EXPECT_NEAR(LmsRangeFormat::fromConfiguration(0x05, 1)->maxRange(), 32.758, 1e-9);
  EXPECT_NEAR(LmsRangeFormat::fromConfiguration(0x00, 0)->maxRange(), 81.82, 1e-9);
}

TEST(LmsStream, StampsFollowTheMirrorNotTheArrival) {
  LmsStream stream({{15, true}, 0.002});
  std::vector<LmsStampedScan> scans;
  stream.on_scan = [&](const LmsStampedScan& scan) { scans.push_back(scan); };
  for (int i = 0; i < 600; ++i) {
    if (i == 400) i += 256;  // a gap of a whole wrap
    const double measured = 1.0 + 0.0133381 * i, delay = i % 5 == 0 ? 0.0 : 0.001 * (i % 7);
    stream.feed(makeScanTelegram(181, static_cast<std::uint8_t>(i)),
                {static_cast<TimeNs>(1e9 * (measured + 0.002 + delay + 560.0 / 50000.0)), 0});
    if (!scans.back().stamp || i <= 200) continue;
    EXPECT_NEAR(1e-9 * static_cast<double>(*scans.back().stamp), measured, 2e-4);
  }
  EXPECT_FALSE(scans.front().stamp);
  EXPECT_TRUE(scans.back().stamp);
  EXPECT_EQ(stream.counters().gaps, 256);
  EXPECT_EQ(stream.counters().epochs, 0);
}

TEST(LmsStream, SurvivesDamagedTelegrams) {
  std::string seed;
  for (int i = 0; i < 3; ++i) {
    const Bytes telegram = makeScanTelegram(181, static_cast<std::uint8_t>(i));
    seed.append(telegram.begin(), telegram.end());
  }
  const auto result = urban_nav_core::testing::fuzzText({seed}, [](const std::string& text) {
    LmsStream stream(LmsStream::Options{});
    std::size_t values = 0;
    stream.on_scan = [&](const LmsStampedScan& scan) { values += scan.scan.ranges.size(); };
    stream.feed({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, {1'000'000'000, 0});
    stream.finish();
    EXPECT_EQ(values % 181, 0U);
  });
  EXPECT_EQ(result.failure, "");
}

}  // namespace
}  // namespace segway_drivers
