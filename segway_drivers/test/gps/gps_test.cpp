// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "segway_drivers/gps/garmin.hpp"
#include "segway_drivers/gps/gpsd.hpp"
#include "segway_drivers/gps/stream.hpp"
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
  EXPECT_FALSE(report->fix->sigma_n);
  EXPECT_EQ(parseGpsdLine(R"({"class":"TPV","mode":"3","lat":[]})")->fix->mode, GpsFix::Mode::None);
  EXPECT_FALSE(parseGpsdLine("[1,2"));
}

TEST(GpsStream, SurvivesDamagedInput) {
  const std::string tpv = R"({"class":"TPV","mode":3,"time":"2024-05-01T10:00:00.000Z","lat":51.75,"lon":-1.25})"
                          "\n";
  std::string garmin = {0x10, 0x33, 64};
  garmin.append(64, '\0');
  garmin += {static_cast<char>(0x100 - 0x73), 0x10, 0x03};
  const auto result =
      urban_nav_core::testing::fuzzText({kGpsGga + kGpsRmc, tpv + tpv, garmin + garmin}, [](const std::string& text) {
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
