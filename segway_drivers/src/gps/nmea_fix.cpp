// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
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

/// Returns the value of `ddmm.mmmm` or `dddmm.mmmm` and its hemisphere, deg.
std::optional<double> parseNmeaAngle(std::string_view text, std::string_view side, char negative, double limit) {
  const auto value = parseNumber(text);
  if (!value || *value < 0.0 || side.size() != 1) return std::nullopt;
  const double degrees = std::floor(*value / 100.0), minutes = *value - 100.0 * degrees;
  const double angle = degrees + minutes / 60.0;
  if (minutes >= 60.0 || angle > limit) return std::nullopt;
  return side.front() == negative ? -angle : angle;
}

/// Returns the milliseconds of the day of `hhmmss.sss`.
std::optional<std::int64_t> parseNmeaTime(std::string_view text) {
  if (text.size() < 6) return std::nullopt;
  const auto hour = parseInteger(text.substr(0, 2)), minute = parseInteger(text.substr(2, 2));
  const auto second = parseNumber(text.substr(4));
  if (!hour || !minute || !second || *hour < 0 || *hour > 23 || *minute < 0 || *minute > 59 || *second < 0 ||
      *second >= 61)
    return std::nullopt;
  return *hour * 3600000 + *minute * 60000 + std::min<std::int64_t>(std::llround(1000.0 * *second), 59999);
}

/// Returns the days since 1970 of `ddmmyy`; years from 80 on are 1980 to 1999.
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

/// Returns a number above zero: receivers write 0 for an unknown deviation.
std::optional<double> aboveZero(std::string_view text) {
  const auto value = positive(text);
  return value && *value > 0.0 ? value : std::nullopt;
}

/// Returns the index of the time field of a sentence with time.
std::optional<std::size_t> timeField(std::string_view kind) {
  if (kind == "GLL") return 4;
  for (const char* each : {"GGA", "GNS", "RMC", "GST", "GBS", "ZDA"})
    if (kind == each) return 0;
  return std::nullopt;
}

/// Returns whether one of these sentences reports a position or the absence of a fix. `kinds`: each followed by a
/// blank.
bool hasPositions(const std::string& kinds) {
  for (const char* each : {"GGA ", "GNS ", "GLL ", "RMC ", "GST "})
    if (kinds.find(each) != std::string::npos) return true;
  return false;
}

/// Quality of a fix, by the field of GGA and the letters of GNS, RMC and GLL.
struct NmeaQuality {
  bool is_fix = false, is_differential = false;
  GpsFix::Carrier carrier = GpsFix::Carrier::None;
};

/// Parses 1 autonomous, 2 differential, 3 precise, 4 and 5 fixed and floating ambiguities; 9 SBAS (NovAtel). Estimates,
/// manual positions and simulations are no fixes.
NmeaQuality readQuality(std::string_view digit) {
  const auto quality = parseInteger(digit);
  if (!quality || ((*quality < 1 || *quality > 5) && *quality != 9)) return {};
  NmeaQuality result{true, *quality != 1 && *quality != 3, GpsFix::Carrier::None};
  if (*quality == 4) result.carrier = GpsFix::Carrier::Fixed;
  if (*quality == 5) result.carrier = GpsFix::Carrier::Float;
  return result;
}

/// Parses one letter per system and takes the best: A autonomous, D differential, P precise, R and F as 4 and 5 above.
NmeaQuality readModes(std::string_view letters) {
  NmeaQuality result;
  for (const char letter : letters) {
    const bool is_carrier = letter == 'R' || letter == 'F';
    result.is_fix = result.is_fix || letter == 'A' || letter == 'D' || letter == 'P' || is_carrier;
    result.is_differential = result.is_differential || letter == 'D' || is_carrier;
    if (letter == 'R') result.carrier = GpsFix::Carrier::Fixed;
    if (letter == 'F' && result.carrier == GpsFix::Carrier::None) result.carrier = GpsFix::Carrier::Float;
  }
  return result;
}

void setQuality(const NmeaQuality& quality, GpsFix& fix) {
  fix.differential = fix.differential || quality.is_differential;
  fix.carrier = std::max(fix.carrier, quality.carrier);
}

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
  if (const auto place = timeField(sentence.kind)) {
    const std::string_view time = sentence.field(*place);
    const bool given = !open_ && !time.empty() && time == given_time_;
    if (given && sentence.kind == "ZDA") addZda(sentence);  // for the fixes to come
    if (given) return;
    const bool repeats = open_ && time.empty() && group_.kinds.find(std::string(sentence.kind)) != std::string::npos;
    if (!open_ || !isOfGroup(time) || repeats) beginGroup(time, offset, arrival, sink);
  }
  if (!open_) return;
  if (sentence.kind == "GGA") addGga(sentence);
  else if (sentence.kind == "GNS") addGns(sentence);
  else if (sentence.kind == "GLL") addGll(sentence);
  else if (sentence.kind == "RMC") addRmc(sentence);
  else if (sentence.kind == "ZDA") addZda(sentence);
  else if (sentence.kind == "GST" || sentence.kind == "GBS") addErrors(sentence);
  else addOther(sentence);
  group_.last_kind = sentence.kind;
  group_.kinds += group_.last_kind + " ";
  const bool last_of_several = sentence.kind != "GSV" || sentence.field(0) == sentence.field(1);
  if (!ends_with_.empty() && ends_with_ == sentence.kind && last_of_several) finish(sink);
}

/// Compares times numerically: some receivers write one time with two decimals in one sentence and three in the next.
bool NmeaFixBuilder::isOfGroup(std::string_view time) const {
  return group_.time == time || (group_.milliseconds && parseNmeaTime(time) == group_.milliseconds);
}

/// Sets latitude and longitude from four fields unless the group already has them.
void NmeaFixBuilder::setPosition(const NmeaSentence& s, std::size_t first) {
  if (group_.fix.latitude) return;
  const auto latitude = parseNmeaAngle(s.field(first), s.field(first + 1), 'S', 90.0);
  const auto longitude = parseNmeaAngle(s.field(first + 2), s.field(first + 3), 'W', 180.0);
  if (!latitude || !longitude) return;
  group_.fix.latitude = latitude;
  group_.fix.longitude = longitude;
}

/// Reads the common fields of GGA and GNS from the number of satellites on: field 6, and the height after the dilution.
void NmeaFixBuilder::addHeight(const NmeaSentence& s, std::size_t geoid_field) {
  const auto satellites = parseInteger(s.field(6));
  if (satellites && *satellites >= 0 && *satellites < 100) group_.fix.satellites = static_cast<int>(*satellites);
  if (!group_.hdop) group_.hdop = positive(s.field(7));
  const auto height = parseNumber(s.field(8)), geoid = parseNumber(s.field(geoid_field));
  if (height && geoid) group_.fix.height = *height + *geoid;
}

void NmeaFixBuilder::addGga(const NmeaSentence& s) {
  const NmeaQuality quality = readQuality(s.field(5));
  group_.valid = group_.valid || quality.is_fix;
  setQuality(quality, group_.fix);
  if (quality.is_fix) setPosition(s, 1);
  addHeight(s, 10);
}

void NmeaFixBuilder::addGns(const NmeaSentence& s) {
  const NmeaQuality quality = readModes(s.field(5));
  group_.valid = group_.valid || quality.is_fix;
  setQuality(quality, group_.fix);
  if (quality.is_fix) setPosition(s, 1);
  addHeight(s, 9);
}

void NmeaFixBuilder::addGll(const NmeaSentence& s) {
  const bool is_fix = s.field(5) == "A" && (s.field(6).empty() || readModes(s.field(6)).is_fix);
  if (!is_fix) return;
  group_.valid = true;
  setQuality(readModes(s.field(6)), group_.fix);
  setPosition(s, 0);
}

void NmeaFixBuilder::addZda(const NmeaSentence& s) {
  const auto day = parseInteger(s.field(1)), month = parseInteger(s.field(2)), year = parseInteger(s.field(3));
  if (!day || !month || !year || *year < 1980 || *year > 9999 || *day < 1 || *day > 31) return;
  const auto days = daysOfDate(static_cast<int>(*year), static_cast<int>(*month), static_cast<int>(*day));
  if (days) days_ = group_.days = days;
}

/// Sets the standard deviations of a GST, or otherwise the expected errors of a GBS.
void NmeaFixBuilder::addErrors(const NmeaSentence& s) {
  GpsFix& fix = group_.fix;
  const bool is_gst = s.kind == "GST";
  if (!is_gst && group_.has_deviations) return;
  const std::size_t first = is_gst ? 5 : 1;
  const auto north = aboveZero(s.field(first)), east = aboveZero(s.field(first + 1)),
             up = aboveZero(s.field(first + 2));
  if (north && east) {
    fix.sigma_n = north;
    fix.sigma_e = east;
    group_.has_deviations = is_gst;
  }
  if (up) fix.sigma_u = up;
}

void NmeaFixBuilder::addRmc(const NmeaSentence& s) {
  GpsFix& fix = group_.fix;
  if (const auto days = parseNmeaDate(s.field(8))) days_ = group_.days = days;
  if (s.field(1) != "A") return;
  const bool is_estimate = !s.field(11).empty() && !readModes(s.field(11)).is_fix;
  if (is_estimate) return;
  group_.valid = true;
  setQuality(readModes(s.field(11)), fix);
  setPosition(s, 2);
  if (const auto knots = positive(s.field(6))) fix.speed = *knots * kNmeaKnot;
  const auto course = positive(s.field(7));
  if (course && *course <= 360.0) fix.track = course;
}

void NmeaFixBuilder::addOther(const NmeaSentence& s) {
  GpsFix& fix = group_.fix;
  if (s.kind == "GSA") {
    const auto mode = parseInteger(s.field(1));
    // One per system, some possibly without a fix.
    if (mode && *mode >= 1 && *mode <= 3) fix.mode = std::max(fix.mode, static_cast<GpsFix::Mode>(*mode));
    if (const auto hdop = positive(s.field(15))) group_.hdop = hdop;
    if (const auto vdop = positive(s.field(16))) group_.vdop = vdop;
  } else if (s.kind == "PGRME" && !fix.sigma_e) {
    if (const auto horizontal = positive(s.field(0))) fix.sigma_e = fix.sigma_n = *horizontal / kHalfOfCircular;
    if (const auto vertical = positive(s.field(2))) fix.sigma_u = *vertical / kHalfOfNormal;
  } else if (s.kind == "VTG" && !fix.speed) {
    if (const auto knots = positive(s.field(4))) fix.speed = *knots * kNmeaKnot;
  }
}

/// Derives values of several sentences: time with date, mode, deviations from dilutions of precision.
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
  const double error = rangeError(fix.carrier, uere_);
  if (group_.hdop && !fix.sigma_e) fix.sigma_e = fix.sigma_n = *group_.hdop * error / std::sqrt(2.0);
  if (!fix.sigma_u && (group_.vdop || group_.hdop))
    fix.sigma_u = error * (group_.vdop ? *group_.vdop : 1.6 * *group_.hdop);
}

void NmeaFixBuilder::finish(const Sink& sink) {
  if (!open_) return;
  open_ = false;
  given_time_ = group_.time;
  // The kind that ended two consecutive groups ends the next ones.
  ends_with_ = ended_with_ == group_.last_kind ? ended_with_ : std::string();
  ended_with_ = group_.last_kind;
  // Some receivers send a date or an expected error alone between fixes, which is no report of a position.
  if (!hasPositions(group_.kinds)) return;
  complete(group_.fix);
  sink(group_.fix);
}

}  // namespace segway_drivers
