// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ground_views.hpp"

#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/ground_view.hpp"

namespace pose_graph {

using urban_nav_store::GroundView;
using urban_nav_store::Store;

namespace {

constexpr const char* kFound = "found";

}  // namespace

std::vector<GroundNormal> readGround(Store& store, const SessionId& session) {
  std::vector<GroundNormal> normals;
  const urban_nav_store::TableStore<GroundView> views(store);
  views.forEach(session, [&](const GroundView& view) {
    if (view.verdict == kFound) normals.push_back({view.stamp, view.up, view.sigma, view.height, view.support});
  });
  return normals;
}

void writeGround(Store& store, const SessionId& session, const std::vector<GroundNormal>& normals) {
  urban_nav_store::TableStore<GroundView> views(store);
  for (const GroundNormal& normal : normals)
    views.put({session, normal.stamp, kFound, normal.up, normal.height, normal.sigma, normal.support});
}

}  // namespace pose_graph
