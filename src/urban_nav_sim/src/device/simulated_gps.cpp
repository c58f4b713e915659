// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/device/simulated_gps.hpp"

#include <cmath>
#include <cstdio>
#include <ctime>

namespace urban_nav_sim {

namespace {

constexpr int kGpsBaud = 9600, kGpsdRate = 100'000'000;
constexpr double kGpsLeastDelay = 0.0;                                                    // ms
constexpr double kKnotsPerMps = 3600.0 / 1852.0, kGeoidHeight = 47.0, kRangeError = 4.5;  // m

std::string withChecksum(const std::string& body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  char end[8];
  std::snprintf(end, sizeof(end), "*%02X\r\n", sum);
  return "$" + body + end;
}

struct UtcParts {
  std::tm date{};
  int milliseconds = 0;
};

UtcParts utcParts(double seconds) {
  const auto ms = std::llround(1000.0 * seconds);
  const std::time_t whole = static_cast<std::time_t>(ms / 1000);
  UtcParts parts;
  gmtime_r(&whole, &parts.date);
  parts.milliseconds = static_cast<int>(ms % 1000);
  return parts;
}

/// "5145.1234,N" with `digits` of degrees.
std::string nmeaAngle(double degrees, int digits, char positive, char negative) {
  const double value = std::abs(degrees);
  double whole = std::floor(value), minutes = 60.0 * (value - whole);
  if (minutes >= 59.999995) {
    whole += 1.0;
    minutes = 0.0;
  }
  char text[40];
  std::snprintf(text, sizeof(text), "%0*d%08.5f,%c", digits, static_cast<int>(whole), minutes,
                degrees < 0 ? negative : positive);
  return text;
}

}  // namespace

std::string nmeaOfReading(const GpsReading& reading, double seconds) {
  const UtcParts utc = utcParts(seconds);
  char time[48], date[48], text[300];
  std::snprintf(time, sizeof(time), "%02d%02d%02d.%03d", utc.date.tm_hour, utc.date.tm_min, utc.date.tm_sec,
                utc.milliseconds);
  std::snprintf(date, sizeof(date), "%02d%02d%02d", utc.date.tm_mday, utc.date.tm_mon + 1, utc.date.tm_year % 100);
  if (!reading.valid)
    return withChecksum("GPGGA," + std::string(time) + ",,,,,0,00,,,M,,M,,") +
           withChecksum("GPGSA,A,1,,,,,,,,,,,,,,,") +
           withChecksum("GPRMC," + std::string(time) + ",V,,,,,,," + date + ",,,N");
  const std::string place = nmeaAngle(reading.latitude, 2, 'N', 'S') + "," + nmeaAngle(reading.longitude, 3, 'E', 'W');
  const double hdop = reading.sigma * std::sqrt(2.0) / kRangeError;
  std::snprintf(text, sizeof(text), "GPGGA,%s,%s,1,08,%.1f,%.1f,M,%.1f,M,,", time, place.c_str(), hdop,
                reading.height - kGeoidHeight, kGeoidHeight);
  std::string sentences = withChecksum(text);
  std::snprintf(text, sizeof(text), "GPGSA,A,3,01,02,03,04,05,06,07,08,,,,,%.1f,%.1f,%.1f", 2.0 * hdop, hdop,
                1.6 * hdop);
  sentences += withChecksum(text);
  std::snprintf(text, sizeof(text), "GPRMC,%s,A,%s,%.2f,%.2f,%s,,,A", time, place.c_str(), kKnotsPerMps * reading.speed,
                reading.track, date);
  return sentences + withChecksum(text);
}

std::string gpsdOfReading(const GpsReading& reading, double seconds) {
  const UtcParts utc = utcParts(seconds);
  char text[400];
  const int begin = std::snprintf(
      text, sizeof(text),
      R"({"class":"TPV","device":"/dev/simulated","mode":%d,"time":"%04d-%02d-%02dT%02d:%02d:%02d.%03dZ")",
      reading.valid ? 3 : 1, utc.date.tm_year + 1900, utc.date.tm_mon + 1, utc.date.tm_mday, utc.date.tm_hour,
      utc.date.tm_min, utc.date.tm_sec, utc.milliseconds);
  std::string line(text, static_cast<std::size_t>(begin));
  if (reading.valid) {
    const int more = std::snprintf(
        text, sizeof(text),
        R"(,"lat":%.9f,"lon":%.9f,"altHAE":%.3f,"epx":%.3f,"epy":%.3f,"epv":%.3f,"track":%.4f,"speed":%.3f)",
        reading.latitude, reading.longitude, reading.height, 1.96 * reading.sigma, 1.96 * reading.sigma,
        3.2 * reading.sigma, reading.track, reading.speed);
    line.append(text, static_cast<std::size_t>(more));
  }
  return line + "}\r\n";
}

std::string gpsdGreeting() {
  return R"({"class":"VERSION","release":"3.22","rev":"3.22","proto_major":3,"proto_minor":14})"
         "\r\n";
}

std::string gpsdWatchAnswer() {
  return R"({"class":"DEVICES","devices":[{"class":"DEVICE","path":"/dev/simulated","driver":"NMEA0183"}]})"
         "\r\n"
         R"({"class":"WATCH","enable":true,"json":true,"nmea":false,"raw":0})"
         "\r\n";
}

SimulatedGps::SimulatedGps(std::vector<GpsReading> readings, double utc, bool gpsd, const DeviceOptions& options)
    : SimulatedDevice(options, kGpsLeastDelay, gpsd ? kGpsdRate : kGpsBaud),
      readings_(std::move(readings)),
      utc_(utc),
      gpsd_(gpsd) {}

void SimulatedGps::takeByte(std::uint8_t byte) {
  if (!gpsd_) return;
  if (byte != '\n' && byte != ';') {
    if (line_.size() < 1000) line_ += static_cast<char>(byte);
    return;
  }
  if (line_.find("?WATCH") != std::string::npos) {
    const std::string text = gpsdWatchAnswer();
    sendNow(DeviceBytes(text.begin(), text.end()));
    watched_ = true;
  }
  line_.clear();
}

bool SimulatedGps::measure(double t) {
  const double rate = 1.0 + clock().skew;
  while (next_ < readings_.size() && readings_[next_].time / rate <= t) {
    const GpsReading& reading = readings_[next_];
    const double utc = utc_ + reading.time;
    const std::string text = gpsd_ ? gpsdOfReading(reading, utc) : nmeaOfReading(reading, utc);
    if (!gpsd_ || watched_)
      sendMeasurement(DeviceBytes(text.begin(), text.end()), reading.time / rate, static_cast<std::int64_t>(next_));
    ++next_;
  }
  return next_ < readings_.size();
}

}  // namespace urban_nav_sim
