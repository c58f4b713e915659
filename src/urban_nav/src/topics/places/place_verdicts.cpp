// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/place_verdicts.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "fabmap_node/decision/belief_history.hpp"

namespace urban_nav {

using fabmap_node::PlaceBelief;
using fabmap_node::PlaceVerdict;
using fabmap_node::VerifiedClosure;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;

namespace {

/// Returns the verdict on a closure; nullopt without a verdict. `assessment`: null before the pose graph.
std::optional<PlaceVerdict> verdictOn(const MetricClosure& closure, const ClosureAssessment* assessment) {
  if (!isMeasured(closure)) return std::nullopt;
  const auto measured = fabmap_node::placeVerdict(closure);
  const bool is_in_graph = assessment != nullptr && assessment->id != 0;
  if (measured != PlaceVerdict::Accepted || !is_in_graph) return measured;
  if (assessment->verdict == ClosureVerdict::Accepted) return PlaceVerdict::Confirmed;
  return assessment->verdict == ClosureVerdict::Rejected ? PlaceVerdict::Withdrawn : PlaceVerdict::Accepted;
}

/// Returns the closures with a verdict by the number of the session of b, over all sessions.
std::vector<std::vector<VerifiedClosure>> verifiedClosures(const MapContext& context) {
  const auto number = [&context](const std::string& session) {
    return static_cast<std::size_t>(std::find(context.names.begin(), context.names.end(), session) -
                                    context.names.begin());
  };
  std::vector<std::vector<VerifiedClosure>> verified(context.names.size());
  std::vector<std::optional<fabmap_node::TravelledDistance>> travelled(context.names.size());
  const std::vector<const SessionOdometry*> runs = context.runs();
  const auto travelledTo = [&](std::size_t session, urban_nav_core::StampNs stamp) {
    if (!travelled[session]) travelled[session] = travelledDistance(*runs[session]);
    return travelled[session]->at(stamp);
  };
  for (std::size_t i = 0; i < context.closures.size(); ++i) {
    const MetricClosure& closure = context.closures[i];
    const auto verdict = verdictOn(closure, i < context.assessments.size() ? &context.assessments[i] : nullptr);
    const std::size_t a = number(closure.a.session), b = number(closure.b.session);
    if (!verdict || a >= runs.size() || b >= runs.size()) continue;
    verified[b].push_back(
        {closure.a, closure.b, travelledTo(a, closure.a.stamp), travelledTo(b, closure.b.stamp), *verdict});
  }
  return verified;
}

}  // namespace

PlacesRun withVerdicts(PlacesRun run, const fabmap_node::Parameters& parameters, const MapContext& context) {
  const std::vector<std::vector<VerifiedClosure>> verified = verifiedClosures(context);
  for (std::size_t s = 0; s < run.beliefs.size(); ++s) {
    if (verified[s].empty()) continue;
    fabmap_node::BeliefHistory history(parameters);
    for (const PlaceBelief& belief : run.beliefs[s]) history.add(belief);
    for (const VerifiedClosure& closure : verified[s]) history.addVerdict(closure);
    for (PlaceBelief& belief : run.beliefs[s]) belief = history.withVerdicts(std::move(belief));
  }
  return run;
}

}  // namespace urban_nav
