// SPDX-License-Identifier: BSD-3-Clause
#include "session/bag_continuation.hpp"

namespace urban_nav_input {

using urban_nav_core::UserError;

UserError differentCalibration(const std::string& name) {
  return {name, "has a different calibration than the previous bags", "the same one"};
}

bool isSamePose(const urban_nav_core::Pose& a, const urban_nav_core::Pose& b) {
  return a.q().coeffs() == b.q().coeffs() && a.t() == b.t();
}

void requireSameCameras(const std::string& name, const BagCameras& here, const BagCameras& before) {
  if ((before.info.has_images && !isApprox(here.info.camera, before.info.camera, 0.0)) ||
      (here.is_placed && !isSamePose(here.info.T_base_camera, before.info.T_base_camera)))
    throw differentCalibration(name);
  if (!before.info.has_images) return;
  for (const Role role : {Role::Left, Role::Right}) {
    const ChosenTopic a = *here.topics.find(role), b = *before.topics.find(role);
    if (a.name != b.name || a.type != b.type)
      throw UserError(name, "has different topics than the previous bags", b.name);
  }
}

}  // namespace urban_nav_input
