// SPDX-License-Identifier: BSD-3-Clause
#include "vocabulary.hpp"

#include <opencv2/features2d.hpp>
#include <vector>

namespace urban_nav_sim::bench {

Vocabulary::Vocabulary(const cv::Mat& descriptors, int words) {
  cv::setRNGSeed(1);
  const cv::TermCriteria end(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 0.1);
  words_ = cv::BOWKMeansTrainer(words, end, 1).cluster(descriptors);
}

cv::Mat Vocabulary::describe(const cv::Mat& image) {
  std::vector<cv::KeyPoint> features;
  cv::Mat descriptors;
  cv::SIFT::create(500)->detectAndCompute(image, cv::noArray(), features, descriptors);
  return descriptors;
}

Counts Vocabulary::countWords(const cv::Mat& descriptors) const {
  Counts counts(static_cast<std::size_t>(words_.rows), 0);
  if (descriptors.empty()) return counts;
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(cv::NORM_L2).match(descriptors, words_, matches);
  for (const cv::DMatch& match : matches) ++counts[static_cast<std::size_t>(match.trainIdx)];
  return counts;
}

}  // namespace urban_nav_sim::bench
