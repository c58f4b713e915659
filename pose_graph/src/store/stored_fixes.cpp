// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/stored_fixes.hpp"

#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_fix.hpp"

namespace pose_graph {

using urban_nav_store::StoredFix;

std::vector<PositionFix> readFixes(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  std::vector<PositionFix> fixes;
  urban_nav_store::TableStore<StoredFix>(store).forEach(session, [&](const StoredFix& row) {
    PositionFix fix;
    fix.reading = {row.stamp, row.latitude, row.longitude, row.height, {row.sigma_east, row.sigma_north, row.sigma_up}};
    fix.p_base = {row.x, row.y, row.z};
    fixes.push_back(fix);
  });
  return fixes;
}

void writeFixes(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                const std::vector<PositionFix>& fixes) {
  urban_nav_store::TableStore<StoredFix> rows(store);
  for (const PositionFix& fix : fixes) {
    const urban_nav_core::GpsReading& reading = fix.reading;
    rows.put({session, reading.stamp, reading.latitude, reading.longitude, reading.height, reading.sigma.x(),
              reading.sigma.y(), reading.sigma.z(), fix.p_base.x(), fix.p_base.y(), fix.p_base.z()});
  }
}

}  // namespace pose_graph
