// SPDX-License-Identifier: BSD-3-Clause
#include "topics/trust/tests_not_run.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "pose_graph/parameters.hpp"
#include "urban_nav_trust/unavailable_tests.hpp"

namespace urban_nav {

namespace {

/// Returns whether a session of this run has an input whose role begins with `role`.
bool hasInput(const MapContext& context, const std::string& role) {
  return std::any_of(context.sessions.begin(), context.sessions.end(), [&](const MapSession& session) {
    return std::any_of(session.info.inputs.begin(), session.info.inputs.end(),
                       [&](const auto& input) { return input.role.rfind(role, 0) == 0; });
  });
}

/// Returns the number of constraints from planes by verdict: accepted, and all.
std::pair<std::size_t, std::size_t> countPlanes(const MapContext& context) {
  std::size_t accepted = 0, all = 0;
  for (const urban_nav_store::SessionId& id : context.ids())
    context.store->graph().forEachEdge(id, [&](const urban_nav_store::Edge& edge) {
      if (edge.kind != urban_nav_store::EdgeKind::Plane) return;
      ++all;
      if (edge.verdict == urban_nav_core::ClosureVerdict::Accepted) ++accepted;
    });
  return {accepted, all};
}

std::string reasonWithoutColourTest(const MapContext& context) {
  if (!hasInput(context, "panorama")) return "no panoramas";
  return "no test compares the colours of panoramas with those of the map";
}

std::string reasonWithoutFixTest(const MapContext& context) {
  if (!hasInput(context, "gps")) return "no GPS fixes";
  if (context.relaxed && context.options.parameters.get(pose_graph::table()).gps)
    return "GPS fixes took part in the relaxation, so that they cannot test its result (pose_graph.gps)";
  return "no test compares GPS fixes with the path";
}

std::string reasonWithoutFreeSpaceTest(const MapContext& context) {
  if (!hasInput(context, "laser")) return "no lasers";
  return "beams that pass through surfaces remove moving objects from the map; no test counts them";
}

std::string reasonWithoutPassTest(const MapContext& context) {
  if (!hasInput(context, "laser")) return "no lasers";
  const auto [accepted, all] = countPlanes(context);
  if (all == 0) return "no plane was measured by two passes of the lasers, or none was searched";
  return std::to_string(accepted) + " of " + std::to_string(all) +
         " constraints from planes of several passes took part in the relaxation, so that they cannot test its result";
}

std::string reasonWithoutReprojectionTest(const MapContext& context) {
  if (!hasInput(context, "left")) return "no images";
  return "no test follows the reprojection error; disparity_offset detects a camera that moves";
}

}  // namespace

std::vector<urban_nav_trust::AbsentMeasurement> testsNotRun(const MapContext& context) {
  using namespace urban_nav_trust;
  return {{kColourTest, reasonWithoutColourTest(context)},
          {kFixTest, reasonWithoutFixTest(context)},
          {kFreeSpaceTest, reasonWithoutFreeSpaceTest(context)},
          {kPassTest, reasonWithoutPassTest(context)},
          {kReprojectionTest, reasonWithoutReprojectionTest(context)}};
}

}  // namespace urban_nav
