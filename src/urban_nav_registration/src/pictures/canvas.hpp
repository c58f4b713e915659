// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "urban_nav_registration/pictures/picture.hpp"

namespace urban_nav_registration {

// Common style of closure pictures, BGR.
const cv::Scalar kPaper(245, 245, 245), kInk(30, 30, 30);
constexpr int kCaptionHeight = 24;  ///< px, of the strip below the panels
constexpr int kPanelGap = 4;        ///< px, between the panels

/// Writes text; `at`: start of its base line.
void write(cv::Mat& canvas, const std::string& text, cv::Point at, const cv::Scalar& colour);
/// Writes a title in the upper left corner, light on dark.
void writeTitle(cv::Mat& canvas, const std::string& title);
/// Converts a continuous image of three bytes per pixel.
Picture toPicture(const cv::Mat& canvas);

}  // namespace urban_nav_registration
