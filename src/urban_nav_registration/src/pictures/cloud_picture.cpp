// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/pictures/cloud_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "pictures/canvas.hpp"

namespace urban_nav_registration {

using urban_nav_core::PointCloud;
using urban_nav_core::Pose;

namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kShownShare = 0.97;    // share of the points along each axis that defines the extent
constexpr double kFarthestPoint = 1e4;  // m; farther points are ignored
constexpr double kSmallestHalf = 0.1, kCloudMargin = 1.05;
constexpr int kNarrowestCloud = 100, kWidest = 4000;  // px
const cv::Scalar kRed(60, 60, 220), kBlue(220, 60, 60), kGreen(60, 150, 60);

Points finite(const PointCloud& cloud) {
  Points points;
  points.reserve(cloud.points.size());
  for (const Eigen::Vector3f& point : cloud.points)
    if (point.allFinite() && point.cwiseAbs().maxCoeff() < kFarthestPoint) points.push_back(point.cast<double>());
  return points;
}

Points moved(const Points& points, const Pose& T) {
  Points result;
  result.reserve(points.size());
  for (const Eigen::Vector3d& point : points) result.push_back(T * point);
  return result;
}

double quantile(std::vector<double>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Extent of all panels: a cube around the points.
struct Extent {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double half = 5.0;  ///< m
};

Extent computeExtent(const Points& target, const Points& source) {
  Extent extent;
  if (target.empty() && source.empty()) return extent;
  extent.half = kSmallestHalf;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Points* points : {&target, &source})
      for (const Eigen::Vector3d& point : *points) values.push_back(point[axis]);
    const double low = quantile(values, 1.0 - kShownShare), high = quantile(values, kShownShare);
    extent.centre[axis] = 0.5 * (low + high);
    extent.half = std::max(extent.half, 0.5 * kCloudMargin * (high - low));
  }
  return extent;
}

/// A projection of the cube, with the axes that point right and up.
class CloudPanel {
 public:
  CloudPanel(cv::Mat canvas, const Extent& extent, int right, int up)
      : canvas_(std::move(canvas)),
        extent_(extent),
        right_(right),
        up_(up),
        px_per_m_(0.5 * canvas_.cols / extent.half) {}

  void draw(const Points& target, const Points& source) {
    const cv::Mat of_target = opacity(target), of_source = opacity(source);
    for (int v = 0; v < canvas_.rows; ++v)
      for (int u = 0; u < canvas_.cols; ++u) {
        // multiplicative inks: dark where both clouds have points
        const float t = of_target.at<float>(v, u), s = of_source.at<float>(v, u);
        canvas_.at<cv::Vec3b>(v, u) = cv::Vec3b(level(1.0F - t), level((1.0F - t) * (1.0F - s)), level(1.0F - s));
      }
    if (target.empty() && source.empty()) write(canvas_, "no points", {12, canvas_.rows / 2}, kInk);
  }

  void drawOrigin(const Eigen::Vector3d& at, const cv::Scalar& colour) {
    cv::circle(canvas_, pixel(at), 4, colour, cv::FILLED, cv::LINE_AA);
    cv::circle(canvas_, pixel(at), 4, kInk, 1, cv::LINE_AA);
  }

  /// Draws a free direction to both sides of a position.
  void drawFree(const Eigen::Vector3d& at, const Eigen::Vector3d& direction) {
    const Eigen::Vector3d reach = 0.5 * extent_.half * direction;
    cv::arrowedLine(canvas_, pixel(at), pixel(at + reach), kGreen, 2, cv::LINE_AA, 0, 0.06);
    cv::arrowedLine(canvas_, pixel(at), pixel(at - reach), kGreen, 2, cv::LINE_AA, 0, 0.06);
  }

  /// Draws a scale bar of a round length of about a quarter of the panel.
  void drawBar() {
    const double about = 0.5 * extent_.half, ten = std::pow(10.0, std::floor(std::log10(about)));
    const double length = about >= 5.0 * ten ? 5.0 * ten : about >= 2.0 * ten ? 2.0 * ten : ten;
    const int px = static_cast<int>(std::lround(length * px_per_m_)), y = canvas_.rows - 10;
    cv::line(canvas_, {10, y}, {10 + px, y}, kInk, 2);
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g m", length);
    write(canvas_, text.data(), {10, y - 6}, kInk);
  }

 private:
  static std::uint8_t level(float share) { return static_cast<std::uint8_t>(std::lround(245.0F * share)); }

  Eigen::Vector2d place(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d from_centre = px_per_m_ * (point - extent_.centre);
    return {0.5 * canvas_.cols + from_centre[right_], 0.5 * canvas_.rows - from_centre[up_]};
  }
  cv::Point pixel(const Eigen::Vector3d& point) const {
    const Eigen::Vector2d at = place(point).cwiseMax(-kFarthestPoint).cwiseMin(kFarthestPoint);
    return {static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y()))};
  }

  /// Returns the opacity of each pixel: 0.5 at the mean number of points of the occupied pixels.
  cv::Mat opacity(const Points& points) const {
    cv::Mat counts = cv::Mat::zeros(canvas_.size(), CV_32F);
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector2d at = place(point);
      if (at.x() < 0.0 || at.y() < 0.0 || at.x() >= canvas_.cols || at.y() >= canvas_.rows) continue;
      counts.at<float>(static_cast<int>(at.y()), static_cast<int>(at.x())) += 1.0F;
    }
    const int filled = cv::countNonZero(counts);
    if (filled == 0) return counts;
    const float usual = static_cast<float>(cv::sum(counts)[0] / filled);
    for (int v = 0; v < counts.rows; ++v)
      for (int u = 0; u < counts.cols; ++u) {
        float& count = counts.at<float>(v, u);
        count = 1.0F - std::exp2(-count / usual);
      }
    return counts;
  }

  cv::Mat canvas_;
  const Extent extent_;
  const int right_, up_;
  const double px_per_m_;
};

}  // namespace

Picture drawClouds(const PointCloud& source, const PointCloud& target, const Pose& T_guess, const Pose& T_target_source,
                   const CloudPictureOptions& options) {
  const int size = std::clamp(options.panel, kNarrowestCloud, kWidest);
  const Points of_target = finite(target), of_source = finite(source);
  cv::Mat canvas(size + kCaptionHeight, 3 * size + 2 * kPanelGap, CV_8UC3, kPaper);
  const Extent extent = computeExtent(of_target, moved(of_source, T_target_source));
  struct Projection {
    const char* title;
    const Pose& T;
    int up;
  };
  const Projection projections[] = {{"before, from above", T_guess, 1},
                                    {"aligned, from above", T_target_source, 1},
                                    {"aligned, from the side", T_target_source, 2}};
  int left = 0;
  for (const Projection& projection : projections) {
    cv::Mat area = canvas(cv::Rect(left, 0, size, size));
    CloudPanel panel(area, extent, 0, projection.up);
    panel.draw(of_target, moved(of_source, projection.T));
    panel.drawOrigin(Eigen::Vector3d::Zero(), kRed);
    panel.drawOrigin(projection.T.t(), kBlue);
    if (&projection.T == &T_target_source)
      for (const urban_nav_core::Vector6d& direction : options.free_directions)
        if (direction.allFinite() && direction.head<3>().norm() > 0.5)
          panel.drawFree(projection.T.t(), direction.head<3>().normalized());
    panel.drawBar();
    writeTitle(area, projection.title);
    left += size + kPanelGap;
  }
  cv::Mat below = canvas(cv::Rect(0, size, canvas.cols, kCaptionHeight));
  write(below, options.caption, {6, 16}, kInk);
  return toPicture(canvas);
}

}  // namespace urban_nav_registration
