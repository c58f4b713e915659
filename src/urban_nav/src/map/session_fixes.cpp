// SPDX-License-Identifier: BSD-3-Clause
#include "map/session_fixes.hpp"

#include "urban_nav_input/session/bag_fixes.hpp"
#include "urban_nav_store/stored_fixes.hpp"

namespace urban_nav {

void storeFixes(MapContext& context, std::size_t session) {
  const urban_nav_input::BagFixes fixes =
      urban_nav_input::readBagFixes(context.sessions[session].input.paths, context.options.source.topics,
                                    context.options.source.transforms, context.options.source.sensors.gps_delay);
  std::vector<urban_nav_core::PositionFix> placed;
  for (const urban_nav_core::GpsReading& reading : fixes.readings) placed.push_back({reading, fixes.p_base});
  urban_nav_store::writeFixes(*context.store, context.sessions[session].id, placed);
}

}  // namespace urban_nav
