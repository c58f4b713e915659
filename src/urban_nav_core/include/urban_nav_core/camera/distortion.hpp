// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace urban_nav_core {

/// Distortion of a lens between the image plane at z = 1 without and with it (Brown 1966; the models, and the order
/// of the coefficients, of sensor_msgs/CameraInfo and OpenCV): with r^2 = x^2 + y^2
///
///   plumb bob  k1 k2 p1 p2 [k3]      radial factor 1 + k1 r^2 + k2 r^4 + k3 r^6
///   rational   k1 k2 p1 p2 k3 k4 k5 k6   the same over 1 + k4 r^2 + k5 r^4 + k6 r^6
///   tangential (2 p1 x y + p2 (r^2 + 2 x^2),  p1 (r^2 + 2 y^2) + 2 p2 x y)
///   equidistant (fisheye; Kannala and Brandt 2006)  k1 k2 k3 k4      with a = atan r: radial factor
///              (a + k1 a^3 + k2 a^5 + k3 a^7 + k4 a^9) / r, nothing tangential
///
/// A polynomial serves only where its author fitted it: beyond some radius it turns back ("folds") and two directions
/// would share a pixel. Distortion knows that radius and has no answer from there on.
class Distortion {
 public:
  Distortion() = default;  ///< none
  /// k1 k2 p1 p2 k3 k4 k5 k6; must be finite.
  explicit Distortion(const std::array<double, 8>& coefficients);
  /// k1 k2 k3 k4; must be finite.
  static Distortion equidistant(const std::array<double, 4>& coefficients);
  /// By the name and the coefficients of a camera_info ("plumb_bob", "rational_polynomial", "equidistant" or
  /// "fisheye"), of EuRoC and Kalibr ("radial-tangential", "radtan"). Missing coefficients are zero, further ones must
  /// be: OpenCV knows up to 14 and pads with zeros. Eight of a "plumb_bob" are those of the rational model, as OpenCV
  /// takes them. Throws UserError that begins with `where`.
  static Distortion named(const std::string& model, const std::vector<double>& coefficients, const std::string& where);

  const std::array<double, 8>& coefficients() const { return k_; }
  bool isEquidistant() const { return equidistant_; }
  bool isNone() const;
  /// Largest radius in the plane z = 1 that is used: there the radial part turns back; kLargestRadius if it never does.
  double foldRadius() const { return fold_radius_; }
  static constexpr double kLargestRadius = 8.0;  ///< 83 deg off the axis

  /// Where the point of the ideal plane is seen; empty at or beyond the fold.
  std::optional<Eigen::Vector2d> distort(const Eigen::Vector2d& ideal) const;
  /// d(distorted)/d(ideal).
  Eigen::Matrix2d jacobian(const Eigen::Vector2d& ideal) const;
  /// The inverse by Newton's method, to 1e-12; empty if no point before the fold is seen there.
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

  std::array<double, 8> k_{};  ///< of the equidistant model the first four
  bool equidistant_ = false;
  double fold_radius_ = kLargestRadius;
};

std::ostream& operator<<(std::ostream& out, const Distortion& distortion);

}  // namespace urban_nav_core
