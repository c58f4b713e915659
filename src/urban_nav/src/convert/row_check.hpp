// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

namespace urban_nav {

/// Returns the median absolute row difference of matching corners in two supposedly rectified images, px, with
/// subpixel resolution. Searches a few rows up and down; nullopt with too few matches.
std::optional<double> rowDisagreement(const cv::Mat& left, const cv::Mat& right);

}  // namespace urban_nav
