// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/rectification_choice.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/image_features.hpp"

namespace urban_nav_ros {

using urban_nav_core::ImageView;

namespace {

constexpr std::size_t kLeastPairs = 3, kLeastRowMatches = 100;
constexpr double kFarRow = 20.0;                            // px: larger errors are false matches
constexpr double kClearlyWorse = 2.0, kVisiblyWorse = 0.5;  // ratio and difference (px) of row errors

/// Appends the row errors of matching points, px.
void appendRowErrors(const ImageView& left, const ImageView& right, std::vector<double>& errors) {
  const ImageFeatures on_left = extractFeatures(left), on_right = extractFeatures(right);
  for (const cv::DMatch& match : matchFeatures(on_left, on_right)) {
    const double dv = static_cast<double>(on_right.points[static_cast<std::size_t>(match.trainIdx)].pt.y) -
                      static_cast<double>(on_left.points[static_cast<std::size_t>(match.queryIdx)].pt.y);
    if (std::abs(dv) < kFarRow) errors.push_back(std::abs(dv));
  }
}

double medianError(std::vector<double>& errors) {
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

std::string toPixels(double value) { return urban_nav_core::printNumber(std::round(100.0 * value) / 100.0) + " px"; }

}  // namespace

std::string RectificationChoice::contradiction(bool as_named) const {
  if (isRectified(as_named) == as_named) return "";
  return std::string(is_rectified ? "images are rectified already, although their calibration has a distortion"
                                  : "images are raw, although their topic is named as rectified") +
         ": rows differ by " + toPixels(as_they_are_px) + " without and by " + toPixels(rectified_px) +
         " with rectification";
}

RectificationChoice chooseRectification(const std::vector<ImagePair>& pairs, const StereoCalibration& rectifying) {
  RectificationChoice choice;
  std::vector<double> as_they_are, rectified;
  std::vector<std::uint8_t> left_pixels, right_pixels;
  for (const auto& [left, right] : pairs) {
    appendRowErrors(toView(left), toView(right), as_they_are);
    const ImageView left_view = rectifying.rectify(Side::Left, toView(left), left_pixels);
    const ImageView right_view = rectifying.rectify(Side::Right, toView(right), right_pixels);
    if (left_view.empty() || right_view.empty()) return choice;  // the size differs from that of the calibration
    appendRowErrors(left_view, right_view, rectified);
  }
  if (pairs.size() < kLeastPairs || std::min(as_they_are.size(), rectified.size()) < kLeastRowMatches) return choice;
  choice.as_they_are_px = medianError(as_they_are);
  choice.rectified_px = medianError(rectified);
  const double better = std::min(choice.as_they_are_px, choice.rectified_px);
  const double worse = std::max(choice.as_they_are_px, choice.rectified_px);
  choice.is_decided = worse > kClearlyWorse * better && worse > better + kVisiblyWorse;
  choice.is_rectified = choice.as_they_are_px < choice.rectified_px;
  return choice;
}

}  // namespace urban_nav_ros
