// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

namespace urban_nav {

/// How far apart, in rows, the same things are in two images that ought to be rectified: corners of the left one are
/// looked for in the right one, a few rows up and down, to sub-pixel. The median of the absolute differences in px;
/// empty where there are too few matches to tell.
std::optional<double> rowDisagreement(const cv::Mat& left, const cv::Mat& right);

}  // namespace urban_nav
