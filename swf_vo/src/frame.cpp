// SPDX-License-Identifier: BSD-3-Clause
#include "swf_vo/frame.hpp"

#include "urban_nav_core/io/archive_types.hpp"

namespace swf_vo {

using urban_nav_core::Archive;

void archive(Archive& archive, Feature& feature) {
  archive(feature.landmark, feature.pixel, feature.age, feature.trusted);
}

void archive(Archive& archive, Landmark& landmark) { archive(landmark.id, landmark.p_odom, landmark.sigma); }

void archive(Archive& archive, RigConstants& rig) {
  archive(rig.roll_rad, rig.roll_sigma_rad, rig.delay_s, rig.delay_sigma_s, rig.scale_sigma);
}

void archive(Archive& archive, Statistics& statistics) {
  archive(statistics.corners, statistics.features, statistics.tracked, statistics.track_length_mean);
  archive(statistics.reprojection_px, statistics.iterations, statistics.landmarks, statistics.landmarks_in_prior);
  archive(statistics.disparity_offset_px, statistics.disparity_offset_sigma_px, statistics.row_offset_px);
  archive(statistics.noise_scale);
}

void archive(Archive& archive, Settled& settled) {
  archive(settled.frame, settled.stamp, settled.T_odom_base, settled.from_previous, settled.status);
}

void archive(Archive& archive, Frame& frame) {
  archive(frame.frame, frame.stamp, frame.accepted, frame.T_odom_base, frame.velocity.twist, frame.velocity.covariance);
  archive(frame.rig.right_turn_rad);  // not in RigConstants, whose form stored runs have
  archive(frame.status, frame.statistics, frame.rig, frame.motion, frame.settled, frame.features, frame.landmarks);
}

}  // namespace swf_vo
