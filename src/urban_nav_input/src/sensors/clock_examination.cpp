// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/clock_examination.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"

namespace urban_nav_input {

using urban_nav_core::formatNumber;
using urban_nav_core::StampNs;

namespace {

constexpr std::size_t kFewMessages = 10, kMostMessages = 20'000;
constexpr double kApart = 0.5;      // s: drivers and networks of a robot do not cause larger differences in delay
constexpr double kApartGps = 2.0;   // s: receivers stamp the time of measurement, and compute the fix later
constexpr double kSpread = 0.1;     // s, median deviation of delays if times of receipt follow the stamps
constexpr double kDrift = 0.1;      // s over the recording
constexpr double kShortest = 20.0;  // s, of a recording for a drift

struct Delay {
  double median = 0.0, drift = 0.0, seconds = 0.0;  // s; drift: over all of the recording
};

double windowMedian(const std::vector<std::pair<StampNs, double>>& delays, std::size_t from, std::size_t to) {
  std::vector<double> values;
  for (std::size_t i = from; i < to; ++i) values.push_back(delays[i].second);
  return urban_nav_core::quantile(values, 0.5);
}

/// Returns nullopt for a topic whose times of receipt do not follow the stamps.
std::optional<Delay> summarise(const std::vector<std::pair<StampNs, double>>& delays) {
  if (delays.size() < kFewMessages) return std::nullopt;
  Delay delay;
  const std::size_t n = delays.size(), tenth = std::max<std::size_t>(5, n / 10);
  delay.median = windowMedian(delays, 0, n);
  const double begin = windowMedian(delays, 0, tenth), end = windowMedian(delays, n - tenth, n);
  delay.drift = end - begin;
  delay.seconds = 1e-9 * static_cast<double>(delays.back().first - delays.front().first);
  std::vector<double> deviations;
  for (std::size_t i = 0; i < n; ++i) {
    const double line = begin + delay.drift * static_cast<double>(i) / static_cast<double>(n);
    deviations.push_back(std::abs(delays[i].second - line));
  }
  if (urban_nav_core::quantile(deviations, 0.5) > kSpread) return std::nullopt;
  return delay;
}

FindingKind chooseKind(const std::string& role) {
  return role.compare(0, 6, "points") == 0 ? FindingKind::ClockApart : FindingKind::Stamps;
}

}  // namespace

void ClockExamination::add(const std::string& role, const std::string& topic, StampNs stamp, StampNs receipt) {
  std::size_t i = 0;
  while (i < names_.size() && names_[i].first != role) ++i;
  if (i == names_.size()) {
    names_.emplace_back(role, topic);
    delays_.emplace_back();
  }
  if (stamp <= 0) return;
  if (delays_[i].size() == kMostMessages) {
    for (std::size_t k = 0; k < kMostMessages / 2; ++k) delays_[i][k] = delays_[i][2 * k];
    delays_[i].resize(kMostMessages / 2);
  }
  delays_[i].emplace_back(stamp, 1e-9 * static_cast<double>(receipt - stamp));
}

std::vector<Finding> ClockExamination::findings(
    const std::function<std::optional<double>(const std::string& role)>& present) const {
  std::vector<Finding> findings;
  const auto images =
      std::find_if(names_.begin(), names_.end(), [](const auto& name) { return name.first == "images"; });
  if (images == names_.end()) return findings;
  const std::optional<Delay> camera = summarise(delays_[static_cast<std::size_t>(images - names_.begin())]);
  if (!camera) return findings;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const auto& [role, topic] = names_[i];
    const std::optional<Delay> delay = role == "images" ? std::nullopt : summarise(delays_[i]);
    if (!delay) continue;
    const double apart = camera->median - delay->median, drift = camera->drift - delay->drift;
    if (std::abs(apart) > (role == "gps" ? kApartGps : kApart)) {
      Finding finding{chooseKind(role),
                      topic + ": its stamps are " + formatNumber(std::abs(apart), 4) + " s " +
                          (apart < 0.0 ? "earlier" : "later") + " than those of the images, by receipt minus stamp (" +
                          formatNumber(delay->median, 4) + " s, images " + formatNumber(camera->median, 4) +
                          " s): the clock of its computer or device is wrong",
                      "synchronise the clocks (chrony, PTP) while recording"};
      if (const std::optional<double> delay_ms = present(role)) {
        finding.options = {"--set", "input." + role + "_delay=" +
                                        urban_nav_core::printNumber(*delay_ms + std::round(1e4 * apart) / 10.0)};
        finding.remedy = finding.options[0] + " " + finding.options[1] + "; for later recordings, " + finding.remedy;
      }
      findings.push_back(finding);
    } else if (std::abs(drift) > kDrift && delay->seconds > kShortest) {
      findings.push_back({chooseKind(role),
                          topic + ": its clock drifts by " + formatNumber(1e6 * drift / delay->seconds, 3) +
                              " ppm against that of the images, " + formatNumber(std::abs(drift), 3) +
                              " s over the recording",
                          "synchronise the clocks (chrony, PTP) while recording"});
    }
  }
  return findings;
}

}  // namespace urban_nav_input
