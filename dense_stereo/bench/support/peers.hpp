// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "dense_stereo/disparity_image.hpp"

namespace dense_stereo::bench {

/// A matcher under measurement: one of this package's methods or one of OpenCV's.
class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;
  /// Grey images of equal size. OpenCV's answers have no variance: theirs is 0.
  virtual const DisparityImage& match(const cv::Mat& left, const cv::Mat& right, int disparities) = 0;
};

/// Both methods of this package, StereoBM and StereoSGBM in all its modes, each with the options that its
/// documentation suggests.
std::vector<std::unique_ptr<Peer>> allPeers();

/// A pair with true disparities of the left image.
struct TruePair {
  std::string name;
  cv::Mat left, right;  ///< grey
  cv::Mat truth;        ///< CV_32F, px; below 0: not to be counted; infinite depth is 0
  float step = 0.0F;    ///< px, of the values of `truth`; 0: it is exact
  cv::Mat sky;          ///< CV_8U, nonzero where there is no surface; empty if there is none
  int disparities = 64;
};

/// Middlebury's teddy, cones and wood2 below a data folder.
std::vector<TruePair> middleburyPairs(const std::string& data);
/// Every `step`-th pair of a simulated session: FOLDER of `urban_nav simulate --folder FOLDER --views stereo -o BAG`,
/// and its truth folder. Pixels that only one camera sees, or whose surface is farther than 47 m, are not counted.
std::vector<TruePair> simulatedPairs(const std::string& name, const std::string& folder, const std::string& truth,
                                     int step);

}  // namespace dense_stereo::bench
