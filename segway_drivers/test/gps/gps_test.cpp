// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "segway_drivers/gps/garmin.hpp"
#include "segway_drivers/gps/gpsd.hpp"
#include "segway_drivers/gps/stream.hpp"
#include "segway_drivers/gps/unknown_stream.hpp"
#include "urban_nav_core/testing/fuzz.hpp"

namespace segway_drivers {
namespace {

const std::string kGpsGga = "$GPGGA,165007.000,4143.6058,N,08338.0778,W,1,06,1.5,204.3,M,-33.7,M,,0000*67\r\n";
const std::string kGpsRmc = "$GPRMC,165007.000,A,4143.6058,N,08338.0778,W,0.55,36.58,180710,,,A*4F\r\n";

std::vector<GpsFix> parseFixes(const std::string& text, std::size_t chunk = 4096) {
  GpsStream stream(GpsStream::Options{});
  std::vector<GpsFix> fixes;
  stream.on_fix = [&](const GpsFix& fix, std::optional<TimeNs>) { fixes.push_back(fix); };
  const ByteView bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  for (std::size_t at = 0; at < bytes.size; at += chunk)
    stream.feed(bytes.sub(at, std::min(chunk, bytes.size - at)), {});
  stream.finish();
  return fixes;
}

std::string sentence(const std::string& body) {
  const Bytes bytes = makeNmeaSentence(body);
  return {bytes.begin(), bytes.end()};
}

TEST(GpsNmea, SentencesOfOneTimeAreOneFix) {
  for (const std::size_t chunk : {1U, 7U, 4096U}) {
    const auto fixes = parseFixes(kGpsGga + kGpsRmc, chunk);
    ASSERT_EQ(fixes.size(), 1U);
    EXPECT_NEAR(*fixes[0].latitude, 41.726763, 1e-6);
    EXPECT_NEAR(*fixes[0].longitude, -83.634630, 1e-6);
    EXPECT_NEAR(*fixes[0].height, 170.6, 1e-9);
    EXPECT_NEAR(*fixes[0].speed, 0.283, 1e-3);
    EXPECT_NEAR(*fixes[0].sigma_e, 1.5 * 4.5 / std::sqrt(2.0), 1e-9);
    EXPECT_EQ(fixes[0].utc, "2010-07-18T16:50:07.000Z");
    EXPECT_EQ(fixes[0].satellites, 6);
  }
}

TEST(GpsNmea, EmptyFieldsAreUnknownAndATimeIsGivenOnce) {
  const auto fixes = parseFixes(sentence("GPGGA,,,,,,0,00,,,M,,M,,") + kGpsRmc + kGpsRmc +
                                sentence("GPGSA,A,1,,,,,,,,,,,,,,,") + kGpsRmc);
  ASSERT_EQ(fixes.size(), 2U);
  EXPECT_FALSE(fixes[0].latitude);
  EXPECT_EQ(fixes[0].mode, GpsFix::Mode::None);
  EXPECT_TRUE(fixes[1].latitude);
  EXPECT_FALSE(fixes[1].height);
}

TEST(GpsNmea, StatedErrorsPrecedeDilution) {
  const auto fixes = parseFixes(kGpsGga + sentence("GPGST,165007.000,,,,,3.0,2.0,7.0") + kGpsRmc);
  ASSERT_EQ(fixes.size(), 1U);
  EXPECT_EQ(fixes[0].sigma_n, 3.0);
  EXPECT_EQ(fixes[0].sigma_e, 2.0);
  EXPECT_EQ(fixes[0].sigma_u, 7.0);
}

TEST(GpsNmea, ALearntCycleEndsWithoutWaitingForTheNext) {
  GpsStream stream(GpsStream::Options{});
  std::vector<std::string> times;
  stream.on_fix = [&](const GpsFix& fix, std::optional<TimeNs>) { times.push_back(fix.utc); };
  for (int second = 0; second < 6; ++second) {
    const std::string text =
        sentence("GPGGA,10000" + std::to_string(second) + ",4143.6058,N,08338.0778,W,1,06,1.5,204.3,M,-33.7,M,,") +
        sentence("GPRMC,10000" + std::to_string(second) + ",A,4143.6058,N,08338.0778,W,0,0,180710,,,A");
    stream.feed({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, {});
    EXPECT_EQ(times.size(), static_cast<std::size_t>(second < 2 ? second : second + 1)) << second;
  }
}

TEST(GpsNmea, SilenceEndsAGroup) {
  GpsStream stream(GpsStream::Options{4.5, 0.2});
  std::optional<TimeNs> stamp;
  stream.on_fix = [&](const GpsFix&, std::optional<TimeNs> time) { stamp = time; };
  stream.feed({reinterpret_cast<const std::uint8_t*>(kGpsGga.data()), kGpsGga.size()}, {10'000'000'000, 0});
  stream.expire(10'300'000'000);
  EXPECT_FALSE(stamp);
  stream.expire(10'500'000'000);
  EXPECT_EQ(stamp, 9'800'000'000);
}

const std::string kGpsPlace = "4143.6058,N,08338.0778,W";

TEST(GpsNmea, GnsIsAFixOfAllSystems) {
  const auto fixes = parseFixes(sentence("GNGNS,165007.00," + kGpsPlace + ",NDNN,12,0.8,204.3,-33.7,1.0,0000") +
                                sentence("GNGNS,165008.00," + kGpsPlace + ",NNNN,00,,,,,"));
  ASSERT_EQ(fixes.size(), 2U);
  EXPECT_NEAR(*fixes[0].latitude, 41.726763, 1e-6);
  EXPECT_NEAR(*fixes[0].longitude, -83.634630, 1e-6);
  EXPECT_NEAR(*fixes[0].height, 170.6, 1e-9);
  EXPECT_EQ(fixes[0].satellites, 12);
  EXPECT_EQ(fixes[0].mode, GpsFix::Mode::Fix3D);
  EXPECT_TRUE(fixes[0].differential);
  EXPECT_EQ(fixes[1].mode, GpsFix::Mode::None);
  EXPECT_FALSE(fixes[1].latitude);
}

TEST(GpsNmea, QualitiesOfRealTimeKinematicsAreStatedInCentimetres) {
  const auto gga = [](int second, int quality) {
    return sentence("GNGGA,10000" + std::to_string(second) + ".00," + kGpsPlace + "," + std::to_string(quality) +
                    ",20,0.7,204.3,M,-33.7,M,1.0,0000");
  };
  const auto fixes = parseFixes(gga(0, 4) + gga(1, 5) + gga(2, 1) + gga(3, 6) +
                                sentence("GNGNS,100004.00," + kGpsPlace + ",RFNN,20,0.7,204.3,-33.7,1.0,0000"));
  ASSERT_EQ(fixes.size(), 5U);
  EXPECT_EQ(fixes[0].carrier, GpsFix::Carrier::Fixed);
  EXPECT_LT(*fixes[0].sigma_e, 0.05);
  EXPECT_LT(*fixes[0].sigma_u, 0.05);
  EXPECT_EQ(fixes[1].carrier, GpsFix::Carrier::Float);
  EXPECT_GT(*fixes[1].sigma_e, 0.1);
  EXPECT_LT(*fixes[1].sigma_e, 1.0);
  EXPECT_EQ(fixes[2].carrier, GpsFix::Carrier::None);
  EXPECT_GT(*fixes[2].sigma_e, 2.0);
  EXPECT_EQ(fixes[3].mode, GpsFix::Mode::None) << "an estimate without satellites";
  EXPECT_EQ(fixes[4].carrier, GpsFix::Carrier::Fixed);
  EXPECT_LT(*fixes[4].sigma_e, 0.05);
  const auto stated = parseFixes(gga(0, 4) + sentence("GNGST,100000.00,9,,,,0.011,0.012,0.02"));
  EXPECT_DOUBLE_EQ(*stated.front().sigma_n, 0.011) << "as the receiver states it";
}

TEST(GpsNmea, ExpectedErrorsYieldToDeviationsAndZerosAreUnknown) {
  const std::string gbs = sentence("GNGBS,165007,1.5,2.5,4.5,,,,"), gst = sentence("GNGST,165007.00,,,,,3.0,2.0,7.0");
  for (const std::string& text : {kGpsGga + gbs + kGpsRmc, kGpsGga + gbs + gst + kGpsRmc, kGpsGga + gst + gbs + kGpsRmc,
                                  kGpsGga + sentence("GNGST,165007.00,,,,,0.0,0.0,0.0") + kGpsRmc}) {
    const auto fixes = parseFixes(text);
    ASSERT_EQ(fixes.size(), 1U) << "of one time, however many decimals it has";
    const bool is_zero = text.find("0.0,0.0,0.0") != std::string::npos,
               has_gst = text.find("3.0,2.0") != std::string::npos;
    EXPECT_NEAR(*fixes[0].sigma_e, is_zero ? 1.5 * 4.5 / std::sqrt(2.0) : has_gst ? 2.0 : 2.5, 1e-9);
    if (!is_zero) {
      EXPECT_EQ(fixes[0].sigma_u, has_gst ? 7.0 : 4.5);
    }
  }
}

TEST(GpsNmea, DatesComeFromZdaToo) {
  const std::string zda = sentence("GPZDA,165007.00,18,07,2010,00,00");
  for (const std::string& text : {zda + kGpsGga, kGpsGga + zda}) {
    const auto fixes = parseFixes(text);
    ASSERT_EQ(fixes.size(), 1U);
    EXPECT_EQ(fixes[0].utc, "2010-07-18T16:50:07.000Z");
    EXPECT_TRUE(fixes[0].latitude);
  }
  EXPECT_TRUE(parseFixes(zda + sentence("GPZDA,165008.00,18,07,2010,00,00")).empty()) << "a date alone is no fix";
  EXPECT_EQ(parseFixes(sentence("GPZDA,165007.00,31,02,2010,00,00") + kGpsGga)[0].utc, "165007.00");
}

TEST(GpsNmea, GllIsAFixWithoutAHeight) {
  const auto fixes =
      parseFixes(sentence("GPGLL," + kGpsPlace + ",165007.00,A,A") + sentence("GPGLL," + kGpsPlace + ",165008.00,V,N") +
                 sentence("GPGLL," + kGpsPlace + ",165009.00,A,E"));
  ASSERT_EQ(fixes.size(), 3U);
  EXPECT_EQ(fixes[0].mode, GpsFix::Mode::Fix2D);
  EXPECT_NEAR(*fixes[0].latitude, 41.726763, 1e-6);
  EXPECT_EQ(fixes[1].mode, GpsFix::Mode::None);
  EXPECT_EQ(fixes[2].mode, GpsFix::Mode::None) << "estimated";
}

std::string little(std::int64_t value, std::size_t size) {
  std::string text;
  for (std::size_t i = 0; i < size; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

std::string ubxFrame(int kind, int message, const std::string& payload) {
  std::string body =
      little(kind, 1) + little(message, 1) + little(static_cast<std::int64_t>(payload.size()), 2) + payload;
  unsigned a = 0, b = 0;
  for (const char byte : body) b += a += static_cast<std::uint8_t>(byte);
  return "\xB5\x62" + body + little(a & 0xffU, 1) + little(b & 0xffU, 1);
}

/// NAV-PVT of 92 bytes; `flags`: fix is good, differential, two bits of the carrier.
std::string navPvt(int kind, int flags, int flags3 = 0) {
  return ubxFrame(1, 7,
                  little(0, 4) + little(2024, 2) + little(5, 1) + little(1, 1) + little(0, 1) + little(0, 1) +
                      little(0, 1) + little(7, 1) + little(25, 4) + little(-400'000'000, 4) + little(kind, 1) +
                      little(flags, 1) + little(0, 1) + little(17, 1) + little(-12'500'000, 4) +
                      little(517'500'000, 4) + little(110'500, 4) + little(63'000, 4) + little(14, 4) + little(20, 4) +
                      little(1000, 4) + little(-1000, 4) + little(500, 4) + little(1414, 4) + little(-4'500'000, 4) +
                      little(30, 4) + little(0, 4) + little(120, 2) + little(flags3, 2) + std::string(12, '\0'));
}

TEST(GpsUbx, NavPvtIsAFix) {
  for (const std::size_t chunk : {1U, 7U, 4096U}) {
    const auto fixes = parseFixes(ubxFrame(1, 0x35, "none") + navPvt(3, 0x83) + kGpsGga, chunk);
    ASSERT_EQ(fixes.size(), 2U);
    EXPECT_EQ(fixes[0].source, "ubx");
    EXPECT_EQ(fixes[0].utc, "2024-04-30T23:59:59.600Z") << "0.4 s before midnight";
    EXPECT_EQ(fixes[0].mode, GpsFix::Mode::Fix3D);
    EXPECT_NEAR(*fixes[0].latitude, 51.75, 1e-9);
    EXPECT_NEAR(*fixes[0].longitude, -1.25, 1e-9);
    EXPECT_NEAR(*fixes[0].height, 110.5, 1e-9) << "above the ellipsoid";
    EXPECT_NEAR(*fixes[0].sigma_e, 0.014 / std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(*fixes[0].sigma_u, 0.020, 1e-9);
    EXPECT_NEAR(*fixes[0].climb, -0.5, 1e-9);
    EXPECT_NEAR(*fixes[0].speed, 1.414, 1e-9);
    EXPECT_NEAR(*fixes[0].track, 315.0, 1e-9);
    EXPECT_EQ(fixes[0].satellites, 17);
    EXPECT_EQ(fixes[0].carrier, GpsFix::Carrier::Fixed);
    EXPECT_EQ(fixes[1].source, "nmea");
  }
}

TEST(GpsUbx, WhatIsNotGoodIsNoFix) {
  for (const std::string& frame : {navPvt(0, 1), navPvt(5, 1), navPvt(3, 0), navPvt(3, 1, 1), navPvt(1, 1)}) {
    const auto fixes = parseFixes(frame);
    ASSERT_EQ(fixes.size(), 1U);
    EXPECT_EQ(fixes[0].mode, GpsFix::Mode::None);
    EXPECT_FALSE(fixes[0].latitude);
  }
  EXPECT_EQ(parseFixes(navPvt(3, 0x43))[0].carrier, GpsFix::Carrier::Float);
  EXPECT_FALSE(parseFixes(navPvt(2, 1))[0].height);
  std::string damaged = navPvt(3, 1);
  damaged[40] = static_cast<char>(damaged[40] ^ 1);
  EXPECT_TRUE(parseFixes(damaged).empty());
}

TEST(GpsUbx, CorrectionsAreRecognisedAndSkipped) {
  // The frame of message 1005 in RTCM 10403, section 4.2.
  const auto bytes = parseHex("D300133ED7D30202980EDEEF34B4BD62AC0941986F33360B98");
  ASSERT_TRUE(bytes);
  GpsStream stream(GpsStream::Options{});
  std::vector<std::string> kinds;
  stream.on_message = [&](const std::string& kind) { kinds.push_back(kind); };
  stream.feed(*bytes, {});
  stream.feed({reinterpret_cast<const std::uint8_t*>(kGpsGga.data()), kGpsGga.size()}, {});
  stream.finish();
  EXPECT_EQ(kinds, (std::vector<std::string>{"rtcm 1005", "GGA"}));
  EXPECT_EQ(stream.counters().bytes_skipped, 0);
}

std::string describe(const std::string& text) {
  return describeUnknownStream({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

TEST(GpsUnknownStream, TheLikelyProtocolIsNamed) {
  const std::string payload = std::string("\x29\x00\x01\x02\x03\x10\x20", 7);
  std::string sirf, tsip, ubx;
  for (int i = 0; i < 20; ++i) {
    unsigned sum = 0;
    for (const char byte : payload) sum += static_cast<std::uint8_t>(byte);
    sirf += std::string("\xA0\xA2\x00\x07", 4) + payload + little(sum >> 8U, 1) + little(sum & 0xffU, 1) + "\xB0\xB3";
    tsip += std::string("\x10\x8F\xAB", 3) + std::string(15, static_cast<char>(i)) + "\x10\x10\x10\x03";
    ubx += navPvt(3, 1);
    ubx[ubx.size() - 1] = static_cast<char>(ubx[ubx.size() - 1] ^ 0x55);
  }
  EXPECT_EQ(describe(sirf).rfind("SiRF", 0), 0U) << describe(sirf);
  EXPECT_EQ(describe(sirf.substr(5)).rfind("SiRF", 0), 0U) << "from the middle of a frame";
  EXPECT_EQ(describe(tsip).rfind("Trimble TSIP", 0), 0U) << describe(tsip);
  EXPECT_EQ(describe(ubx).rfind("UBX", 0), 0U) << describe(ubx);
  EXPECT_EQ(describe("$GPGGA,1,2,3\r\n$GPRMC,1,2,3\r\n").rfind("NMEA", 0), 0U);
  EXPECT_EQ(describe("login: \r\n"), "text, but not NMEA");
  EXPECT_NE(describe("").find("empty"), std::string::npos);
  std::mt19937 random(3);
  std::string noise, wrong_rate;
  for (int i = 0; i < 5000; ++i) noise += static_cast<char>(random() & 0xffU);
  for (const char c : kGpsGga + kGpsRmc + kGpsGga + kGpsRmc) {  // at half the rate each bit is seen twice
    unsigned bits = 0;
    for (unsigned bit = 0; bit < 4; ++bit) bits |= (static_cast<unsigned>(c) >> bit & 1U) * (3U << (2 * bit));
    wrong_rate += static_cast<char>(bits);
  }
  EXPECT_EQ(describe(noise).rfind("a wrong line rate", 0), 0U) << describe(noise);
  EXPECT_EQ(describe(wrong_rate).rfind("a wrong line rate", 0), 0U) << describe(wrong_rate);
}

TEST(GpsDate, DaysAndDatesAgree) {
  EXPECT_EQ(daysOfDate(1970, 1, 1), 0);
  EXPECT_EQ(daysOfDate(2000, 2, 29), 11016);
  EXPECT_FALSE(daysOfDate(2001, 2, 29));
  EXPECT_FALSE(daysOfDate(2001, 13, 1));
  EXPECT_EQ(printUtc(11016, 86399999), "2000-02-29T23:59:59.999Z");
}

TEST(Gpsd, ReportsAtThe95PercentLevel) {
  const auto report = parseGpsdLine(
      R"({"class":"TPV","mode":3,"time":"2024-05-01T10:00:00.000Z","lat":51.75,"lon":-1.25,"altHAE":110.5,"epx":3.92,"epv":19.6,"speed":1.5})");
  ASSERT_TRUE(report && report->fix);
  EXPECT_NEAR(*report->fix->sigma_e, 2.0, 1e-12);
  EXPECT_NEAR(*report->fix->sigma_u, 10.0, 1e-12);
  EXPECT_EQ(report->fix->sigma_n, report->fix->sigma_e) << "of the other axis, where there is no circle";
  const auto circle =
      parseGpsdLine(R"({"class":"TPV","mode":3,"status":3,"lat":51.75,"lon":-1.25,"eph":2.4477,"epy":3.92,"epv":0})");
  EXPECT_NEAR(*circle->fix->sigma_e, 1.0, 1e-9);
  EXPECT_NEAR(*circle->fix->sigma_n, 2.0, 1e-9);
  EXPECT_FALSE(circle->fix->sigma_u);
  EXPECT_EQ(circle->fix->carrier, GpsFix::Carrier::Fixed);
  EXPECT_EQ(parseGpsdLine(R"({"class":"TPV","mode":"3","lat":[]})")->fix->mode, GpsFix::Mode::None);
  EXPECT_FALSE(parseGpsdLine("[1,2"));
}

TEST(GpsStream, SurvivesDamagedInput) {
  const std::string tpv = R"({"class":"TPV","mode":3,"time":"2024-05-01T10:00:00.000Z","lat":51.75,"lon":-1.25})"
                          "\n";
  std::string garmin = {0x10, 0x33, 64};
  garmin.append(64, '\0');
  garmin += {static_cast<char>(0x100 - 0x73), 0x10, 0x03};
  const auto result = urban_nav_core::testing::fuzzText(
      {kGpsGga + kGpsRmc, tpv + tpv, garmin + garmin, navPvt(3, 1) + kGpsGga}, [](const std::string& text) {
        describe(text);
        for (const GpsFix& fix : parseFixes(text)) {
          if (fix.latitude) {
            EXPECT_LE(std::abs(*fix.latitude), 90.0);
          }
        }
      });
  EXPECT_EQ(result.failure, "");
}

}  // namespace
}  // namespace segway_drivers
