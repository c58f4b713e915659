// SPDX-License-Identifier: BSD-3-Clause
#include "faults/turned_view.hpp"

#include <opencv2/imgproc.hpp>

namespace urban_nav_sim {

TurnedView::TurnedView(const Lens& lens, const Eigen::AngleAxisd& turn)
    : source_u_(lens.height, lens.width, CV_32F), source_v_(lens.height, lens.width, CV_32F) {
  const Eigen::Matrix3d R = turn.toRotationMatrix();
  for (int v = 0; v < lens.height; ++v)
    for (int u = 0; u < lens.width; ++u) {
      const Eigen::Vector2d pixel(u, v);
      const std::optional<Eigen::Vector2d> ideal = lens.idealAt(pixel);
      const std::optional<Eigen::Vector2d> source = ideal ? lens.project(R * ideal->homogeneous()) : std::nullopt;
      source_u_.at<float>(v, u) = static_cast<float>(source.value_or(pixel).x());
      source_v_.at<float>(v, u) = static_cast<float>(source.value_or(pixel).y());
    }
}

cv::Mat TurnedView::apply(const cv::Mat& image) const {
  cv::Mat turned;
  cv::remap(image, turned, source_u_, source_v_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return turned;
}

}  // namespace urban_nav_sim
