// SPDX-License-Identifier: BSD-3-Clause
#include "map/rendered_poses.hpp"

#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/digest.hpp"

namespace urban_nav {

using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

constexpr const char* kRenderedStage = "edits.rendered";

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

}  // namespace

void noteRenderedPoses(Store& store, const SessionId& session) {
  if (!store.states().get(session, kRenderedStage))
    store.states().put(session, kRenderedStage, digestOfPoses(store, session));
}

void forgetRenderedPoses(Store& store, const SessionId& session) { store.states().remove(session, kRenderedStage); }

bool isRenderingOutdated(Store& store, const SessionId& session) {
  const std::optional<std::string> rendered = store.states().get(session, kRenderedStage);
  return rendered && *rendered != digestOfPoses(store, session);
}

}  // namespace urban_nav
