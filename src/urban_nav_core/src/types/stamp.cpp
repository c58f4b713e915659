// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/types/stamp.hpp"

#include <limits>

namespace urban_nav_core {
namespace {

constexpr int kDecimals = 9;
constexpr std::uint64_t kNanosecondsPerSecond = 1000000000U;

bool isDigit(char c) { return c >= '0' && c <= '9'; }

bool appendDigit(std::uint64_t& value, unsigned digit) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
  if (value > (kMax - digit) / 10U) return false;
  value = value * 10U + digit;
  return true;
}

}  // namespace

double secondsBetween(StampNs earlier, StampNs later) {
  const bool forward = later >= earlier;
  const std::uint64_t size = forward ? static_cast<std::uint64_t>(later) - static_cast<std::uint64_t>(earlier)
                                     : static_cast<std::uint64_t>(earlier) - static_cast<std::uint64_t>(later);
  const double seconds = static_cast<double>(size) / 1e9;
  return forward ? seconds : -seconds;
}

std::string printStamp(StampNs stamp) {
  // The most negative stamp has no positive counterpart in its type.
  const std::uint64_t size = stamp < 0 ? 0U - static_cast<std::uint64_t>(stamp) : static_cast<std::uint64_t>(stamp);
  std::string decimals = std::to_string(size % kNanosecondsPerSecond);
  decimals.insert(0, kDecimals - decimals.size(), '0');
  return (stamp < 0 ? "-" : "") + std::to_string(size / kNanosecondsPerSecond) + "." + decimals;
}

std::optional<StampNs> parseStamp(std::string_view seconds) {
  std::size_t at = 0;
  const bool negative = !seconds.empty() && seconds[0] == '-';
  if (!seconds.empty() && (seconds[0] == '-' || seconds[0] == '+')) ++at;

  std::uint64_t nanoseconds = 0;
  bool any = false;
  for (; at < seconds.size() && isDigit(seconds[at]); ++at, any = true) {
    if (!appendDigit(nanoseconds, static_cast<unsigned>(seconds[at] - '0'))) return std::nullopt;
  }
  int decimals = 0;
  bool round_up = false;
  if (at < seconds.size() && seconds[at] == '.') {
    for (++at; at < seconds.size() && isDigit(seconds[at]); ++at, ++decimals, any = true) {
      const auto digit = static_cast<unsigned>(seconds[at] - '0');
      if (decimals == kDecimals) round_up = digit >= 5U;
      if (decimals < kDecimals && !appendDigit(nanoseconds, digit)) return std::nullopt;
    }
  }
  if (!any || at != seconds.size()) return std::nullopt;
  for (; decimals < kDecimals; ++decimals) {
    if (!appendDigit(nanoseconds, 0U)) return std::nullopt;
  }
  const auto limit = static_cast<std::uint64_t>(std::numeric_limits<StampNs>::max());
  if (nanoseconds > limit - (round_up ? 1U : 0U)) return std::nullopt;
  const auto size = static_cast<StampNs>(nanoseconds + (round_up ? 1U : 0U));
  return negative ? -size : size;
}

}  // namespace urban_nav_core
