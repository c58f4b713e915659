// SPDX-License-Identifier: BSD-3-Clause
#include "map/rendered_poses.hpp"

#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/digest.hpp"

namespace urban_nav {

using urban_nav_core::Pose;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

constexpr const char* kRenderedStage = "edits.rendered";
constexpr const char* kPosesStage = "edits.rendered_poses";
constexpr std::size_t kPoseBytes = 3 * sizeof(double) + 4 * sizeof(float);

std::string digestOfPoses(Store& store, const SessionId& session) {
  std::string bytes;
  store.graph().forEachRelaxed(session, [&](const urban_nav_store::RelaxedPose& pose) {
    urban_nav_store::appendInteger(bytes, static_cast<std::uint64_t>(pose.stamp));
    const urban_nav_core::Pose& T = pose.T_map_base;
    for (const double value : {T.t().x(), T.t().y(), T.t().z(), T.q().w(), T.q().x(), T.q().y(), T.q().z()})
      urban_nav_store::appendNumber(bytes, value);
  });
  return urban_nav_store::sha256(bytes);
}

std::string packPoses(const std::vector<urban_nav_core::StampedPose>& poses) {
  std::string bytes;
  bytes.reserve(kPoseBytes * poses.size());
  for (const urban_nav_core::StampedPose& each : poses) {
    for (int k = 0; k < 3; ++k) urban_nav_store::appendNumber(bytes, each.pose.t()(k));
    for (int k = 0; k < 4; ++k) urban_nav_store::appendFloat(bytes, static_cast<float>(each.pose.q().coeffs()(k)));
  }
  return bytes;
}

std::vector<Pose> unpackPoses(const std::string& bytes) {
  urban_nav_store::ByteReader reader(bytes);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < bytes.size() / kPoseBytes; ++i) {
    Eigen::Vector3d t;
    Eigen::Quaterniond q;
    for (int k = 0; k < 3; ++k) t(k) = reader.number();
    for (int k = 0; k < 4; ++k) q.coeffs()(k) = static_cast<double>(reader.real32());
    poses.emplace_back(q.normalized(), t);
  }
  return poses;
}

}  // namespace

void noteRenderedPoses(Store& store, const SessionId& session) {
  if (store.states().get(session, kRenderedStage)) return;
  store.states().put(session, kRenderedStage, digestOfPoses(store, session));
  for (const urban_nav_store::Session& each : store.sessions().all())
    if (each.id == session)
      store.states().put(session, kPosesStage, packPoses(urban_nav_store::readTrajectory(store, each).T_map_base));
}

void forgetRenderedPoses(Store& store, const SessionId& session) {
  store.states().remove(session, kRenderedStage);
  store.states().remove(session, kPosesStage);
}

bool isRenderingOutdated(Store& store, const SessionId& session) {
  const std::optional<std::string> rendered = store.states().get(session, kRenderedStage);
  return rendered && *rendered != digestOfPoses(store, session);
}

std::optional<std::vector<Pose>> renderedPoses(Store& store, const urban_nav_store::StoredTrajectory& current) {
  if (isRenderingOutdated(store, current.session.id)) {
    const std::optional<std::string> bytes = store.states().get(current.session.id, kPosesStage);
    if (!bytes || bytes->size() != kPoseBytes * current.T_map_base.size()) return std::nullopt;
    return unpackPoses(*bytes);
  }
  std::vector<Pose> poses;
  for (const urban_nav_core::StampedPose& each : current.T_map_base) poses.push_back(each.pose);
  return poses;
}

}  // namespace urban_nav
