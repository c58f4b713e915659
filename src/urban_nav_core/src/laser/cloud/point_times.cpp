// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/cloud/point_times.hpp"

#include <array>

namespace urban_nav_core {

namespace {

constexpr std::array<PointTimes::Unit, 4> kTimeUnits = {{PointTimes::Unit::Seconds, PointTimes::Unit::Milliseconds,
                                                         PointTimes::Unit::Microseconds,
                                                         PointTimes::Unit::Nanoseconds}};
constexpr std::array<PointTimes::Reference, 2> kTimeReferences = {
    {PointTimes::Reference::Header, PointTimes::Reference::Absolute}};

}  // namespace

const char* toString(PointTimes::Unit unit) {
  switch (unit) {
    case PointTimes::Unit::Seconds: return "s";
    case PointTimes::Unit::Milliseconds: return "ms";
    case PointTimes::Unit::Microseconds: return "us";
    case PointTimes::Unit::Nanoseconds: return "ns";
  }
  return "";
}

const char* toString(PointTimes::Reference reference) {
  return reference == PointTimes::Reference::Header ? "header" : "absolute";
}

double nanoseconds(PointTimes::Unit unit) {
  switch (unit) {
    case PointTimes::Unit::Seconds: return 1e9;
    case PointTimes::Unit::Milliseconds: return 1e6;
    case PointTimes::Unit::Microseconds: return 1e3;
    case PointTimes::Unit::Nanoseconds: return 1.0;
  }
  return 1.0;
}

std::string printPointTimes(const PointTimes& times) {
  if (!times.areKnown()) return "none";
  return times.field + "," + toString(times.unit) + "," + toString(times.reference);
}

std::optional<PointTimes> parsePointTimes(std::string_view text) {
  if (text == "none") return PointTimes();
  const std::size_t last = text.rfind(',');
  const std::size_t middle = last == std::string_view::npos || last == 0 ? last : text.rfind(',', last - 1);
  if (last == std::string_view::npos || middle == std::string_view::npos || middle == 0 || middle == last)
    return std::nullopt;
  PointTimes times;
  times.field = std::string(text.substr(0, middle));
  const std::string_view unit = text.substr(middle + 1, last - middle - 1), reference = text.substr(last + 1);
  bool has_unit = false, has_reference = false;
  for (const PointTimes::Unit each : kTimeUnits)
    if (unit == toString(each)) times.unit = each, has_unit = true;
  for (const PointTimes::Reference each : kTimeReferences)
    if (reference == toString(each)) times.reference = each, has_reference = true;
  return has_unit && has_reference ? std::optional<PointTimes>(times) : std::nullopt;
}

}  // namespace urban_nav_core
