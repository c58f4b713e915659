// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/las_writer.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "urban_nav_core/io/cloud/ply_writer.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr double kLasScale = 1e-4;  // m
constexpr double kLasOffsetStep = 1000.0;
constexpr std::size_t kLasHeader = 375, kVlrHeader = 54, kAttributeRow = 192, kLasRecord = 36;  // bytes
constexpr std::uint16_t kAdjustedGpsTime = 1, kWkt = 16;  // of the global encoding
constexpr double kAdjustment = 1e9;                       // s
constexpr std::int64_t kGpsEpoch = 315'964'800;           // s, 1980-01-06 in Unix time
/// Introductions of leap seconds since then, in Unix time (IERS Bulletin C).
constexpr std::array<std::int64_t, 18> kLeapSeconds = {
    362'793'600, 394'329'600,   425'865'600,   489'024'000,   567'993'600,   631'152'000,
    662'688'000, 709'948'800,   741'484'800,   773'020'800,   820'454'400,   867'715'200,
    915'148'800, 1'136'073'600, 1'230'768'000, 1'341'100'800, 1'435'708'800, 1'483'228'800};

std::size_t attributeBytes(const LasAttribute& attribute) {
  switch (attribute.type) {
    case LasAttribute::Type::UChar: return 1;
    case LasAttribute::Type::UShort: return 2;
    case LasAttribute::Type::Float: return 4;
  }
  return 0;
}

std::size_t recordBytes(const std::vector<LasAttribute>& attributes) {
  std::size_t bytes = kLasRecord;
  for (const LasAttribute& attribute : attributes) bytes += attributeBytes(attribute);
  return bytes;
}

std::size_t lasHeaderBytes(const std::vector<LasAttribute>& attributes, const std::string& wkt) {
  return kLasHeader + kVlrHeader + wkt.size() + 1 +
         (attributes.empty() ? 0 : kVlrHeader + kAttributeRow * attributes.size());
}

void appendPadded(std::string& bytes, std::string_view text, std::size_t size) {
  bytes.append(text.substr(0, size));
  bytes.append(size - std::min(size, text.size()), '\0');
}

void appendCount(std::string& bytes, std::size_t count) {
  appendLittleEndian(bytes, static_cast<std::uint32_t>(count & 0xFFFFFFFFU));
  appendLittleEndian(bytes, static_cast<std::uint32_t>(count >> 32U));
}

void appendVlr(std::string& bytes, const char* user, std::uint16_t record, const char* description,
               const std::string& content) {
  appendLittleEndian(bytes, std::uint16_t{0});
  appendPadded(bytes, user, 16);
  appendLittleEndian(bytes, record);
  appendLittleEndian(bytes, static_cast<std::uint16_t>(content.size()));
  appendPadded(bytes, description, 32);
  bytes += content;
}

std::string attributeRows(const std::vector<LasAttribute>& attributes) {
  std::string rows;
  for (const LasAttribute& attribute : attributes) {
    appendPadded(rows, "", 2);
    appendLittleEndian(rows, static_cast<std::uint8_t>(attribute.type));
    appendPadded(rows, "", 1);
    appendPadded(rows, attribute.name, 32);
    appendPadded(rows, "", 124);  // no smallest, largest or missing value, no scale
    appendPadded(rows, attribute.description, 32);
  }
  return rows;
}

/// Returns the day of the year, from 1, and the year.
std::pair<std::uint16_t, std::uint16_t> dayAndYear(StampNs utc) {
  const auto daysThrough = [](std::int64_t year) { return 365 * year + year / 4 - year / 100 + year / 400; };
  const std::int64_t days = std::max<StampNs>(utc, 0) / 86'400'000'000'000 + daysThrough(1969);
  std::int64_t year = days * 400 / 146'097;
  while (daysThrough(year) <= days) ++year;
  while (daysThrough(year - 1) > days) --year;
  return {static_cast<std::uint16_t>(days - daysThrough(year - 1) + 1), static_cast<std::uint16_t>(year)};
}

}  // namespace

double gpsSeconds(StampNs utc) {
  const std::int64_t seconds = utc / 1'000'000'000;
  const auto leaps = std::upper_bound(kLeapSeconds.begin(), kLeapSeconds.end(), seconds) - kLeapSeconds.begin();
  return static_cast<double>(seconds - kGpsEpoch + leaps) + 1e-9 * static_cast<double>(utc % 1'000'000'000);
}

LasWriter::LasWriter(const std::string& path, std::vector<LasAttribute> attributes, std::string wkt)
    : path_(path),
      attributes_(std::move(attributes)),
      wkt_(std::move(wkt)),
      file_(path, lasHeaderBytes(attributes_, wkt_), recordBytes(attributes_)) {}

void LasWriter::append(const LasPoint& point, std::string_view attributes) {
  assert(kLasRecord + attributes.size() == recordBytes(attributes_));
  if (points() == 0) offset_ = (point.p / kLasOffsetStep).array().round() * kLasOffsetStep;
  record_.clear();
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double steps = std::round((point.p(axis) - offset_(axis)) / kLasScale);
    if (!(std::abs(steps) < std::numeric_limits<std::int32_t>::max()))
      throw DataError(path_, "a point is more than 200 km from the first one, or not finite", "");
    const auto stored = static_cast<std::int32_t>(steps);
    appendLittleEndian(record_, stored);
    low_[i] = points() == 0 ? stored : std::min(low_[i], stored);
    high_[i] = points() == 0 ? stored : std::max(high_[i], stored);
  }
  appendLittleEndian(record_, point.intensity);
  appendLittleEndian(record_, std::uint8_t{0x11});  // return 1 of 1
  appendLittleEndian(record_, static_cast<std::uint8_t>((point.channel & 3U) << 4U));
  appendLittleEndian(record_, point.classification);
  appendLittleEndian(record_, std::uint8_t{0});   // user data
  appendLittleEndian(record_, std::uint16_t{0});  // scan angle
  appendLittleEndian(record_, point.source);
  appendLittleEndian(record_, gpsSeconds(point.stamp) - kAdjustment);
  for (const std::uint16_t value : {point.red, point.green, point.blue}) appendLittleEndian(record_, value);
  record_ += attributes;
  last_ = std::max(last_, point.stamp);
  file_.append(record_);
}

std::string LasWriter::header() const {
  const auto [day, year] = dayAndYear(last_);
  std::string bytes = "LASF";
  appendLittleEndian(bytes, std::uint16_t{0});  // file source
  appendLittleEndian(bytes, static_cast<std::uint16_t>(kAdjustedGpsTime | kWkt));
  appendPadded(bytes, "", 16);  // project
  bytes += {1, 4};
  appendPadded(bytes, "urban_nav", 32);
  appendPadded(bytes, "urban_nav export", 32);
  for (const std::uint16_t value : {day, year, static_cast<std::uint16_t>(kLasHeader)})
    appendLittleEndian(bytes, value);
  appendLittleEndian(bytes, static_cast<std::uint32_t>(lasHeaderBytes(attributes_, wkt_)));
  appendLittleEndian(bytes, std::uint32_t{attributes_.empty() ? 1U : 2U});
  appendLittleEndian(bytes, std::uint8_t{7});
  appendLittleEndian(bytes, static_cast<std::uint16_t>(recordBytes(attributes_)));
  appendPadded(bytes, "", 24);  // legacy numbers of points
  for (int axis = 0; axis < 3; ++axis) appendLittleEndian(bytes, kLasScale);
  for (int axis = 0; axis < 3; ++axis) appendLittleEndian(bytes, offset_(axis));
  for (std::size_t i = 0; i < 3; ++i)
    for (const std::int32_t end : {high_[i], low_[i]})
      appendLittleEndian(bytes, offset_(static_cast<Eigen::Index>(i)) + kLasScale * end);
  appendPadded(bytes, "", 20);  // no waveforms, no extended records
  appendCount(bytes, points());
  appendCount(bytes, points());  // first returns
  appendPadded(bytes, "", 14 * 8);
  assert(bytes.size() == kLasHeader);
  appendVlr(bytes, "LASF_Projection", 2112, "coordinate system, WKT", wkt_ + std::string(1, '\0'));
  if (!attributes_.empty()) appendVlr(bytes, "LASF_Spec", 4, "extra bytes", attributeRows(attributes_));
  return bytes;
}

void LasWriter::commit() { file_.commit(header()); }

}  // namespace urban_nav_core
