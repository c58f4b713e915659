// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/reading_examination.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav_input {

namespace {

constexpr std::int64_t kFewReadings = 50;

}  // namespace

void ReadingExamination::add(urban_nav_core::StampNs stamp, const std::array<double, 6>& numbers) {
  if (stamp <= 0) ++no_stamp_;
  if (messages_++ == 0) first_ = stamp;
  if (!std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); })) {
    if (not_finite_++ == 0) first_not_finite_ = stamp;
    last_not_finite_ = stamp;
    return;
  }
  repeated_ += messages_ > 1 && numbers == last_ ? 1 : 0;
  last_ = numbers;
}

std::vector<Finding> ReadingExamination::findings(const std::string& topic, FindingKind kind,
                                                  bool is_frozen_odd) const {
  using urban_nav_core::formatNumber;
  using urban_nav_core::secondsBetween;
  std::vector<Finding> findings;
  const auto percent = [&](std::int64_t count) {
    return formatNumber(100.0 * static_cast<double>(count) / static_cast<double>(messages_), 3) + " % of " +
           std::to_string(messages_) + " messages";
  };
  if (no_stamp_ > 0)
    findings.push_back({FindingKind::Stamps, topic + ": " + percent(no_stamp_) + " have no stamp and are not used",
                        "let the driver of this device stamp its messages"});
  if (not_finite_ > 0)
    findings.push_back({kind,
                        topic + ": " + percent(not_finite_) + " have numbers that are not finite (NaN), from " +
                            formatNumber(secondsBetween(first_, first_not_finite_), 3) + " s to " +
                            formatNumber(secondsBetween(first_, last_not_finite_), 3) +
                            " s after the first; they are not used",
                        "check the driver of this device, and its cable"});
  if (is_frozen_odd && messages_ >= kFewReadings && 2 * repeated_ > messages_)
    findings.push_back({kind, topic + ": " + percent(repeated_) + " repeat the previous reading exactly: frozen",
                        "restart the driver of this device, and publish each reading once"});
  return findings;
}

}  // namespace urban_nav_input
