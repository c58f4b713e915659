// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/fault_rates.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_live {

namespace {

/// Prints "26 %"; one more digit below 10 %.
std::string printShare(double share) {
  const double percent = 100.0 * share;
  if (percent >= 9.95) return std::to_string(std::lround(percent)) + " %";
  const long tenths = std::max(1L, std::lround(10.0 * percent));
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " %";
}

}  // namespace

void FaultRates::add(const std::vector<StageReport::FaultCount>& counts) {
  const Clock::time_point now = now_();
  for (const StageReport::FaultCount& count : counts) {
    Kind& kind = kinds_[count.what];
    kind.advice = count.advice;
    auto& samples = kind.samples;
    if (!samples.empty() && (count.faults < samples.back().faults || count.total < samples.back().total))
      samples.clear();
    if (samples.empty()) samples.push_back({now - kWindow, 0, 0});  // counters start at zero
    samples.push_back({now, count.faults, count.total});
    while (samples.size() > 2 && samples[1].when <= now - kWindow) samples.pop_front();
  }
}

std::pair<ReportLevel, std::string> FaultRates::summary() const {
  ReportLevel level = ReportLevel::Ok;
  std::string text;
  for (const auto& [what, kind] : kinds_) {
    const Sample &first = kind.samples.front(), &last = kind.samples.back();
    const std::int64_t faults = last.faults - first.faults, total = last.total - first.total;
    if (faults <= 0) continue;
    const double share = static_cast<double>(faults) / static_cast<double>(std::max(total, faults));
    if (share <= kWarning) continue;
    level = std::max(level, share > kError ? ReportLevel::Error : ReportLevel::Warning);
    text += (text.empty() ? "" : "; ") + printShare(share) + " of the " + what + " in the last 10 s: " + kind.advice;
  }
  return {level, text};
}

}  // namespace urban_nav_live
