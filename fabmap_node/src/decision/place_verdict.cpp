// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/decision/place_verdict.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace fabmap_node {

using urban_nav_core::ClosureVerdict;

namespace {

/// Closures of a kind, and how many of them had a verdict.
struct VerdictCount {
  double all = 0.0, of_verdict = 0.0;

  /// Rule of succession for two outcomes.
  double rate() const { return (of_verdict + 1.0) / (all + 2.0); }
};

// Candidates that loop_metric accepted: docs/results/loop_metric.md, quad 7, all directions. To those that show two
// places, the 26 closures proposed between unrelated sites in docs/results/fabmap_node.md are added.
constexpr VerdictCount kAcceptedOfSame = {855.0, 844.0}, kAcceptedOfOther = {197.0, 0.0};
// Closures that pose_graph rejected, true and false ones: docs/results/pose_graph.md, "False closures", drawn sets of
// all graphs.
constexpr VerdictCount kWithdrawnOfSame = {611400.0, 844.0}, kWithdrawnOfOther = {181190.0, 181152.0};

constexpr const char* kPoseGraph = "pose_graph";  // source of its verdicts
// Reasons of loop_metric that state missing data: loop_metric::LoopReason UnknownMoment and NothingKept.
constexpr std::array<const char*, 2> kMissingData = {"unknown_moment", "nothing_kept"};

}  // namespace

const char* toString(PlaceVerdict verdict) {
  constexpr std::array<const char*, 4> kNames = {"accepted", "rejected", "confirmed", "withdrawn"};
  return kNames[static_cast<std::size_t>(verdict)];
}

bool isOfPoseGraph(PlaceVerdict verdict) {
  return verdict == PlaceVerdict::Confirmed || verdict == PlaceVerdict::Withdrawn;
}

std::optional<PlaceVerdict> placeVerdict(const urban_nav_core::MetricClosure& closure) {
  const bool is_of_graph = closure.source == kPoseGraph;
  if (closure.verdict == ClosureVerdict::Accepted || closure.verdict == ClosureVerdict::Degenerate)
    return is_of_graph ? PlaceVerdict::Confirmed : PlaceVerdict::Accepted;
  if (closure.verdict != ClosureVerdict::Rejected) return std::nullopt;
  if (is_of_graph) return PlaceVerdict::Withdrawn;
  for (const char* missing : kMissingData)
    if (closure.reason_name == missing) return std::nullopt;
  return PlaceVerdict::Rejected;
}

double logRatio(PlaceVerdict verdict) {
  const double accepted_same = kAcceptedOfSame.rate(), accepted_other = kAcceptedOfOther.rate();
  const double withdrawn_same = kWithdrawnOfSame.rate(), withdrawn_other = kWithdrawnOfOther.rate();
  const double accepted = std::log(accepted_same / accepted_other);
  switch (verdict) {
    case PlaceVerdict::Accepted: return accepted;
    case PlaceVerdict::Rejected: return std::log((1.0 - accepted_same) / (1.0 - accepted_other));
    case PlaceVerdict::Confirmed: return accepted + std::log((1.0 - withdrawn_same) / (1.0 - withdrawn_other));
    case PlaceVerdict::Withdrawn: return accepted + std::log(withdrawn_same / withdrawn_other);
  }
  return 0.0;
}

}  // namespace fabmap_node
