// SPDX-License-Identifier: BSD-3-Clause
#include "map/lost_closures.hpp"

#include <algorithm>

namespace urban_nav {

using urban_nav_core::PoseRef;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;

namespace {

ClosurePoses::value_type closurePoses(const Edge& edge) {
  PoseRef a{edge.a.session, edge.a.stamp}, b{edge.b.session, edge.b.stamp};
  if (b < a) std::swap(a, b);
  return {a, b};
}

}  // namespace

void addAcceptedClosures(urban_nav_store::Store& store, ClosurePoses& closures) {
  for (const urban_nav_store::Session& session : store.sessions().all())
    store.graph().forEachEdge(session.id, [&](const Edge& edge) {
      const bool is_measured = edge.kind == EdgeKind::Stereo || edge.kind == EdgeKind::Icp;
      if (is_measured && edge.verdict == urban_nav_core::ClosureVerdict::Accepted) closures.insert(closurePoses(edge));
    });
}

std::string lostClosuresWarning(urban_nav_store::Store& store, const ClosurePoses& before) {
  ClosurePoses now;
  for (const urban_nav_store::Session& session : store.sessions().all())
    store.graph().forEachEdge(session.id, [&](const Edge& edge) { now.insert(closurePoses(edge)); });
  const auto lost = std::count_if(before.begin(), before.end(),
                                  [&](const ClosurePoses::value_type& closure) { return now.count(closure) == 0; });
  if (lost == 0) return {};
  return std::to_string(lost) + " of " + std::to_string(before.size()) +
         " accepted closures of the stores are not in the joined map: places does not propose them when all sessions "
         "are compared in the order of time (they were given by --closures, or found in another order)";
}

}  // namespace urban_nav
