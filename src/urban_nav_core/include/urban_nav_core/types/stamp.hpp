// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace urban_nav_core {

/// Time in nanoseconds since the Unix epoch, or since another origin common to a data set. Never a double: at today's
/// epoch a double resolves only 0.2 us, and different stamps must compare as different.
using StampNs = std::int64_t;

/// Returns later - earlier in seconds, with the precision of a double for the difference.
double secondsBetween(StampNs earlier, StampNs later);

/// Returns "1225719873.501685000": seconds with nine decimals, also for negative times.
std::string printStamp(StampNs stamp);

/// Parses decimal seconds ("61.59", "1225719873.501685", "-3.4"; "1e-1" is rejected) without conversion to double.
/// Digits after the ninth decimal are rounded half up. Empty if the text is not such a number or overflows.
std::optional<StampNs> parseStamp(std::string_view seconds);

}  // namespace urban_nav_core
