// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "urban_nav_core/io/archive.hpp"

namespace urban_nav_core {

/// Field of a cloud with the times of its points, and the meaning of its values.
struct PointTimes {
  enum class Unit : std::uint8_t { Seconds, Milliseconds, Microseconds, Nanoseconds };
  enum class Reference : std::uint8_t {
    Header,   ///< the time is the stamp of the header plus the value
    Absolute  ///< the time is the value
  };

  std::string field;  ///< empty: the points have no times
  Unit unit = Unit::Seconds;
  Reference reference = Reference::Header;

  bool areKnown() const { return !field.empty(); }
  void archive(Archive& archive) { archive(field, unit, reference); }
};

/// Return "s", "ms", "us" or "ns"; "header" or "absolute".
const char* toString(PointTimes::Unit unit);
const char* toString(PointTimes::Reference reference);
/// Returns the length of a unit in nanoseconds.
double nanoseconds(PointTimes::Unit unit);

/// Returns "FIELD,UNIT,REFERENCE", the format of `input.points_time`; "none" without times.
std::string printPointTimes(const PointTimes& times);
/// Parses this format; nullopt for any other text.
std::optional<PointTimes> parsePointTimes(std::string_view text);

}  // namespace urban_nav_core
