// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "segway_drivers/gps/nmea.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace segway_drivers {

using urban_nav_core::parseInteger;
using urban_nav_core::parseNumber;

namespace {

constexpr double kNmeaKnot = 1852.0 / 3600.0;  // m/s
constexpr double kHalfOfCircular = 1.1774;     // 50 % radius of a circular normal distribution, in sigmas
constexpr double kHalfOfNormal = 0.6745;       // 50 % of a normal distribution, in sigmas

/// Value of `ddmm.mmmm` or `dddmm.mmmm` and its hemisphere, deg.
std::optional<double> parseNmeaAngle(std::string_view text, std::string_view side, char negative, double limit) {
  const auto value = parseNumber(text);
  if (!value || *value < 0.0 || side.size() != 1) return std::nullopt;
  const double degrees = std::floor(*value / 100.0), minutes = *value - 100.0 * degrees;
  const double angle = degrees + minutes / 60.0;
  if (minutes >= 60.0 || angle > limit) return std::nullopt;
  return side.front() == negative ? -angle : angle;
}

/// Milliseconds of the day of `hhmmss.sss`.
std::optional<std::int64_t> parseNmeaTime(std::string_view text) {
  if (text.size() < 6) return std::nullopt;
  const auto hour = parseInteger(text.substr(0, 2)), minute = parseInteger(text.substr(2, 2));
  const auto second = parseNumber(text.substr(4));
  if (!hour || !minute || !second || *hour < 0 || *hour > 23 || *minute < 0 || *minute > 59 || *second < 0 ||
      *second >= 61)
    return std::nullopt;
  return *hour * 3600000 + *minute * 60000 + std::min<std::int64_t>(std::llround(1000.0 * *second), 59999);
}

/// Days since 1970 of `ddmmyy`; years from 80 on belong to the last century.
std::optional<std::int64_t> parseNmeaDate(std::string_view text) {
  const auto number = text.size() == 6 ? parseInteger(text) : std::nullopt;
  if (!number || *number < 0) return std::nullopt;
  const int year = static_cast<int>(*number % 100);
  return daysOfDate(year + (year >= 80 ? 1900 : 2000), static_cast<int>(*number / 100 % 100),
                    static_cast<int>(*number / 10000));
}

std::optional<double> positive(std::string_view text) {
  const auto value = parseNumber(text);
  return value && *value >= 0.0 ? value : std::nullopt;
}

bool carriesTime(std::string_view kind) { return kind == "GGA" || kind == "RMC" || kind == "GST"; }

}  // namespace

void NmeaFixBuilder::beginGroup(std::string_view time, std::uint64_t offset, TimeNs arrival, const Sink& sink) {
  finish(sink);
  group_ = Group();
  group_.time = time;
  group_.milliseconds = parseNmeaTime(time);
  group_.fix.offset = offset;
  group_.fix.arrival = arrival;
  group_.fix.source = "nmea";
  open_ = true;
}

void NmeaFixBuilder::add(const NmeaSentence& sentence, std::uint64_t offset, TimeNs arrival, const Sink& sink) {
  if (carriesTime(sentence.kind)) {
    const std::string_view time = sentence.field(0);
    const bool given = !open_ && !time.empty() && time == given_time_;
    if (given) return;
    const bool repeats = open_ && time.empty() && group_.kinds.find(std::string(sentence.kind)) != std::string::npos;
    if (!open_ || group_.time != time || repeats) beginGroup(time, offset, arrival, sink);
  }
  if (!open_) return;
  if (sentence.kind == "GGA") addGga(sentence);
  else if (sentence.kind == "RMC") addRmc(sentence);
  else addOther(sentence);
  group_.last_kind = sentence.kind;
  group_.kinds += group_.last_kind + " ";
  const bool last_of_several = sentence.kind != "GSV" || sentence.field(0) == sentence.field(1);
  if (!ends_with_.empty() && ends_with_ == sentence.kind && last_of_several) finish(sink);
}

void NmeaFixBuilder::addGga(const NmeaSentence& s) {
  GpsFix& fix = group_.fix;
  const auto quality = parseInteger(s.field(5));
  group_.valid = group_.valid || (quality && *quality >= 1 && *quality <= 5);
  fix.differential = fix.differential || (quality && (*quality == 2 || *quality == 4 || *quality == 5));
  const auto latitude = parseNmeaAngle(s.field(1), s.field(2), 'S', 90.0);
  const auto longitude = parseNmeaAngle(s.field(3), s.field(4), 'W', 180.0);
  if (latitude && longitude && quality && *quality >= 1 && *quality <= 5) {
    fix.latitude = latitude;
    fix.longitude = longitude;
  }
  const auto satellites = parseInteger(s.field(6));
  if (satellites && *satellites >= 0 && *satellites < 100) fix.satellites = static_cast<int>(*satellites);
  if (!group_.hdop) group_.hdop = positive(s.field(7));
  const auto height = parseNumber(s.field(8)), geoid = parseNumber(s.field(10));
  if (height && geoid) fix.height = *height + *geoid;
}

void NmeaFixBuilder::addRmc(const NmeaSentence& s) {
  GpsFix& fix = group_.fix;
  if (const auto days = parseNmeaDate(s.field(8))) days_ = group_.days = days;
  if (s.field(1) != "A") return;
  group_.valid = true;
  const auto latitude = parseNmeaAngle(s.field(2), s.field(3), 'S', 90.0);
  const auto longitude = parseNmeaAngle(s.field(4), s.field(5), 'W', 180.0);
  if (latitude && longitude && !fix.latitude) {
    fix.latitude = latitude;
    fix.longitude = longitude;
  }
  if (const auto knots = positive(s.field(6))) fix.speed = *knots * kNmeaKnot;
  const auto course = positive(s.field(7));
  if (course && *course <= 360.0) fix.track = course;
}

void NmeaFixBuilder::addOther(const NmeaSentence& s) {
  GpsFix& fix = group_.fix;
  if (s.kind == "GSA") {
    const auto mode = parseInteger(s.field(1));
    if (mode && *mode >= 1 && *mode <= 3) fix.mode = static_cast<GpsFix::Mode>(*mode);
    if (const auto hdop = positive(s.field(15))) group_.hdop = hdop;
    group_.vdop = positive(s.field(16));
  } else if (s.kind == "GST") {
    fix.sigma_n = positive(s.field(5));
    fix.sigma_e = positive(s.field(6));
    fix.sigma_u = positive(s.field(7));
  } else if (s.kind == "PGRME" && !fix.sigma_e) {
    if (const auto horizontal = positive(s.field(0))) fix.sigma_e = fix.sigma_n = *horizontal / kHalfOfCircular;
    if (const auto vertical = positive(s.field(2))) fix.sigma_u = *vertical / kHalfOfNormal;
  } else if (s.kind == "VTG" && !fix.speed) {
    if (const auto knots = positive(s.field(4))) fix.speed = *knots * kNmeaKnot;
  }
}

/// Derives what follows from several sentences: time with date, mode, deviations from dilutions of precision.
void NmeaFixBuilder::complete(GpsFix& fix) const {
  const auto days = group_.days ? group_.days : days_;
  if (group_.milliseconds) fix.utc = days ? printUtc(*days, *group_.milliseconds) : group_.time;
  if (!group_.valid) {
    fix.mode = GpsFix::Mode::None;
    fix.latitude = fix.longitude = fix.height = fix.sigma_e = fix.sigma_n = fix.sigma_u = fix.speed = fix.track = {};
    return;
  }
  if (fix.mode == GpsFix::Mode::None) fix.mode = fix.height ? GpsFix::Mode::Fix3D : GpsFix::Mode::Fix2D;
  if (!fix.latitude) fix.mode = GpsFix::Mode::None;
  if (group_.hdop && !fix.sigma_e) fix.sigma_e = fix.sigma_n = *group_.hdop * uere_ / std::sqrt(2.0);
  if (!fix.sigma_u && (group_.vdop || group_.hdop))
    fix.sigma_u = uere_ * (group_.vdop ? *group_.vdop : 1.6 * *group_.hdop);
}

void NmeaFixBuilder::finish(const Sink& sink) {
  if (!open_) return;
  open_ = false;
  given_time_ = group_.time;
  // The kind that ended two groups in a row ends the next ones too.
  ends_with_ = ended_with_ == group_.last_kind ? ended_with_ : std::string();
  ended_with_ = group_.last_kind;
  complete(group_.fix);
  sink(group_.fix);
}

}  // namespace segway_drivers
