// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/stored_fixes.hpp"

#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_fix.hpp"

namespace urban_nav_store {

std::vector<urban_nav_core::PositionFix> readFixes(Store& store, const SessionId& session) {
  std::vector<urban_nav_core::PositionFix> fixes;
  TableStore<StoredFix>(store).forEach(session, [&](const StoredFix& row) {
    urban_nav_core::PositionFix fix;
    fix.reading = {row.stamp, row.latitude, row.longitude, row.height, {row.sigma_east, row.sigma_north, row.sigma_up}};
    fix.p_base = {row.x, row.y, row.z};
    fixes.push_back(fix);
  });
  return fixes;
}

void writeFixes(Store& store, const SessionId& session, const std::vector<urban_nav_core::PositionFix>& fixes) {
  TableStore<StoredFix> rows(store);
  for (const urban_nav_core::PositionFix& fix : fixes) {
    const urban_nav_core::GpsReading& reading = fix.reading;
    rows.put({session, reading.stamp, reading.latitude, reading.longitude, reading.height, reading.sigma.x(),
              reading.sigma.y(), reading.sigma.z(), fix.p_base.x(), fix.p_base.y(), fix.p_base.z()});
  }
}

}  // namespace urban_nav_store
