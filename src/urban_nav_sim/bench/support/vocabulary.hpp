// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "places.hpp"

namespace urban_nav_sim::bench {

/// Visual words: middles of clusters of SIFT descriptors (Lowe 2004), found by OpenCV's BOWKMeansTrainer.
class Vocabulary {
 public:
  /// `descriptors`: a row each, at least as many as words. The same ones give the same words.
  Vocabulary(const cv::Mat& descriptors, int words);

  /// Of the 500 strongest features of an image, 8 bit, grey.
  static cv::Mat describe(const cv::Mat& image);
  /// The word nearest to each of these descriptors.
  Counts countWords(const cv::Mat& descriptors) const;

 private:
  cv::Mat words_;
};

}  // namespace urban_nav_sim::bench
