// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/archive_types.hpp"

namespace urban_nav_core {

void archive(Archive& archive, Status& status) {
  archive(status.health, status.reason, status.sentence);
  archive.require(status.health >= Health::Ok && status.health <= Health::Recovered, "an unknown status");
}

void archive(Archive& archive, PoseWithCovariance& value) { archive(value.pose, value.covariance); }

void archive(Archive& archive, ConsideredConstant& value) {
  archive(value.name, value.used, value.mean, value.sigma, value.sensitivity);
}

void archive(Archive& archive, ConsideredConstants& values) {
  std::vector<ConsideredConstant> all(values.begin(), values.end());
  archive(all);
  values.assign(all.begin(), all.end());
}

void archive(Archive& archive, RelativePose& value) {
  archive(value.from, value.to, value.T_from_to, value.covariance, value.drift_covariance, value.status, value.source);
}

void archive(Archive& archive, MotionInput& input) {
  Pose sensor(input.q_base_sensor, Vector3d::Zero());
  archive(input.from, input.to, input.T_from_to, input.information, input.source, sensor, input.specific_force);
  archive.require(input.source >= MotionSource::Given && input.source <= MotionSource::Wheels,
                  "a motion source is unknown");
  input.q_base_sensor = sensor.q();
}

void archive(Archive& archive, SpecificForce& value) { archive(value.stamp, value.force); }

void archive(Archive& archive, Pinhole& camera) {
  archive(camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height);
}

void archive(Archive& archive, StereoCamera& camera) { archive(camera.left, camera.baseline, camera.disparity_offset); }

void archive(Archive& archive, PatchSource& source) { archive(source.pixels); }

void archive(Archive& archive, PatchTemplate& patch) {
  archive(patch.value, patch.filter_x, patch.filter_y, patch.filter_gain, patch.warp.A, patch.warp.bend);
  archive(patch.inverse_hessian, patch.unit_covariance, patch.view_blur, patch.energy);
}

}  // namespace urban_nav_core
