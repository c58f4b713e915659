// SPDX-License-Identifier: BSD-3-Clause
#include "base/time_query.hpp"

#include <cmath>
#include <optional>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;
using urban_nav_core::UserError;

TimeQuery parseTimeQuery(const std::string& text, const std::string& what) {
  TimeQuery moment;
  const std::size_t plus = text.rfind('+');
  const std::string number = plus == std::string::npos ? text : text.substr(plus + 1);
  const std::optional<double> seconds = urban_nav_core::parseNumber(number);
  if (!seconds || std::abs(*seconds) > 9e9 || (plus == std::string::npos && *seconds < 0.0))
    throw UserError(what, "\"" + text + "\" is not a time",
                    "seconds since 1970 (1225719873.5), since the beginning of a session (+12.5, or NAME+12.5)");
  moment.seconds = *seconds;
  moment.since_begin = plus != std::string::npos;
  if (moment.since_begin) moment.session = text.substr(0, plus);
  // A double resolves seconds since 1970 to a quarter of a microsecond, sufficient to identify a closure.
  else moment.stamp = static_cast<StampNs>(std::llround(*seconds * 1e9));
  return moment;
}

}  // namespace urban_nav
