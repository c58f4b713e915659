// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "front_end/front_end.hpp"
#include "health/image_check.hpp"
#include "swf_vo/frame.hpp"
#include "swf_vo/parameters.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

/// Measurements of one frame that determine its status.
struct Evidence {
  ImageVerdict image;
  bool corrupted = false;  ///< image rows were corrupted and are interpolated
  bool first = false;      ///< first frame of the session: nothing can be tracked yet
  bool gap = false;        ///< time since the previous frame much longer than the usual frame period
  bool localised = false;  ///< the pose is estimated from matches
  int tracked = 0;         ///< trusted matches of known landmarks
  int features = 0;        ///< tracked and new ones
  int candidates = 0;      ///< matches before outlier rejection
  double inlier_share = 0.0;
  double disparity_offset_px = 0.0;        ///< current estimate for the camera
  double disparity_offset_sigma_px = 0.0;  ///< its standard deviation; 0 where it is not estimated
  std::optional<double> rows_disagree_px;  ///< RowCheck, where it was measured
};

/// Determines status and reason of a frame, including LOST and RECOVERED. Deterministic; allocates only for long
/// messages.
class HealthMonitor {
 public:
  explicit HealthMonitor(const Parameters& parameters);

  /// Returns whether the measurements of this frame can be used.
  bool isTrusted(const Evidence& evidence) const;
  /// Returns whether too few features were matched and the pixels do not explain it, so that the rows should be
  /// checked.
  bool isUnexplained(const Evidence& evidence) const;
  urban_nav_core::Status judge(const Evidence& evidence);
  void archive(urban_nav_core::Archive& archive);

 private:
  Reason reasonFor(const Evidence& evidence) const;

  /// Returns whether the disparity offset is far outside its prior.
  bool isMiscalibrated(const Evidence& evidence) const;

  int lost_features_;
  int degraded_features_;
  double offset_prior_px_;
  bool was_lost_ = false;
};

/// Returns a description of the reason for the user.
const char* sentence(Reason reason);

}  // namespace swf_vo
