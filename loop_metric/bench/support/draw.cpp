// SPDX-License-Identifier: BSD-3-Clause
#include "support/draw.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace loop_metric::bench {

void drawMatches(const Keyframe& a, const Keyframe& b, const StereoClosure& closure, const std::string& path) {
  const cv::Mat left = cv::imdecode(a.image, cv::IMREAD_COLOR), right = cv::imdecode(b.image, cv::IMREAD_COLOR);
  cv::Mat both;
  cv::hconcat(left, right, both);
  for (const MatchedPixels& match : closure.pixels) {
    const cv::Scalar colour = match.inlier ? cv::Scalar(60, 220, 60) : cv::Scalar(40, 40, 230);
    const cv::Point2d p(match.in_a.x(), match.in_a.y()), q(match.in_b.x() + left.cols, match.in_b.y());
    cv::line(both, p, q, 0.6 * colour, 1, cv::LINE_AA);
    cv::circle(both, p, 2, colour, 1, cv::LINE_AA);
    cv::circle(both, q, 2, colour, 1, cv::LINE_AA);
  }
  cv::putText(both, std::string(toString(closure.verdict)) + ": " + closure.sentence, {6, both.rows - 8},
              cv::FONT_HERSHEY_SIMPLEX, 0.45, {0, 255, 255}, 1, cv::LINE_AA);
  cv::imwrite(path, both);
}

}  // namespace loop_metric::bench
