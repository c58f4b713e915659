// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/session/source.hpp"

namespace urban_nav_input {

/// The stereo camera of bags that follow each other.
struct BagCameras {
  const SourceInfo& info;
  const BagTopics& topics;
  bool is_placed;  ///< the bags have its extrinsics
};

/// Throws UserError that begins with `name` if calibration, extrinsics or topics of their stereo camera differ from
/// those of the bags `before`.
void requireSameCameras(const std::string& name, const BagCameras& here, const BagCameras& before);

/// Returns the error for bags whose calibration differs from that of the bags before.
urban_nav_core::UserError differentCalibration(const std::string& name);

bool isSamePose(const urban_nav_core::Pose& a, const urban_nav_core::Pose& b);

}  // namespace urban_nav_input
