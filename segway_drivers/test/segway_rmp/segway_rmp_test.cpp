// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "segway_drivers/segway_rmp/command_guard.hpp"
#include "segway_drivers/segway_rmp/odometry.hpp"
#include "segway_drivers/segway_rmp/stream.hpp"
#include "segway_drivers/segway_rmp/units.hpp"
#include "segway_drivers/transport/port.hpp"
#include "urban_nav_core/testing/fuzz.hpp"

namespace segway_drivers {
namespace {

constexpr TimeNs kRmpStep = 20'000'000;  // ns, 50 Hz

TEST(RmpUnits, CommandsEqualComputedBytes) {
  EXPECT_EQ(printHex(makeRmpPacket(makeRmpVelocity(0.5, 0.0))),
            "F0 55 00 00 00 00 04 13 00 00 A6 00 00 00 00 00 00 FC");
  const CanFrame rest = makeRmpVelocity(0.0, 0.0);
  EXPECT_EQ(printHex(makeRmpPacket(makeRmpConfiguration(rest, RmpConfiguration::OperatingMode, 2))),
            "F0 55 00 00 00 00 04 13 00 00 00 00 00 00 10 00 02 91");
  EXPECT_EQ(static_cast<std::int16_t>(makeRmpVelocity(1e9, -1e9).word(0)), 1176);
  EXPECT_EQ(static_cast<std::int16_t>(makeRmpVelocity(1e9, -1e9).word(1)), -1024);
  EXPECT_EQ(makeRmpVelocity(std::numeric_limits<double>::quiet_NaN(), 0.0).word(0), 0);
}

TEST(RmpUnits, TravelHasTheLowWordFirst) {
  const auto frame = splitRmpPacket(*parseHex("F0 55 AA 00 80 60 00 00 00 81 BF 00 00 81 BF 00 00 AC"));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->id, 0x403);
  const auto values = decodeRmpValues(*frame);
  EXPECT_NEAR(*(*values)[0], 1.0, 1e-12);
  EXPECT_NEAR(*(*values)[1], 1.0, 1e-12);
  EXPECT_FALSE((*values)[2]);
}

TEST(RmpCan, CandumpLines) {
  const auto line = parseCandumpLine("(1436509052.249713) can0 401#0010FFF800040000");
  ASSERT_TRUE(line);
  EXPECT_EQ(line->time, 1'436'509'052'249'713'000);
  EXPECT_EQ(line->frame.id, 0x401);
  for (const char* const bad :
       {"", "(1.5) can0 401#00", "(1.249713) can0 12345678#0010FFF800040000", "(x.249713) can0 401#0010FFF800040000"})
    EXPECT_FALSE(parseCandumpLine(bad)) << bad;
}

TEST(RmpCan, FramesBecomePacketsOfTheBase) {
  const auto line = parseCandumpLine("(1436509052.249713) can0 401#0010FFF800040000");
  const Bytes packet = makeRmpBasePacket(line->frame);
  EXPECT_EQ(printHex(packet), "F0 55 AA 00 80 20 00 00 00 00 10 FF F8 00 04 00 00 62");
  EXPECT_EQ(probeRmpPacket(packet).kind, FrameProbe::Kind::Frame);
  EXPECT_EQ(splitRmpPacket(packet)->data, line->frame.data);
}

TEST(RmpCan, AVirtualBusCarriesCommandsAndMessages) {
  std::string error;
  const auto driver = openCanPort("vcan0", error), base = openCanPort("vcan0", error);
  if (!driver || !base) GTEST_SKIP() << "vcan0: " << error;
  const auto line = parseCandumpLine("(1436509052.249713) can0 401#0010FFF800040000");
  Bytes packet = makeRmpPacket(line->frame);
  ASSERT_TRUE(base->write(packet));
  Bytes buffer(100);
  const Port::ReadResult read = driver->read(buffer.data(), buffer.size(), 1'000'000'000);
  ASSERT_EQ(read.outcome, Port::Outcome::Data);
  EXPECT_EQ(splitRmpPacket(buffer)->id, 0x401);
}

/// Drives a guard at 50 Hz while the base answers.
class GuardedDrive {
 public:
  RmpCommandGuard guard{RmpCommandGuard::Limits{}};
  TimeNs now = 1'000'000'000;
  bool base_answers = true;

  RmpCommand run(double seconds, std::optional<double> wish) {
    RmpCommand command;
    for (const TimeNs end = now + static_cast<TimeNs>(1e9 * seconds); now < end; now += kRmpStep) {
      if (base_answers) guard.reportBase(now);
      if (wish) guard.setWish({*wish, 0.0}, now);
      const RmpCommand next = guard.step(now);
      EXPECT_LE(std::abs(next.velocity), 1.5);
      EXPECT_LE(std::abs(next.velocity) - std::abs(last_), 0.0201);
      if (next.velocity != 0.0 && first_motion == 0) first_motion = now;
      last_ = next.velocity;
      command = next;
    }
    return command;
  }
  TimeNs first_motion = 0;

 private:
  double last_ = 0.0;
};

TEST(RmpCommandGuard, NoMotionInTheFirstHalfSecond) {
  GuardedDrive drive;
  EXPECT_NEAR(drive.run(3.0, 0.5).velocity, 0.5, 1e-9);
  EXPECT_GE(drive.first_motion, 1'500'000'000);
}

TEST(RmpCommandGuard, StopsHalfASecondAfterTheLastWish) {
  GuardedDrive drive;
  drive.run(3.0, 0.5);
  EXPECT_GT(drive.run(0.45, {}).velocity, 0.0);
  EXPECT_EQ(drive.run(0.1, {}).velocity, 0.0);
}

TEST(RmpCommandGuard, BrakesAtOnceAndReversesThroughZero) {
  GuardedDrive drive;
  drive.run(3.0, 1.0);
  EXPECT_EQ(drive.run(0.02, 0.3).velocity, 0.3);
  const double reversed = drive.run(0.02, -1.0).velocity;
  EXPECT_LE(reversed, 0.0);
  EXPECT_GE(reversed, -0.0201);
}

TEST(RmpCommandGuard, LimitsAreKeptAndAbsurdWishesMoveNothing) {
  GuardedDrive drive;
  EXPECT_EQ(drive.run(5.0, 9.0).velocity, 1.5);
  EXPECT_EQ(drive.run(0.02, 16.0).velocity, 0.0);
  EXPECT_EQ(drive.run(0.02, std::numeric_limits<double>::quiet_NaN()).velocity, 0.0);
  EXPECT_EQ(drive.run(0.02, std::numeric_limits<double>::infinity()).velocity, 0.0);
}

TEST(RmpCommandGuard, ASilentBaseStopsTheRobotAndHalfASecondFollows) {
  GuardedDrive drive;
  drive.run(3.0, 0.5);
  drive.base_answers = false;
  EXPECT_EQ(drive.run(0.14, 0.5).velocity, 0.0);
  drive.base_answers = true;
  EXPECT_EQ(drive.run(0.48, 0.5).velocity, 0.0);
  EXPECT_GT(drive.run(0.2, 0.5).velocity, 0.0);
}

TEST(RmpCommandGuard, AnEmergencyStopLastsUntilItsRelease) {
  GuardedDrive drive;
  drive.run(3.0, 0.5);
  drive.guard.emergencyStop();
  EXPECT_EQ(drive.run(5.0, 0.5).velocity, 0.0);
  drive.guard.releaseStop();
  EXPECT_GT(drive.run(1.0, 0.5).velocity, 0.0);
}

CanFrame makeTravel(double forward, double yaw, std::uint32_t offset) {
  CanFrame frame;
  frame.id = 0x404;
  const auto set = [&](std::size_t i, std::uint32_t counts) {
    const std::uint16_t words[] = {static_cast<std::uint16_t>(counts & 0xFFFF),
                                   static_cast<std::uint16_t>(counts >> 16)};
    for (std::size_t k = 0; k < 2; ++k) {
      frame.data[2 * (i + k)] = static_cast<std::uint8_t>(words[k] >> 8);
      frame.data[2 * (i + k) + 1] = static_cast<std::uint8_t>(words[k] & 0xFF);
    }
  };
  set(0, offset + static_cast<std::uint32_t>(std::llround(33215.0 * forward)));
  set(2, static_cast<std::uint32_t>(std::llround(112644.0 * yaw / 6.283185307179586)));
  return frame;
}

TEST(RmpOdometry, ACircleClosesAcrossAWrapOfTheCounter) {
  RmpOdometry odometry;
  const int steps = 2000;
  for (int i = 0; i <= steps; ++i) {
    const double yaw = 6.283185307179586 * i / steps;
    EXPECT_TRUE(odometry.add(makeTravel(2.0 * yaw, yaw, 0xFFFF8000U), static_cast<TimeNs>(i) * 10'000'000));
  }
  EXPECT_NEAR(odometry.x(), 0.0, 2e-3);
  EXPECT_NEAR(odometry.y(), 0.0, 2e-3);
  EXPECT_NEAR(odometry.distance(), 12.566, 1e-2);
}

TEST(RmpOdometry, JumpsAreDiscardedAndResetsAreContinuous) {
  RmpOdometry odometry;
  odometry.add(makeTravel(0.0, 0.0, 0), 0);
  odometry.add(makeTravel(0.01, 0.0, 0), 10'000'000);
  EXPECT_FALSE(odometry.add(makeTravel(5.0, 0.0, 0), 20'000'000));
  EXPECT_TRUE(odometry.add(makeTravel(5.01, 0.0, 0), 30'000'000));
  odometry.restart();
  EXPECT_TRUE(odometry.add(makeTravel(0.0, 0.0, 0), 40'000'000));
  EXPECT_NEAR(odometry.x(), 0.02, 1e-3);
  EXPECT_EQ(odometry.jumps(), 1);
}

TEST(RmpStream, SurvivesDamagedPackets) {
  const Bytes packet = *parseHex("F0 55 AA 00 80 20 00 00 00 00 10 FF F8 00 04 00 00 62");
  const std::string seed(packet.begin(), packet.end());
  const auto result = urban_nav_core::testing::fuzzText({seed + seed + seed}, [](const std::string& text) {
    RmpStream stream(0.0);
    stream.feed({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, {1'000'000'000, 0});
    stream.finish();
    parseCandumpLine(text);
  });
  EXPECT_EQ(result.failure, "");
}

}  // namespace
}  // namespace segway_drivers
