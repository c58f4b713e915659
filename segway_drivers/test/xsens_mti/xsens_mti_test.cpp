// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "segway_drivers/xsens_mti/message.hpp"
#include "segway_drivers/xsens_mti/sample.hpp"
#include "segway_drivers/xsens_mti/stream.hpp"
#include "urban_nav_core/testing/fuzz.hpp"

namespace segway_drivers {
namespace {

constexpr const char* kMtiWorkedExample =
    "FA FF 32 36 3D CC CC CD BE 4C CC CD 41 1C F5 C3 3C 23 D7 0A BC A3 D7 0A 3C F5 C2 8F 3E 4C CC CD 00 00 00 00"
    "BE E6 66 66 3F 80 00 00 00 00 00 00 00 00 00 00 00 00 00 00 FF FF ED";

void appendItem(Bytes& data, std::uint16_t identifier, const Bytes& content) {
  appendBig(data, identifier);
  data.push_back(static_cast<std::uint8_t>(content.size()));
  data.insert(data.end(), content.begin(), content.end());
}

Bytes makeData2(std::uint16_t counter, std::uint32_t fine) {
  Bytes data, word, words, zeros(12, 0);
  appendBig(word, counter);
  appendBig32(words, fine);
  appendItem(data, 0x1020, word);
  appendItem(data, 0x1060, words);
  appendItem(data, 0x4020, zeros);
  return makeMtiMessage(MtiMid::Data2, data);
}

TEST(MtiMessage, CommandsEqualPublishedBytes) {
  EXPECT_EQ(printHex(mtiGoToConfigCommand()), "FA FF 30 00 D1");
  EXPECT_EQ(printHex(mtiOutputModeCommand(6)), "FA FF D0 02 00 06 29");
  EXPECT_EQ(printHex(mtiOutputSettingsCommand(1)), "FA FF D2 04 00 00 00 01 2A");
  EXPECT_EQ(printHex(mtiPeriodCommand(1152)), "FA FF 04 02 04 80 77");
}

TEST(MtiMessage, LongMessagesHaveAnExtendedLength) {
  const Bytes message = makeMtiMessage(MtiMid::Data2, Bytes(700, 1));
  EXPECT_EQ(probeMtiMessage(message).kind, FrameProbe::Kind::Frame);
  EXPECT_EQ(splitMtiMessage(message).data.size, 700U);
  EXPECT_EQ(probeMtiMessage(Bytes{0xFA, 0xFF, 0x36, 0xFF, 0xFF, 0xFF}).kind, FrameProbe::Kind::NoFrame);
}

TEST(MtiSample, TheWorkedExampleOfMtData) {
  const auto sample = decodeMtiData(splitMtiMessage(*parseHex(kMtiWorkedExample)).data, 6, 1);
  ASSERT_TRUE(sample && sample->acceleration && sample->rate && sample->field && sample->orientation);
  EXPECT_NEAR((*sample->acceleration)[2], 9.81, 1e-6);
  EXPECT_NEAR((*sample->rate)[1], -0.02, 1e-6);
  EXPECT_NEAR((*sample->field)[2], -0.45, 1e-6);
  EXPECT_EQ((*sample->orientation)[0], 1.0);
  EXPECT_EQ(sample->counter, 65535);
  EXPECT_FALSE(decodeMtiData(splitMtiMessage(*parseHex(kMtiWorkedExample)).data, 2, 1));
}

TEST(MtiSample, NwuBecomesEnuByAQuarterTurn) {
  MtiSample sample;
  sample.orientation = {1, 0, 0, 0};
  sample.earth = MtiSample::Earth::Nwu;  // x to the north: a heading of 90 deg in ENU
  const auto enu = mtiOrientationEnu(sample);
  EXPECT_NEAR(2.0 * std::atan2((*enu)[3], (*enu)[0]), 1.5707963267948966, 1e-12);
}

TEST(MtiSample, FixedPointFormats) {
  Bytes data;
  appendItem(data, 0x0810 | 1, *parseHex("FF 8B B2 CA"));
  EXPECT_NEAR(*decodeMtiData2(data)->temperature, -7.268850, 1e-6);
  data.clear();
  appendItem(data, 0x0810 | 2, *parseHex("BC 86 A0 00 FF F8"));
  EXPECT_NEAR(*decodeMtiData2(data)->temperature, -7.263571, 1e-6);
}

TEST(MtiStream, SlowOutputsOutOfOrderDoNotRestartTheClock) {
  MtiStream stream(MtiStream::Options{});
  std::vector<MtiStampedSample> samples;
  stream.on_sample = [&](const MtiStampedSample& sample) { samples.push_back(sample); };
  std::uint16_t counter = 65000;
  for (int i = 0; i < 1000; ++i) {
    const TimeNs time = 1'000'000'000 + static_cast<TimeNs>(i) * 10'000'000;
    stream.feed(makeData2(counter++, 4294960000U + 100U * static_cast<unsigned>(i)), {time, 0});
    if (i % 10 == 9)
      stream.feed(makeData2(counter++, 4294960000U + 100U * static_cast<unsigned>(i) - 419U), {time + 1'000'000, 0});
  }
  EXPECT_EQ(stream.counters().epochs, 0);
  EXPECT_EQ(stream.counters().gaps, 0);
  ASSERT_TRUE(samples.back().stamp && samples[samples.size() - 2].stamp);
  EXPECT_NEAR(static_cast<double>(*samples[samples.size() - 2].stamp - *samples.back().stamp), 41.9e6, 1e5);
}

TEST(MtiStream, SurvivesDamagedMessages) {
  std::string seed;
  for (unsigned i = 0; i < 5; ++i) {
    const Bytes message = makeData2(static_cast<std::uint16_t>(i), 100 * i);
    seed.append(message.begin(), message.end());
  }
  const Bytes example = *parseHex(kMtiWorkedExample);
  const auto result = urban_nav_core::testing::fuzzText(
      {seed, std::string(example.begin(), example.end())}, [](const std::string& text) {
        MtiStream stream(MtiStream::Options{});
        stream.on_sample = [](const MtiStampedSample& sample) {
          if (sample.sample.acceleration) {
            EXPECT_TRUE(std::isfinite((*sample.sample.acceleration)[0]));
          }
        };
        stream.feed({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, {1'000'000'000, 0});
        stream.finish();
        // Messages that pass the checksum by chance are rare: the data decoders get the bytes as they are, too.
        const ByteView raw(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
        decodeMtiData2(raw);
        decodeMtiData(raw, 0x080F, 0x0005);
      });
  EXPECT_EQ(result.failure, "");
}

}  // namespace
}  // namespace segway_drivers
