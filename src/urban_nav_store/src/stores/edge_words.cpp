// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/graph_store.hpp"

namespace urban_nav_store {

const char* toString(EdgeKind kind) {
  switch (kind) {
    case EdgeKind::Odometry: return "odometry";
    case EdgeKind::Stereo: return "stereo";
    case EdgeKind::Icp: return "icp";
    case EdgeKind::Plane: return "plane";
    case EdgeKind::Session: return "session";
    case EdgeKind::Asserted: break;
  }
  return "asserted";
}

std::optional<EdgeKind> parseEdgeKind(std::string_view word) {
  for (const EdgeKind kind :
       {EdgeKind::Odometry, EdgeKind::Stereo, EdgeKind::Icp, EdgeKind::Plane, EdgeKind::Session, EdgeKind::Asserted})
    if (word == toString(kind)) return kind;
  return std::nullopt;
}

}  // namespace urban_nav_store
