// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "urban_nav_core/camera/rectify.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr int kBorderSamples = 512;   // per side
constexpr double kInside = 0.01;      // px of margin inside the covered area: the table is rounded to 1/128
constexpr double kLeastCosine = 0.5;  // between the two optical axes

/// Rectangle in the plane z = 1 of the rectified camera.
struct Rectangle {
  double left = -std::numeric_limits<double>::infinity(), right = std::numeric_limits<double>::infinity();
  double top = left, bottom = right;
};

/// Returns the rectified direction of a border pixel; if it is beyond the fold of the distortion, of the outermost
/// valid pixel towards the centre.
std::optional<Eigen::Vector2d> borderDirection(const RawCamera& raw, const Eigen::Matrix3d& R,
                                               const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d centre(raw.pinhole.cx, raw.pinhole.cy);
  std::optional<Eigen::Vector3d> ray = raw.ray(pixel);
  double reached = 0.0, beyond = 1.0;
  for (int i = 0; !ray && i < 30; ++i) {
    const double middle = 0.5 * (reached + beyond);
    (raw.ray(centre + middle * (pixel - centre)) ? reached : beyond) = middle;
    if (i == 29) ray = raw.ray(centre + reached * (pixel - centre));
  }
  if (!ray) return std::nullopt;
  const Eigen::Vector3d turned = R * *ray;
  if (!(turned.z() > 0.0)) return std::nullopt;
  return Eigen::Vector2d(turned.head<2>() / turned.z());
}

/// Shrinks the rectangle to the field of view of this camera. Returns false if a border direction does not exist.
bool cutToView(const RawCamera& raw, const Eigen::Matrix3d& R, Rectangle& view) {
  const double u1 = raw.pinhole.width - 1, v1 = raw.pinhole.height - 1;
  for (int i = 0; i <= kBorderSamples; ++i) {
    const double s = static_cast<double>(i) / kBorderSamples;
    const auto left = borderDirection(raw, R, {0.0, s * v1}), right = borderDirection(raw, R, {u1, s * v1});
    const auto top = borderDirection(raw, R, {s * u1, 0.0}), bottom = borderDirection(raw, R, {s * u1, v1});
    if (!left || !right || !top || !bottom) return false;
    view.left = std::max(view.left, left->x());
    view.right = std::min(view.right, right->x());
    view.top = std::max(view.top, top->y());
    view.bottom = std::min(view.bottom, bottom->y());
  }
  return true;
}

std::string print(const Vector3d& t) {
  std::ostringstream text;
  text << "(" << t.x() << ", " << t.y() << ", " << t.z() << ") m";
  return text.str();
}

}  // namespace

StereoRectification rectifyStereo(const RawCamera& left, const RawCamera& right, const Pose& T_right_left,
                                  const std::string& where) {
  const int width = left.pinhole.width, height = left.pinhole.height;
  if (width != right.pinhole.width || height != right.pinhole.height) {
    throw UserError(where, "images of different size", "equal sizes of left and right");
  }
  const Vector3d half = 0.5 * logSo3(T_right_left.q());
  const Matrix3d left_half = expSo3(half).toRotationMatrix();              // R_middle_left
  const Matrix3d right_half = expSo3(Vector3d(-half)).toRotationMatrix();  // R_middle_right
  // Position of the right camera in the left one, in axes half way between the two.
  const Vector3d p_left_right = T_right_left.inverse().t();
  const Vector3d baseline = left_half * p_left_right;
  if (!(baseline.x() > 0.5 * baseline.norm()) || !(std::cos(2.0 * half.norm()) > kLeastCosine)) {
    throw UserError(where, "right camera at " + print(p_left_right) + " of the left optical frame",
                    "on the right (x > 0) and with parallel axes; are left and right swapped?");
  }
  // Smallest rotation that takes the baseline to the x axis.
  const Matrix3d align = Quaterniond::FromTwoVectors(baseline, Vector3d::UnitX()).toRotationMatrix();

  StereoRectification result;
  result.R_left = align * left_half;
  result.R_right = align * right_half;
  Rectangle view;
  const bool followed = cutToView(left, result.R_left, view) && cutToView(right, result.R_right, view);
  if (!followed || !(view.right > view.left) || !(view.bottom > view.top)) {
    throw UserError(where, "no common view of both cameras", "a calibration of two cameras with overlapping views");
  }
  const double f = std::max((width - 1 + 2 * kInside) / (view.right - view.left),
                            (height - 1 + 2 * kInside) / (view.bottom - view.top));
  const double cx = 0.5 * (width - 1) - f * 0.5 * (view.left + view.right);
  const double cy = 0.5 * (height - 1) - f * 0.5 * (view.top + view.bottom);
  result.camera = {{f, f, cx, cy, width, height}, baseline.norm()};
  return result;
}

}  // namespace urban_nav_core
