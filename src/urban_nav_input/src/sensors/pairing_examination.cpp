// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/pairing_examination.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav_input {

using urban_nav_core::printNumber;
using urban_nav_core::StampNs;

namespace {

constexpr std::size_t kFewImages = 3;
constexpr StampNs kConstant = 2'000'000;  // ns
constexpr double kMostlyConstant = 0.8;   // share of images with the constant delay
constexpr double kPartnerReach = 0.45;    // of an interval; beyond it the nearest image may be of another time
constexpr double kFreeRunning = 0.7;      // of an interval: delays spread over more than that are those of any moments
constexpr double kNearZero = 0.35;        // of an interval; smaller delays need no correction of their mean
constexpr double kMargin = 1.25;          // factor on the largest observed delay
constexpr StampNs kMarginNs = 1'000'000;

StampNs nearest(const std::vector<StampNs>& stamps, StampNs to) {
  const auto after = std::lower_bound(stamps.begin(), stamps.end(), to);
  if (after == stamps.end()) return stamps.back();
  return after != stamps.begin() && to - *(after - 1) < *after - to ? *(after - 1) : *after;
}

StampNs middle(std::vector<StampNs> values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

StampNs usualInterval(const std::vector<StampNs>& stamps) {
  std::vector<StampNs> intervals;
  for (std::size_t i = 1; i < stamps.size(); ++i)
    if (stamps[i] > stamps[i - 1]) intervals.push_back(stamps[i] - stamps[i - 1]);
  return intervals.empty() ? 0 : middle(std::move(intervals));
}

/// Returns the delays of mutually nearest right and left images.
std::vector<StampNs> mutualDelays(const std::vector<StampNs>& left, const std::vector<StampNs>& right) {
  std::vector<StampNs> delays;
  for (const StampNs stamp : left)
    if (const StampNs partner = nearest(right, stamp); nearest(left, partner) == stamp)
      delays.push_back(partner - stamp);
  return delays;
}

/// Returns ms rounded to 0.01.
double toMs(StampNs ns) { return std::round(1e-4 * static_cast<double>(ns)) / 100.0; }

/// Returns a tolerance for delays of this size, rounded up to whole ms, below the partner reach.
StampNs wideEnough(StampNs largest, double reach) {
  const double wanted = kMargin * static_cast<double>(largest) + static_cast<double>(kMarginNs);
  const double ms = std::min(std::ceil(1e-6 * wanted), std::max(1.0, std::floor(1e-6 * reach)));
  return 1'000'000 * static_cast<StampNs>(ms);
}

std::vector<std::string> toOptions(const PairingConvention& repair, const PairingConvention& present) {
  std::vector<std::string> options;
  if (repair.right_delay != present.right_delay) {
    options.emplace_back("--set");
    options.push_back("input.right_delay=" + printNumber(toMs(repair.right_delay)));
  }
  if (repair.tolerance != present.tolerance) {
    options.emplace_back("--set");
    options.push_back("input.pairing_tolerance=" + printNumber(toMs(repair.tolerance)));
  }
  return options;
}

std::string describe(const PairingVerdict& verdict) {
  if (verdict.is_constant)
    return "the right images are stamped " + printNumber(std::abs(toMs(verdict.most))) + " ms " +
           (verdict.most > 0 ? "later" : "earlier") + " than the left ones";
  return "the right images are stamped between " + printNumber(toMs(verdict.least)) + " ms and " +
         printNumber(toMs(verdict.most)) + " ms later than the left ones, with a varying delay" +
         (verdict.repair ? "" : ": the two cameras are not synchronised, or one of them loses images");
}

}  // namespace

std::optional<PairingVerdict> examinePairing(const std::vector<StampNs>& left, const std::vector<StampNs>& right,
                                             const PairingConvention& present) {
  if (left.size() < kFewImages || right.size() < kFewImages) return std::nullopt;
  std::vector<StampNs> lefts = left, rights = right;
  for (StampNs& stamp : rights) stamp -= present.right_delay;
  std::sort(lefts.begin(), lefts.end());
  std::sort(rights.begin(), rights.end());
  const std::vector<StampNs> delays = mutualDelays(lefts, rights);  // in addition to the present convention
  const auto interval = static_cast<double>(std::max(usualInterval(lefts), usualInterval(rights)));
  if (delays.size() < kFewImages || interval == 0.0) return std::nullopt;
  const StampNs median = middle(delays);
  std::vector<StampNs> partners;  // at one time by their stamps
  for (const StampNs delay : delays)
    if (static_cast<double>(std::abs(delay - median)) <= kPartnerReach * interval) partners.push_back(delay);
  const auto lost = [&](StampNs delay) { return std::abs(delay) > present.tolerance; };
  if (std::none_of(partners.begin(), partners.end(), lost)) return std::nullopt;

  const auto [least, most] = std::minmax_element(partners.begin(), partners.end());
  const StampNs whole = median + present.right_delay;
  PairingVerdict verdict{false, *least + present.right_delay, *most + present.right_delay, {}};
  const auto equal = std::count_if(partners.begin(), partners.end(),
                                   [&](StampNs delay) { return std::abs(delay - median) <= kConstant; });
  const StampNs spread = std::max(*most - median, median - *least);
  const double reach = kPartnerReach * interval;
  if (lost(median) && static_cast<double>(equal) >= kMostlyConstant * static_cast<double>(delays.size())) {
    verdict.is_constant = true;
    verdict.least = verdict.most = whole;
    verdict.repair = PairingConvention{whole, present.tolerance};
    if (spread > present.tolerance) verdict.repair->tolerance = wideEnough(spread, reach);
    return verdict;
  }
  if (static_cast<double>(*most - *least) > kFreeRunning * interval) return verdict;
  const StampNs largest = std::max(std::abs(*most), std::abs(*least));
  if (static_cast<double>(largest) <= kNearZero * interval)
    verdict.repair = PairingConvention{present.right_delay, wideEnough(largest, reach)};
  else verdict.repair = PairingConvention{whole, std::max(present.tolerance, wideEnough(spread, reach))};
  return verdict;
}

std::vector<Finding> PairingExamination::findings(const std::array<std::string, 2>& topics,
                                                  const std::array<std::int64_t, 2>& missing,
                                                  const PairingConvention& present) const {
  std::vector<Finding> findings;
  if (missing[0] + missing[1] == 0) return findings;
  const std::string lost = "no partner within " + printNumber(toMs(present.tolerance)) + " ms";
  const std::optional<PairingVerdict> verdict = examinePairing(stamps_[0], stamps_[1], present);
  if (verdict) {
    Finding finding{FindingKind::Pairs,
                    std::to_string(missing[0]) + " left and " + std::to_string(missing[1]) + " right images have " +
                        lost + ": " + describe(*verdict) + " (" + topics[0] + ", " + topics[1] + ")",
                    "trigger both cameras by one signal, and stamp images when they are exposed"};
    if (verdict->repair) {
      finding.options = toOptions(*verdict->repair, present);
      std::string remedy = "if the two cameras are exposed together,";
      for (const std::string& option : finding.options) remedy += " " + option;
      finding.remedy = remedy + " corrects it; for later recordings, " + finding.remedy;
    }
    findings.push_back(std::move(finding));
    return findings;
  }
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
    if (missing[side] > 0)
      findings.push_back({FindingKind::Pairs,
                          topics[side] + ": " + std::to_string(missing[side]) + " images are missing: " + lost,
                          "check the cable and the rate of the camera that loses images"});
  return findings;
}

}  // namespace urban_nav_input
