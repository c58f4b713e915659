// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "places.hpp"

namespace urban_nav_sim::bench {

/// Visual words: cluster centres of SIFT descriptors (Lowe 2004), by BOWKMeansTrainer of OpenCV.
class Vocabulary {
 public:
  /// `descriptors`: one per row, at least as many as words. Deterministic.
  Vocabulary(const cv::Mat& descriptors, int words);

  /// Returns the descriptors of the 500 strongest features of an 8 bit grey image.
  static cv::Mat describe(const cv::Mat& image);
  /// Counts the nearest words of these descriptors.
  Counts countWords(const cv::Mat& descriptors) const;

 private:
  cv::Mat words_;
};

}  // namespace urban_nav_sim::bench
