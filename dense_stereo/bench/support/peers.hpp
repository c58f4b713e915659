// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "dense_stereo/disparity_image.hpp"

namespace dense_stereo::bench {

/// Matcher under test: a method of this package or of OpenCV.
class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;
  /// Grey images of equal size. OpenCV's results have no variance: it is 0.
  virtual const DisparityImage& match(const cv::Mat& left, const cv::Mat& right, int disparities) = 0;
};

/// Both methods of this package, and StereoBM and StereoSGBM in all modes, with the options suggested in their
/// documentation.
std::vector<std::unique_ptr<Peer>> allPeers();

/// A pair with true disparities of the left image.
struct TruePair {
  std::string name;
  cv::Mat left, right;  ///< grey
  cv::Mat truth;        ///< CV_32F, px; below 0: ignored; infinite depth is 0
  float step = 0.0F;    ///< px, resolution of `truth`; 0: exact
  cv::Mat sky;          ///< CV_8U, nonzero for sky; empty if unknown
  int disparities = 64;
};

/// Middlebury's teddy, cones and wood2 below a data folder.
std::vector<TruePair> middleburyPairs(const std::string& data);
/// Every `step`-th pair of a simulated session: FOLDER of `urban_nav simulate --folder FOLDER --views stereo -o BAG`,
/// and its truth folder. Pixels visible in one camera only, or farther than 47 m, are ignored.
std::vector<TruePair> simulatedPairs(const std::string& name, const std::string& folder, const std::string& truth,
                                     int step);

}  // namespace dense_stereo::bench
