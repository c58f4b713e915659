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

/// The evidence of one frame that decides on its status.
struct Evidence {
  ImageVerdict image;
  bool corrupted = false;  ///< rows of an image were corrupted, and are bridged
  bool first = false;      ///< of the session: nothing can be tracked yet
  bool gap = false;        ///< far more time has passed than between frames before
  bool localised = false;  ///< the pose comes from matches
  int tracked = 0;         ///< trusted matches of known landmarks
  int features = 0;        ///< these and the new ones
  int candidates = 0;      ///< matches before outliers were removed
  double inlier_share = 0.0;
  double disparity_offset_px = 0.0;        ///< of the camera, as estimated by now
  double disparity_offset_sigma_px = 0.0;  ///< its standard deviation; 0 where it is not estimated
  std::optional<double> rows_disagree_px;  ///< RowCheck, where it was asked for
};

/// Statistics of a frame -> status and reason; when it is LOST, when RECOVERED. Deterministic, no allocation but for
/// long sentences.
class HealthMonitor {
 public:
  explicit HealthMonitor(const Parameters& parameters);

  /// True if the measurements of this frame are worth using.
  bool isTrusted(const Evidence& evidence) const;
  /// True if too little was matched and the pixels do not say why: worth a look at the rows.
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

/// What a reason means, in a sentence for a person.
const char* sentence(Reason reason);

}  // namespace swf_vo
