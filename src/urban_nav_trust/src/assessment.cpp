// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/assessment.hpp"

#include <algorithm>

#include "urban_nav_trust/position_probability.hpp"

namespace urban_nav_trust {

namespace {

constexpr double kNegligible = 1e-6;  // probability of a factor

/// Returns the distance travelled at a stamp, m. Requires frames.
double travelledAt(const std::vector<FrameEvidence>& frames, urban_nav_core::StampNs stamp) {
  const auto after = std::lower_bound(frames.begin(), frames.end(), stamp,
                                      [](const FrameEvidence& frame, auto wanted) { return frame.stamp < wanted; });
  return after == frames.end() ? frames.back().travelled : after->travelled;
}

TrustState classify(const FrameEvidence& frame, bool has_failures, bool is_confirmed) {
  if (frame.is_lost) return TrustState::Lost;
  if (has_failures || !is_confirmed) return TrustState::Unsure;
  return frame.is_joined ? TrustState::Known : TrustState::New;
}

std::size_t count(const std::vector<FrameTrust>& frames, TrustState state) {
  return static_cast<std::size_t>(
      std::count_if(frames.begin(), frames.end(), [state](const FrameTrust& frame) { return frame.state == state; }));
}

}  // namespace

const char* toString(TrustState state) {
  switch (state) {
    case TrustState::Known: return "KNOWN";
    case TrustState::New: return "NEW";
    case TrustState::Unsure: return "UNSURE";
    case TrustState::Lost: return "LOST";
  }
  return "";
}

bool hasFailed(const ConsistencyTest& test, const Parameters& parameters) {
  return !(test.p_value >= parameters.false_alarm);
}

FrameTrust assessFrame(const FrameEvidence& frame, const std::vector<Failure>& failures,
                       const Confirmation& confirmation, const Parameters& parameters) {
  FrameTrust trust;
  trust.stamp = frame.stamp;
  const bool fails = std::any_of(failures.begin(), failures.end(),
                                 [](const Failure& each) { return each.is_present && each.affects_position; });
  trust.state = classify(frame, fails, confirmation.isComplete());
  double widening = 0.0;
  for (const Failure& failure : failures) {
    if (failure.is_present) trust.tests += (trust.tests.empty() ? "" : " ") + failure.test;
    if (!failure.affects_position) continue;
    const double drift = 0.01 * parameters.unexplained_drift * failure.distance;
    widening += drift * drift;
  }
  for (std::size_t i = 0; i < kScaleCount; ++i) {
    const double weight = confirmation.scales[i], scale = covarianceScales()[i];
    if (!(weight > kNegligible)) continue;
    const Eigen::Matrix3d covariance = scale * scale * frame.covariance + widening * Eigen::Matrix3d::Identity();
    for (std::size_t k = 0; k < kRadii.size(); ++k)
      trust.probabilities[k] += weight * probabilityWithin(kRadii[k], covariance);
  }
  for (std::size_t k = 0; k < kRadii.size(); ++k) {
    trust.probabilities[k] = std::min(1.0, trust.probabilities[k]);
    if (k > 0) trust.probabilities[k] = std::max(trust.probabilities[k], trust.probabilities[k - 1]);  // rounding
  }
  return trust;
}

std::vector<FrameTrust> assessFrames(const std::vector<FrameEvidence>& frames, const TestResults& results, bool spreads,
                                     const Parameters& parameters) {
  if (frames.empty()) return {};
  std::vector<const ConsistencyTest*> failed;
  for (const ConsistencyTest& test : results.tests)
    if (hasFailed(test, parameters) && test.interval.from <= frames.back().stamp &&
        test.interval.to >= frames.front().stamp)
      failed.push_back(&test);
  const Confirmation confirmation = confirm(results);
  std::vector<FrameTrust> trusts;
  for (const FrameEvidence& frame : frames) {
    std::vector<Failure> failures;
    for (const ConsistencyTest* test : failed) {
      if (!spreads && frame.stamp < test->interval.from) continue;
      const urban_nav_core::StampNs end = spreads ? test->interval.to : std::min(frame.stamp, test->interval.to);
      const bool is_inside = frame.stamp >= test->interval.from && frame.stamp <= test->interval.to;
      failures.push_back({test->name, travelledAt(frames, end) - travelledAt(frames, test->interval.from),
                          !test->is_corrected || is_inside, test->affects_position});
    }
    trusts.push_back(assessFrame(frame, failures, confirmation, parameters));
  }
  return trusts;
}

MapTrust assessMap(const std::vector<FrameTrust>& frames, const TestResults& results, const Parameters& parameters) {
  MapTrust map;
  for (const FrameTrust& frame : frames)
    for (std::size_t k = 0; k < kRadii.size(); ++k)
      map.probabilities[k] += frame.probabilities[k] / static_cast<double>(frames.size());
  std::string failed;
  for (const ConsistencyTest& test : results.tests)
    if (hasFailed(test, parameters) && !test.is_corrected) failed += (failed.empty() ? "" : "; ") + test.sentence;
  if (frames.empty()) {
    map.reason = "there is no pose";
  } else if (2 * count(frames, TrustState::Lost) > frames.size()) {
    map.state = TrustState::Lost;
    map.reason = "odometry is lost in more than half of the frames";
  } else if (!failed.empty()) {
    map.reason = failed;
  } else if (const std::size_t lost = count(frames, TrustState::Lost); 10 * lost > frames.size()) {
    map.reason = "odometry is lost in " + std::to_string(100 * lost / frames.size()) + " % of the frames";
  } else if (const std::string missing = missingSentence(confirm(results), results); !missing.empty()) {
    map.reason = missing;
  } else if (2 * count(frames, TrustState::Unsure) > frames.size()) {
    map.reason = "turns or lengths were measured by one sensor only in sessions with more than half of the frames";
  } else if (count(frames, TrustState::Known) == 0) {
    map.state = TrustState::New;
    map.reason = "no session is joined to the first one";
  } else {
    map.state = TrustState::Known;
  }
  return map;
}

}  // namespace urban_nav_trust
