// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "urban_nav_registration/pictures/picture.hpp"

namespace urban_nav_registration {

// What pictures of closures look like, BGR.
const cv::Scalar kPaper(245, 245, 245), kInk(30, 30, 30);
constexpr int kCaptionHeight = 24;  ///< px, of the strip below
constexpr int kPanelGap = 4;        ///< px, between the panels

/// `at`: where the line of text begins, on its base line.
void write(cv::Mat& canvas, const std::string& text, cv::Point at, const cv::Scalar& colour);
/// In the upper left corner, light on dark.
void writeTitle(cv::Mat& canvas, const std::string& title);
/// `canvas` is whole, of three bytes.
Picture toPicture(const cv::Mat& canvas);

}  // namespace urban_nav_registration
