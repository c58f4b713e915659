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

/// What the pixels of a pair say of themselves, before anything is matched.
struct ImageVerdict {
  bool usable = true;            ///< false: no measurement is to be taken from this pair
  bool exchange = false;         ///< left and right are exchanged: use them the other way round
  Reason reason = Reason::None;  ///< the gravest finding
  double brightness = 0.0;       ///< mean grey level of both images
  Edges edges;                   ///< how sharp they are
  double contrast = 0.0;         ///< standard deviation, grey levels, the lesser of the two images
};

/// Looks at thinned-out pixels: missing, dark, frozen, exposure jumps, blur, exchanged images. Remembers the last
/// usable pair's figures. Allocates only when the size of the images changes. Costs some 0.1 ms at 512x384.
class ImageCheck {
 public:
  /// `doubtful`: the frame before was not OK. The test for exchanged images, the dear one, runs then, at the start, and
  /// where the images resemble each other's predecessors more than their own.
  ImageVerdict look(const urban_nav_core::StereoPair& pair, bool doubtful);
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
  int blurred_ = 0;  // frames in a row whose edges are wider than usual
};

}  // namespace swf_vo
