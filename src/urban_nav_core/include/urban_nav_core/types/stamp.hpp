// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace urban_nav_core {

/// Time in nanoseconds since the Unix epoch (or since any origin that one data set shares). Never a double:
/// a double holds today's epoch to 0.2 us only, and two stamps that differ must compare as different.
using StampNs = std::int64_t;

/// later - earlier in seconds; exact to the double's precision of the difference, not of the epoch.
double secondsBetween(StampNs earlier, StampNs later);

/// "1225719873.501685000": seconds with nine decimals, negative times included.
std::string printStamp(StampNs stamp);

/// Parses decimal seconds ("61.59", "1225719873.501685", "-3.4", "1e-1" is refused) without passing through a double.
/// Digits after the ninth decimal are rounded half up. Empty if the text is no such number or does not fit.
std::optional<StampNs> parseStamp(std::string_view seconds);

}  // namespace urban_nav_core
