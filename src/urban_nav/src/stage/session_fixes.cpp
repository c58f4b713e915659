// SPDX-License-Identifier: BSD-3-Clause
#include "stage/session_fixes.hpp"

#include "input/bag_fixes.hpp"
#include "pose_graph/stored_fixes.hpp"

namespace urban_nav {

void storeFixes(MapContext& context, std::size_t session) {
  const BagFixes fixes = readBagFixes(context.sessions[session].input.paths, context.options.source.topics);
  std::vector<urban_nav_core::PositionFix> placed;
  for (const urban_nav_core::GpsReading& reading : fixes.readings) placed.push_back({reading, fixes.p_base});
  pose_graph::writeFixes(*context.store, context.sessions[session].id, placed);
}

}  // namespace urban_nav
