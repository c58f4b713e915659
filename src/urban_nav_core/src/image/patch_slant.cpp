// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "patch_kernel.hpp"

namespace urban_nav_core {

using namespace patch_kernel;

namespace {

constexpr double kAcrossReach = 4.0;  // px
constexpr int kMostRounds = 4;
constexpr double kSettledSlope = 0.01;
constexpr double kSteepestSlope = 0.9;

/// Normal equations of one iteration for (shift x, shift y, slant u, slant v).
struct Equations {
  Eigen::Matrix4d H;
  Eigen::Vector4d b;
  double noise2 = 1.0;  // variance of a weighted pixel
};

/// Builds the equations of the model that pixel p of the source maps to A p + direction (slant . p) in the view, at
/// alignment.position.
Equations observe(const ImageView& image, const PatchTemplate& patch, const Gradients& gradients,
                  const Alignment& alignment, const Eigen::Vector2d& direction) {
  PatchGrid pixels;
  readWindow(image, alignment.position.x(), alignment.position.y(), patch.view_blur, pixels);
  const Eigen::Matrix2f back = patch.warp.A.inverse().cast<float>();
  const Eigen::Vector2f d = direction.cast<float>();
  std::array<PatchGrid, 4> J{gradients.x, gradients.y, {}, {}}, blind;
  for (int v = 0; v < kPatchSize; ++v)
    for (int u = 0; u < kPatchSize; ++u) {
      const std::size_t at = static_cast<std::size_t>(v * kPatchStride + u);
      const Eigen::Vector2f p =
          back * Eigen::Vector2f(static_cast<float>(u - kPatchRadius), static_cast<float>(v - kPatchRadius));
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
  // correlation of adjacent pixels by the spline costs about a factor of two
  const double g2 = alignment.gain * alignment.gain;
  made.noise2 = 2.0 * std::max(alignment.noise * alignment.noise, 0.5) * kSmoothedNoise * (1.0 + g2) / g2;
  return made;
}

/// Adds the information on the slopes, with the shift marginalised. `assumed`: the slopes of the template.
void see(const Equations& equations, const Eigen::Vector2d& assumed, Slope& slope) {
  const Eigen::Matrix2d coupling = equations.H.block<2, 2>(2, 0) * equations.H.block<2, 2>(0, 0).inverse();
  const Eigen::Matrix2d information =
      (equations.H.block<2, 2>(2, 2) - coupling * equations.H.block<2, 2>(0, 2)) / equations.noise2;
  const Eigen::Vector2d ahead = (equations.b.tail<2>() - coupling * equations.b.head<2>()) / equations.noise2;
  if (information.allFinite() && ahead.allFinite()) slope.see(ahead + information * assumed, information);
}

}  // namespace

SlopedAlignment alignAcross(const ImageView& image, const PatchSource& source, const Eigen::Vector2d& start,
                            double usual_slope, PatchTemplate& made) {
  SlopedAlignment result;
  Eigen::Vector2d position = start;
  for (int round = 0; round < kMostRounds; ++round) {
    Eigen::Matrix2d A;
    A << 1.0 - result.slopes.x(), -result.slopes.y(), 0.0, 1.0;
    Gradients gradients;
    result.alignment.converged = false;
    if (!makeTemplate(source, A, made, gradients)) return result;
    const Alignment found = alignPatch(image, made, position, kAcrossReach);
    if (!found.converged || (found.position - start).norm() > kAcrossReach ||
        !fits(image, found.position.x(), found.position.y()))
      return result;
    result.alignment = found;

    const Equations equations = observe(image, made, gradients, found, {-1.0, 0.0});
    result.seen = {};
    see(equations, result.slopes, result.seen);
    const Slope::Estimate estimate = result.seen.under(usual_slope);
    const Eigen::Vector2d change = estimate.mean - result.slopes;
    if (!change.allFinite()) {
      result.alignment.converged = false;
      return result;
    }
    // propagates the uncertainty of the slopes to the shift
    const Eigen::Matrix2d inverse = equations.H.block<2, 2>(0, 0).inverse(),
                          coupling = inverse * equations.H.block<2, 2>(0, 2);
    result.alignment.covariance += 0.5 * coupling * estimate.covariance * coupling.transpose();
    if (round + 1 == kMostRounds || change.cwiseAbs().maxCoeff() < kSettledSlope) break;
    result.slopes += change;
    if (result.slopes.cwiseAbs().maxCoeff() > kSteepestSlope) {
      result.alignment.converged = false;
      return result;
    }
    position = found.position - inverse * equations.b.head<2>() + coupling * change;
  }
  return result;
}

void seeSlant(const ImageView& image, const PatchSource& source, const PatchTemplate& patch, const Alignment& alignment,
              const Eigen::Vector2d& direction, const Eigen::Vector2d& assumed, Slope& slant) {
  PatchTemplate again;
  Gradients gradients;
  if (alignment.converged && fits(image, alignment.position.x(), alignment.position.y()) &&
      makeTemplate(source, patch.warp, again, gradients))
    see(observe(image, again, gradients, alignment, direction), assumed, slant);
}

}  // namespace urban_nav_core
