// SPDX-License-Identifier: BSD-3-Clause
#include "convert/row_check.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace urban_nav {

namespace {

constexpr int kCorners = 200;
constexpr int kHalf = 7;             // px: half-width of the patch
constexpr int kRows = 5;             // px, search range up and down
constexpr int kDisparities = 96;     // px
constexpr double kLeastMatch = 0.9;  // normalised correlation
constexpr std::size_t kLeastMatches = 20;

/// Returns the offset of the maximum of a parabola through three values from the middle one.
double findTop(double before, double middle, double after) {
  const double bend = before - 2.0 * middle + after;
  return bend < 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
}

std::optional<double> toRow(const cv::Mat& left, const cv::Mat& right, const cv::Point& corner) {
  const cv::Rect patch(corner.x - kHalf, corner.y - kHalf, 2 * kHalf + 1, 2 * kHalf + 1);
  const cv::Rect strip(corner.x - kHalf - kDisparities, corner.y - kHalf - kRows, kDisparities + 2 * kHalf + 1,
                       2 * (kHalf + kRows) + 1);
  const cv::Rect image(0, 0, left.cols, left.rows);
  if ((patch & image) != patch || (strip & image) != strip) return std::nullopt;
  cv::Mat scores;
  cv::matchTemplate(right(strip), left(patch), scores, cv::TM_CCOEFF_NORMED);
  double best = 0.0;
  cv::Point at;
  cv::minMaxLoc(scores, nullptr, &best, nullptr, &at);
  if (best < kLeastMatch || at.y == 0 || at.y == scores.rows - 1) return std::nullopt;
  return at.y - kRows +
         findTop(scores.at<float>(at.y - 1, at.x), scores.at<float>(at.y, at.x), scores.at<float>(at.y + 1, at.x));
}

}  // namespace

std::optional<double> rowDisagreement(const cv::Mat& left, const cv::Mat& right) {
  if (left.empty() || right.empty() || left.size() != right.size()) return std::nullopt;
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(left, corners, kCorners, 0.01, 10.0);
  std::vector<double> rows;
  for (const cv::Point2f& corner : corners) {
    if (const std::optional<double> row = toRow(left, right, cv::Point(cvRound(corner.x), cvRound(corner.y))))
      rows.push_back(std::abs(*row));
  }
  if (rows.size() < kLeastMatches) return std::nullopt;
  std::nth_element(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(rows.size() / 2), rows.end());
  return rows[rows.size() / 2];
}

}  // namespace urban_nav
