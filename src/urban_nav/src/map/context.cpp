// SPDX-License-Identifier: BSD-3-Clause
#include "map/context.hpp"

namespace urban_nav {

std::vector<const SessionOdometry*> MapContext::runs() const {
  std::vector<const SessionOdometry*> all;
  for (const SessionOdometry& run : previous.runs) all.push_back(&run);
  for (const MapSession& session : sessions) all.push_back(session.odometry.get());
  return all;
}

std::vector<urban_nav_store::SessionId> MapContext::ids() const {
  std::vector<urban_nav_store::SessionId> all = previous.ids;
  for (const MapSession& session : sessions) all.push_back(session.id);
  return all;
}

}  // namespace urban_nav
