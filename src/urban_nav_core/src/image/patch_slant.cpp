// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "patch_kernel.hpp"

namespace urban_nav_core {

using namespace patch_kernel;

namespace {

constexpr double insistence = 6.0;    // chi-square by which pixels must speak for an unusual slope
constexpr double across_reach = 4.0;  // px
constexpr int most_rounds = 4;
constexpr double settled_slope = 0.01;
constexpr double steepest_slope = 0.9;

/// What pixels say of (shift x, shift y, slant u, slant v): normal equations of one step.
struct Equations {
  Eigen::Matrix4d H;
  Eigen::Vector4d b;
  double noise2 = 1.0;  // variance of a weighted pixel
};

/// A pixel p of the source stands at A p + direction (slant . p) in the view; alignment.position is where the image was aligned.
Equations observe(const ImageView& image, const PatchTemplate& patch, const Gradients& gradients,
                  const Alignment& alignment, const Eigen::Vector2d& direction) {
  PatchGrid pixels;
  readWindow(image, alignment.position.x(), alignment.position.y(), patch.view_blur, pixels);
  const Eigen::Matrix2f back = patch.A.inverse().cast<float>();
  const Eigen::Vector2f d = direction.cast<float>();
  std::array<PatchGrid, 4> J{gradients.x, gradients.y, {}, {}}, blind;
  for (int v = 0; v < patch_size; ++v)
    for (int u = 0; u < patch_size; ++u) {
      const std::size_t at = static_cast<std::size_t>(v * patch_stride + u);
      const Eigen::Vector2f p =
          back * Eigen::Vector2f(static_cast<float>(u - patch_radius), static_cast<float>(v - patch_radius));
      const float slope = -(gradients.x[at] * d.x() + gradients.y[at] * d.y());
      J[2][at] = slope * p.x();
      J[3][at] = slope * p.y();
    }
  Equations made;
  for (std::size_t i = 0; i < 4; ++i) makeBlind(J[i], patch, blind[i]);
  for (int i = 0; i < 4; ++i) {
    made.b(i) = dot(blind[static_cast<std::size_t>(i)], pixels) / alignment.gain;
    for (int j = 0; j < 4; ++j) made.H(i, j) = dot(blind[static_cast<std::size_t>(i)], J[static_cast<std::size_t>(j)]);
  }
  // the spline's correlation between neighbours costs about a factor of two
  const double g2 = alignment.gain * alignment.gain;
  made.noise2 = 2.0 * std::max(alignment.noise * alignment.noise, 0.5) * smoothed_noise * (1.0 + g2) / g2;
  return made;
}

struct SlopeStep {
  Eigen::Matrix4d inverse;
  Eigen::Vector4d step;
  double cost = 0.0;  // chi-square of residual and prior, up to a constant
};

/// One step under a Gaussian prior of the slopes about zero.
SlopeStep solve(const Equations& equations, const Eigen::Vector2d& slopes, double sigma) {
  const double weight = equations.noise2 / (sigma * sigma);
  Eigen::Matrix4d H = equations.H;
  Eigen::Vector4d b = equations.b;
  H.block<2, 2>(2, 2) += weight * Eigen::Matrix2d::Identity();
  b.tail<2>() -= weight * slopes;
  SlopeStep made;
  made.inverse = H.inverse();
  made.step = made.inverse * b;
  const double residual = made.step.dot(equations.H * made.step) - 2.0 * equations.b.dot(made.step);
  made.cost = (residual + weight * (slopes + made.step.tail<2>()).squaredNorm()) / equations.noise2;
  return made;
}

}  // namespace

SlopedAlignment alignAcross(const ImageView& image, const PatchSource& source, const Eigen::Vector2d& start,
                            const SlopePrior& prior, PatchTemplate& made) {
  SlopedAlignment result;
  Eigen::Vector2d position = start;
  for (int round = 0; round < most_rounds; ++round) {
    Eigen::Matrix2d A;
    A << 1.0 - result.slopes.x(), -result.slopes.y(), 0.0, 1.0;
    Gradients gradients;
    result.alignment.converged = false;
    if (!makeTemplate(source, A, made, gradients)) return result;
    const Alignment found = alignPatch(image, made, position, across_reach);
    if (!found.converged || (found.position - start).norm() > across_reach ||
        !fits(image, found.position.x(), found.position.y()))
      return result;
    result.alignment = found;

    const Equations equations = observe(image, made, gradients, found, {-1.0, 0.0});
    const SlopeStep usual = solve(equations, result.slopes, prior.usual_sigma),
                    wide = solve(equations, result.slopes, prior.wide_sigma);
    const SlopeStep& chosen = usual.cost - wide.cost > insistence ? wide : usual;
    if (!chosen.step.allFinite()) {
      result.alignment.converged = false;
      return result;
    }
    result.slopes_covariance = equations.noise2 * chosen.inverse.block<2, 2>(2, 2);
    // the shift's covariance grows by what the slopes leave open
    const Eigen::Matrix2d opened = chosen.inverse.block<2, 2>(0, 0) - equations.H.block<2, 2>(0, 0).inverse();
    result.alignment.covariance += 0.5 * equations.noise2 * opened;
    const Eigen::Vector2d change = chosen.step.tail<2>();
    if (round + 1 == most_rounds || change.cwiseAbs().maxCoeff() < settled_slope) break;
    result.slopes += change;
    if (result.slopes.cwiseAbs().maxCoeff() > steepest_slope) {
      result.alignment.converged = false;
      return result;
    }
    position = found.position - chosen.step.head<2>();
  }
  return result;
}

Slant refineSlant(const ImageView& image, const PatchSource& source, const PatchTemplate& patch,
                  const Alignment& alignment, const Eigen::Vector2d& direction, const Eigen::Matrix2d& information) {
  Slant slant;
  slant.information = information;
  PatchTemplate again;
  Gradients gradients;
  if (!alignment.converged || !fits(image, alignment.position.x(), alignment.position.y()) ||
      !makeTemplate(source, patch.A, again, gradients))
    return slant;
  const Equations equations = observe(image, again, gradients, alignment, direction);
  const Eigen::Matrix2d coupling = equations.H.block<2, 2>(2, 0) * equations.H.block<2, 2>(0, 0).inverse();
  const Eigen::Matrix2d seen =
      (equations.H.block<2, 2>(2, 2) - coupling * equations.H.block<2, 2>(0, 2)) / equations.noise2;
  const Eigen::Vector2d right = (equations.b.tail<2>() - coupling * equations.b.head<2>()) / equations.noise2;
  const Eigen::Matrix2d sum = information + 0.5 * (seen + seen.transpose());
  const Eigen::Vector2d change = sum.ldlt().solve(right);
  if (!change.allFinite() || !sum.allFinite()) return slant;
  slant.change = change;
  slant.information = sum;
  return slant;
}

}  // namespace urban_nav_core
