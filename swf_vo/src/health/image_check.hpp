// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "edge_width.hpp"
#include "swf_vo/frame.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace swf_vo {

/// Result of pixel-level checks of a pair, before matching.
struct ImageVerdict {
  bool usable = true;            ///< false: no measurement may be taken from this pair
  bool exchange = false;         ///< left and right are exchanged and must be swapped before use
  Reason reason = Reason::None;  ///< most severe finding
  double brightness = 0.0;       ///< mean grey level of both images
  Edges edges;                   ///< edge widths
  double contrast = 0.0;         ///< standard deviation, grey levels, the smaller one of both images
};

/// Checks subsampled pixels for missing, dark, frozen, blurred or exchanged images and for exposure jumps. Keeps the
/// statistics of the last usable pair. Allocates only when the size of the images changes. Takes about 0.1 ms at
/// 512x384.
class ImageCheck {
 public:
  /// `was_degraded`: the previous frame was not OK. The costly test for exchanged images runs in this case, at the
  /// start, and if the images are more similar to each other's predecessors than to their own.
  ImageVerdict check(const urban_nav_core::StereoPair& pair, bool was_degraded);
  void archive(urban_nav_core::Archive& archive);

 private:
  struct Figures {
    double brightness = 0.0;
    double white = 0.0;  ///< share of clipped pixels
    double contrast = 0.0;
    Eigen::Vector2d edges = Eigen::Vector2d::Zero();  ///< edgeVariance, px^2
  };
  Figures measure(const urban_nav_core::ImageView& image, std::vector<std::uint8_t>& sample) const;

  std::vector<std::uint8_t> left_, right_, last_left_, last_right_;  // every eighth pixel of every fourth row
  double usual_brightness_ = -1.0;
  Edges usual_edges_;
  int blurred_ = 0;  // consecutive frames whose edges are wider than usual
};

}  // namespace swf_vo
