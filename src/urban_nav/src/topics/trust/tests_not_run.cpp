// SPDX-License-Identifier: BSD-3-Clause
#include "topics/trust/tests_not_run.hpp"

#include <algorithm>
#include <string>

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

std::string reasonWithoutColourTest(const MapContext& context) {
  if (!hasInput(context, "panorama")) return "no panoramas";
  return "no test compares the colours of panoramas with those of the map";
}

}  // namespace

std::vector<urban_nav_trust::AbsentMeasurement> testsNotRun(const MapContext& context) {
  using namespace urban_nav_trust;
  return {{kColourTest, reasonWithoutColourTest(context)}};
}

}  // namespace urban_nav
