// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace urban_nav_core {

/// Lens distortion, as a map of the image plane at z = 1 (Brown 1966; models and order of coefficients of
/// sensor_msgs/CameraInfo and OpenCV), with r^2 = x^2 + y^2:
///
///   plumb bob  k1 k2 p1 p2 [k3]      radial factor 1 + k1 r^2 + k2 r^4 + k3 r^6
///   rational   k1 k2 p1 p2 k3 k4 k5 k6   the same over 1 + k4 r^2 + k5 r^4 + k6 r^6
///   tangential (2 p1 x y + p2 (r^2 + 2 x^2),  p1 (r^2 + 2 y^2) + 2 p2 x y)
///   equidistant (fisheye; Kannala and Brandt 2006)  k1 k2 k3 k4      with a = atan r: radial factor
///              (a + k1 a^3 + k2 a^5 + k3 a^7 + k4 a^9) / r, nothing tangential
///
/// The polynomial is valid where it was fitted: beyond some radius it is no longer monotonic ("folds") and two
/// directions would map to one pixel. Distortion determines this radius and returns no value beyond it.
class Distortion {
 public:
  Distortion() = default;  ///< no distortion
  /// k1 k2 p1 p2 k3 k4 k5 k6; must be finite.
  explicit Distortion(const std::array<double, 8>& coefficients);
  /// k1 k2 k3 k4; must be finite.
  static Distortion equidistant(const std::array<double, 4>& coefficients);
  /// Creates the model from its name and coefficients, in the notation of camera_info ("plumb_bob",
  /// "rational_polynomial", "equidistant" or "fisheye") or of EuRoC and Kalibr ("radial-tangential", "radtan"). Missing
  /// coefficients are zero. Coefficients beyond those of the model must be zero, since OpenCV pads up to 14. A
  /// "plumb_bob" with eight coefficients is read as the rational model, as OpenCV does. Throws UserError that begins
  /// with `where`.
  static Distortion named(const std::string& model, const std::vector<double>& coefficients, const std::string& where);

  const std::array<double, 8>& coefficients() const { return k_; }
  bool isEquidistant() const { return equidistant_; }
  bool isNone() const;
  /// Returns the largest valid radius in the plane z = 1, at which the radial part folds; kLargestRadius if it never
  /// does.
  double foldRadius() const { return fold_radius_; }
  static constexpr double kLargestRadius = 8.0;  ///< 83 deg off the axis

  /// Returns the distorted point of a point of the ideal plane; empty at or beyond the fold.
  std::optional<Eigen::Vector2d> distort(const Eigen::Vector2d& ideal) const;
  /// Returns d(distorted)/d(ideal).
  Eigen::Matrix2d jacobian(const Eigen::Vector2d& ideal) const;
  /// Returns the undistorted point, by Newton's method to 1e-12; empty if no point inside the fold maps to `distorted`.
  std::optional<Eigen::Vector2d> undistort(const Eigen::Vector2d& distorted) const;

 private:
  struct Radial {
    double factor, slope;  ///< f(r^2) and its derivative with respect to r^2
  };
  Radial radial(double r2) const;
  Eigen::Vector2d formula(const Eigen::Vector2d& ideal) const;
  double findFold() const;
  double radiusSeenAt(double distorted_radius) const;

  Radial equidistantRadial(double r2) const;

  std::array<double, 8> k_{};  ///< the equidistant model uses the first four
  bool equidistant_ = false;
  double fold_radius_ = kLargestRadius;
};

std::ostream& operator<<(std::ostream& out, const Distortion& distortion);

}  // namespace urban_nav_core
