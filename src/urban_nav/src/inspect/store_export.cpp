// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/store_export.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "urban_nav_core/io/g2o.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_store/edit_journal.hpp"

namespace urban_nav {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::G2oGraph;
using urban_nav_core::Pose;
using urban_nav_core::StampedPose;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

namespace {

constexpr const char* kStereo = "stereo";

Pose makeCamera(Store& store, const urban_nav_store::Session& session) {
  for (const urban_nav_store::Extrinsic& extrinsic : store.sessions().extrinsics(session.id))
    if (extrinsic.frame == urban_nav_core::frames::kStereoLeft) return extrinsic.T_base_frame;
  throw UserError(
      store.path(),
      "has no pose of " + std::string(urban_nav_core::frames::kStereoLeft) + " on the robot in session " + session.id,
      "--tum, which needs no camera");
}

std::array<double, 7> poseColumns(const Pose& pose) {
  return {pose.t().x(), pose.t().y(), pose.t().z(), pose.q().x(), pose.q().y(), pose.q().z(), pose.q().w()};
}

}  // namespace

std::string exportTum(const Store& store, const std::vector<StoredTrajectory>& map) {
  urban_nav_core::Trajectory trajectory;
  for (const StoredTrajectory& each : map)
    for (const StampedPose& pose : each.T_map_base)
      if (!trajectory.append(pose.stamp, pose.pose))
        throw UserError(store.path(), "session " + each.session.id + " overlaps another one in time",
                        "one session, by --session");
  return urban_nav_core::printTum(trajectory);
}

std::string exportKitti(Store& store, const std::vector<StoredTrajectory>& map) {
  std::vector<Pose> poses;
  Pose T_first_map;
  bool first = true;
  for (const StoredTrajectory& each : map) {
    if (each.T_map_base.empty()) continue;
    const Pose T_base_camera = makeCamera(store, each.session);
    if (std::exchange(first, false)) T_first_map = (each.T_map_base.front().pose * T_base_camera).inverse();
    std::size_t next = 0;
    const auto add = [&](bool used) {
      if (used && next < each.T_map_base.size()) {
        poses.push_back(T_first_map * each.T_map_base[next++].pose * T_base_camera);
      } else if (!used && !poses.empty()) {
        poses.push_back(poses.back());
      }
    };
    store.inputs().forEach(each.session.id, [&](const urban_nav_store::InputEvent& event) {
      if (event.stream == kStereo) add(event.used);
    });
    while (next < each.T_map_base.size()) add(true);  // of a store without the order of inputs
  }
  return urban_nav_core::printKitti(poses);
}

namespace {

/// Returns whether a step of odometry leads across a cut.
bool isCut(const Edge& edge, const std::vector<urban_nav_store::StoredEdit>& edits) {
  return edge.kind == EdgeKind::Odometry &&
         std::any_of(edits.begin(), edits.end(), [&](const urban_nav_store::StoredEdit& edit) {
           return edit.action == "cut" && edit.edge.a.session == edge.a.session && edge.a.stamp <= edit.edge.a.stamp &&
                  edge.b.stamp > edit.edge.a.stamp;
         });
}

}  // namespace

ExportedGraph exportG2o(Store& store, const std::vector<std::vector<StoredTrajectory>>& maps) {
  ExportedGraph exported;
  const std::vector<urban_nav_store::StoredEdit> edits = urban_nav_store::EditJournal(store).standing();
  G2oGraph graph;
  std::map<std::pair<std::string, StampNs>, G2oGraph::Id> ids;
  for (const auto& map : maps) {
    bool first = true;
    for (const StoredTrajectory& each : map) {
      for (const StampedPose& pose : each.T_map_base) {
        const auto id = static_cast<G2oGraph::Id>(graph.vertices.size());
        ids[{each.session.id, pose.stamp}] = id;
        graph.vertices.push_back({id, {}});
        graph.setPose(graph.vertices.back(), pose.pose);
        if (std::exchange(first, false)) graph.fixed.push_back(id);
      }
    }
  }
  for (const auto& map : maps) {
    for (const StoredTrajectory& each : map) {
      store.graph().forEachEdge(each.session.id, [&](const Edge& edge) {
        const auto a = ids.find({edge.a.session, edge.a.stamp}), b = ids.find({edge.b.session, edge.b.stamp});
        if (edge.kind == EdgeKind::Session) return;  // the order of sessions, no measurement
        if (a == ids.end() || b == ids.end()) {
          ++exported.outside;
          return;
        }
        if (edge.verdict != ClosureVerdict::Accepted || isCut(edge, edits)) {
          ++exported.left_out;
          return;
        }
        G2oGraph::Edge line;
        line.from = a->second;
        line.to = b->second;
        line.values = poseColumns(edge.measured.T_a_b);
        urban_nav_core::setG2oInformation(
            line, urban_nav_core::g2oFromBoxInformation(edge.measured.information, edge.measured.T_a_b));
        graph.edges.push_back(line);
      });
    }
  }
  exported.vertices = static_cast<std::int64_t>(graph.vertices.size());
  exported.edges = static_cast<std::int64_t>(graph.edges.size());
  exported.text = urban_nav_core::printG2o(graph);
  return exported;
}

}  // namespace urban_nav
