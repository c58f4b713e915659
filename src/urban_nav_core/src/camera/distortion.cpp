// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/distortion.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <ostream>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr int kNewtonSteps = 30;
constexpr double kConverged = 1e-13;
constexpr double kAnswer = 1e-11;   // largest residual of an inverse
constexpr int kFoldSamples = 4000;  // samples of the radius, every 0.002: distortion varies more slowly than that

}  // namespace

Distortion::Distortion(const std::array<double, 8>& coefficients) : k_(coefficients) {
  assert(std::all_of(k_.begin(), k_.end(), [](double k) { return std::isfinite(k); }));
  fold_radius_ = findFold();
}

Distortion Distortion::named(const std::string& model, const std::vector<double>& coefficients,
                             const std::string& where) {
  const auto has_only_zeros = [&] {
    return std::all_of(coefficients.begin(), coefficients.end(), [](double k) { return k == 0.0; });
  };
  const bool fisheye = model == "equidistant" || model == "fisheye" || model == "kannala_brandt";
  if (coefficients.empty() || has_only_zeros()) return Distortion();
  if (!std::all_of(coefficients.begin(), coefficients.end(), [](double k) { return std::isfinite(k); })) {
    throw UserError(where, "a distortion coefficient that is not finite", "finite coefficients");
  }
  const std::size_t count = coefficients.size();
  if (model.empty() && count != 5 && count != 8 && count != 14)
    throw UserError(where, "distortion_model is empty, with " + std::to_string(count) + " coefficients",
                    "plumb_bob, rational_polynomial or equidistant");
  // Without a model name, five coefficients are those of plumb_bob, more are those of the rational polynomial.
  const bool plumb_bob =
      (model.empty() && count == 5) || model == "plumb_bob" || model == "radial-tangential" || model == "radtan";
  const bool rational = (model.empty() && count > 5) || model == "rational_polynomial";
  if (!plumb_bob && !rational && !fisheye) {
    throw UserError(
        where, "distortion model " + model,
        "plumb_bob, radial-tangential, rational_polynomial, equidistant (rectify images of other models first)");
  }
  const std::size_t used = fisheye ? 4 : 8;
  if (coefficients.size() < 4)
    throw UserError(where, std::to_string(coefficients.size()) + " distortion coefficients for " + model, "at least 4");
  for (std::size_t i = used; i < coefficients.size(); ++i)
    if (coefficients[i] != 0.0)
      throw UserError(
          where, "distortion coefficient " + std::to_string(i + 1) + " of " + model + " is not zero",
          "at most " + std::to_string(used) + " coefficients (thin prisms and tilted sensors are not supported)");
  if (fisheye) return equidistant({coefficients[0], coefficients[1], coefficients[2], coefficients[3]});
  std::array<double, 8> k{};
  std::copy_n(coefficients.begin(), std::min(coefficients.size(), k.size()), k.begin());
  return Distortion(k);
}

Distortion Distortion::equidistant(const std::array<double, 4>& coefficients) {
  Distortion distortion;
  std::copy(coefficients.begin(), coefficients.end(), distortion.k_.begin());
  distortion.equidistant_ = true;
  distortion.fold_radius_ = distortion.findFold();
  return distortion;
}

bool Distortion::isNone() const {
  return !equidistant_ && std::all_of(k_.begin(), k_.end(), [](double k) { return k == 0.0; });
}

Distortion::Radial Distortion::equidistantRadial(double r2) const {
  constexpr double kNearAxis = 1e-8;  // of r^2: below, atan is replaced by its series
  if (r2 < kNearAxis) return {1.0 + r2 * (k_[0] - 1.0 / 3.0), k_[0] - 1.0 / 3.0};
  const double r = std::sqrt(r2), a = std::atan(r), a2 = a * a;
  const double bent = a * (1.0 + a2 * (k_[0] + a2 * (k_[1] + a2 * (k_[2] + a2 * k_[3]))));
  const double slope =
      (1.0 + a2 * (3.0 * k_[0] + a2 * (5.0 * k_[1] + a2 * (7.0 * k_[2] + a2 * 9.0 * k_[3])))) / (1.0 + r2);
  return {bent / r, (slope * r - bent) / (2.0 * r2 * r)};
}

Distortion::Radial Distortion::radial(double r2) const {
  if (equidistant_) return equidistantRadial(r2);
  const double above = 1.0 + r2 * (k_[0] + r2 * (k_[1] + r2 * k_[4]));
  const double below = 1.0 + r2 * (k_[5] + r2 * (k_[6] + r2 * k_[7]));
  const double above_slope = k_[0] + r2 * (2.0 * k_[1] + r2 * 3.0 * k_[4]);
  const double below_slope = k_[5] + r2 * (2.0 * k_[6] + r2 * 3.0 * k_[7]);
  return {above / below, (above_slope * below - above * below_slope) / (below * below)};
}

double Distortion::findFold() const {
  // d(r f)/dr = f + 2 r^2 f'; the formula is also invalid from a zero of the denominator on.
  const auto rises = [this](double r) {
    const Radial at = radial(r * r);
    const double below = equidistant_ ? 1.0 : 1.0 + r * r * (k_[5] + r * r * (k_[6] + r * r * k_[7]));
    return below > 0.0 && at.factor > 0.0 && at.factor + 2.0 * r * r * at.slope > 0.0;
  };
  double good = 0.0;
  for (int i = 1; i <= kFoldSamples; ++i) {
    double bad = kLargestRadius * i / kFoldSamples;
    if (rises(bad)) {
      good = bad;
      continue;
    }
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (good + bad);
      (rises(middle) ? good : bad) = middle;
    }
    return good;
  }
  return kLargestRadius;
}

Eigen::Vector2d Distortion::formula(const Eigen::Vector2d& ideal) const {
  const double x = ideal.x(), y = ideal.y(), r2 = ideal.squaredNorm();
  const double p1 = equidistant_ ? 0.0 : k_[2], p2 = equidistant_ ? 0.0 : k_[3];
  const Eigen::Vector2d tangential(2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
                                   p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y);
  return radial(r2).factor * ideal + tangential;
}

std::optional<Eigen::Vector2d> Distortion::distort(const Eigen::Vector2d& ideal) const {
  if (!(ideal.squaredNorm() < fold_radius_ * fold_radius_)) return std::nullopt;
  return formula(ideal);
}

Eigen::Matrix2d Distortion::jacobian(const Eigen::Vector2d& ideal) const {
  const double x = ideal.x(), y = ideal.y();
  const double p1 = equidistant_ ? 0.0 : k_[2], p2 = equidistant_ ? 0.0 : k_[3];
  const Radial at = radial(ideal.squaredNorm());
  Eigen::Matrix2d tangential;
  tangential << 2.0 * p1 * y + 6.0 * p2 * x, 2.0 * p1 * x + 2.0 * p2 * y,  //
      2.0 * p1 * x + 2.0 * p2 * y, 6.0 * p1 * y + 2.0 * p2 * x;
  return at.factor * Eigen::Matrix2d::Identity() + 2.0 * at.slope * ideal * ideal.transpose() + tangential;
}

double Distortion::radiusSeenAt(double distorted_radius) const {
  double low = 0.0, high = fold_radius_;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (middle * radial(middle * middle).factor < distorted_radius ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::optional<Eigen::Vector2d> Distortion::undistort(const Eigen::Vector2d& distorted) const {
  const double radius = distorted.norm();
  if (!std::isfinite(radius)) return std::nullopt;
  if (radius == 0.0 && isNone()) return distorted;
  // The radial part gives an initial value on the right side of the fold; the tangential part is a small correction.
  Eigen::Vector2d ideal = radius > 0.0 ? Eigen::Vector2d(distorted * (radiusSeenAt(radius) / radius)) : distorted;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Eigen::Vector2d residual = distorted - formula(ideal);
    const Eigen::Matrix2d J = jacobian(ideal);
    const double determinant = J.determinant();
    if (!(determinant > 1e-9)) return std::nullopt;
    const Eigen::Vector2d step = J.inverse() * residual;
    ideal += step;
    if (step.norm() < kConverged * (1.0 + ideal.norm())) break;
  }
  const std::optional<Eigen::Vector2d> seen = distort(ideal);
  if (!seen || !((*seen - distorted).norm() < kAnswer * (1.0 + radius)) || !(jacobian(ideal).determinant() > 0.0))
    return std::nullopt;
  return ideal;
}

std::ostream& operator<<(std::ostream& out, const Distortion& distortion) {
  if (distortion.isNone()) return out << "no distortion";
  if (distortion.isEquidistant()) {
    out << "equidistant";
    for (std::size_t i = 0; i < 4; ++i) out << ", k" << i + 1 << " = " << distortion.coefficients()[i];
    return out;
  }
  const char* names[] = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
  const char* separator = "";
  for (std::size_t i = 0; i < 8; ++i) {
    if (i > 4 && distortion.coefficients()[i] == 0.0) continue;
    out << separator << names[i] << " = " << distortion.coefficients()[i];
    separator = ", ";
  }
  return out;
}

}  // namespace urban_nav_core
