// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_core/image/view.hpp"
#include "urban_nav_input/examination/finding.hpp"
#include "urban_nav_input/session/source.hpp"

namespace urban_nav_input {

/// Checks the images of some stereo pairs: rows of matching points (rectification), the sign of their disparities
/// (exchanged cameras), whether left images match their partners better than those of neighbouring pairs (pairing), and
/// grey values (depth). Matches ORB features over the whole image, without the assumption that rows agree.
/// Deterministic. Not thread-safe.
class PairCheck {
 public:
  /// Adds a pair and the right images of the previous and the next pair, which may be empty.
  void add(const urban_nav_core::ImageView& left, const urban_nav_core::ImageView& right,
           const urban_nav_core::ImageView& right_before, const urban_nav_core::ImageView& right_after);
  /// `info`: of the recording, for the options. `interval`: ns between pairs.
  std::vector<Finding> findings(const SourceInfo& info, urban_nav_core::StampNs interval) const;
  /// Number of pairs added.
  int pairs() const { return pairs_; }

 private:
  struct Match {
    double u, v;  ///< px from the centre of the left image
    double du;    ///< px, left minus right: the disparity
    double dv;    ///< px, right minus left
  };
  struct Grey {
    double mean = 0.0, bright = 0.0;  ///< mean; share of pixels above 251
  };
  static Grey measureGrey(const urban_nav_core::ImageView& image);
  void rowsFindings(const SourceInfo& info, std::vector<Finding>& findings) const;
  void orderFindings(const SourceInfo& info, urban_nav_core::StampNs interval, std::vector<Finding>& findings) const;
  void greyFindings(std::vector<Finding>& findings) const;

  std::vector<Match> matches_;
  std::vector<Grey> left_, right_;
  int pairs_ = 0, textured_ = 0, unmatched_ = 0;
  int compared_ = 0, before_wins_ = 0, after_wins_ = 0;  // pairs with neighbours
  double half_width_ = 0.0, half_height_ = 0.0;
};

}  // namespace urban_nav_input
