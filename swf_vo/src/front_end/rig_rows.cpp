// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/rig_rows.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/io/archive_types.hpp"

namespace swf_vo {

using urban_nav_core::SmallCholesky;

namespace {

// Landmarks: mounts and clocks drift slowly.
constexpr double kMemory = 20000.0;
// Prior of the standard deviation of a row difference, px, and its weight in matches.
constexpr double kFirstSigmaPx = 0.3;
constexpr double kFirstCount = 20.0;
constexpr double kLeastShareOfDepth = 0.1;  // minimum depth in the previous frame relative to that in the current one
constexpr double kHuber = 2.0;              // standard deviations
constexpr double kOffsetPriorPx = 10.0;     // uninformative: the offset is estimated by RowOffset
constexpr double kWidest = 0.8;             // limit of the cells, by direction
// Effective number of cells (Kish 1965) required for the sandwich estimator.
constexpr double kLeastCells = 6.0;
// Degrees of freedom of Student's t: most rigs are as well calibrated as their priors, and some are far off.
constexpr double kFreedom = 4.0;
constexpr int kIterations = 10;
constexpr double kFree = 1e-6;  // uninformative information, in units of the priors

}  // namespace

RigRows::RigRows(const Priors& priors, const urban_nav_core::StereoCamera& camera)
    : priors_(priors), camera_(camera), count_(kFirstCount), variance_(kFirstCount * kFirstSigmaPx * kFirstSigmaPx) {}

RigRows::Cell& RigRows::find(const Eigen::Vector2d& direction) {
  const auto place = [](double tangent, int count) {
    const double at = (std::clamp(tangent / kWidest, -1.0, 1.0) + 1.0) / 2.0 * count;
    return std::clamp(static_cast<int>(std::floor(at)), 0, count - 1);
  };
  return cells_[static_cast<std::size_t>(place(direction.y(), kRows) * kColumns + place(direction.x(), kColumns))];
}

void RigRows::see(const Difference& difference) {
  if (!std::isfinite(difference.px) || !difference.direction.allFinite() || !std::isfinite(difference.flow_px_s))
    return;
  const Vector3d along(1.0, -camera_.left.fx * difference.direction.x(), difference.flow_px_s);
  const double residual = difference.px - along.dot(estimate_), sigma = std::sqrt(variance_ / count_),
               size = std::abs(residual), weight = size > kHuber * sigma ? kHuber * sigma / size : 1.0;
  count_ += 1.0;
  variance_ += weight * residual * residual;
  for (Cell* cell : {&find(difference.direction), &all_}) {
    cell->information += weight * along * along.transpose();
    cell->right += weight * difference.px * along;
  }
}

void RigRows::learn(const urban_nav_core::Pose& T_last_now, double seconds, const std::vector<Observation>& fresh,
                    Tracks& tracks) {
  if (!(seconds > 0.0)) return;
  for (const Observation& observation : fresh) {
    const Vector3d& z = observation.z;
    const Vector3d ray = camera_.left.ray(z.head<2>());
    const double disparity = z.x() - z.z() - camera_.disparity_offset;
    const Vector3d then = T_last_now.q() * ray + T_last_now.t() * (disparity / (camera_.left.fx * camera_.baseline));
    if (!(then.z() > kLeastShareOfDepth)) continue;
    const double flow = camera_.left.fy * (ray.y() - then.y() / then.z()) / seconds;
    see({tracks.find(observation.landmark)->row_difference_px, ray.head<2>(), flow});
  }
  learn();
}

void RigRows::learn() {
  const double kept = std::min(1.0, kMemory / count_);
  count_ *= kept;
  variance_ *= kept;
  for (Cell& cell : cells_) cell.fade(kept);
  all_.fade(kept);
  const double variance = variance_ / count_;
  // Scaled by the priors, for conditioning.
  const Vector3d scale(kOffsetPriorPx, priors_.roll, priors_.delay_s);
  const Matrix3d measured = scale.asDiagonal() * all_.information * scale.asDiagonal() / variance;
  const Vector3d right = scale.cwiseProduct(all_.right) / variance;
  // Estimate from measurements only, apart from directions that they leave undetermined.
  const SmallCholesky<3> plain(Matrix3d(measured + kFree * Matrix3d::Identity()));
  if (!plain.succeeded()) return;
  const Vector3d alone = plain.solve(right);
  Matrix3d meat = Matrix3d::Zero();
  double squares = 0.0;
  for (const Cell& cell : cells_) {
    const Vector3d score = scale.cwiseProduct(cell.right - cell.information * scale.cwiseProduct(alone)) / variance;
    meat += score * score.transpose();
    squares += cell.information(0, 0) * cell.information(0, 0);
  }
  const double cells = squares > 0.0 ? all_.information(0, 0) * all_.information(0, 0) / squares : 0.0;
  const Matrix3d inverse = plain.inverse(), sandwich = inverse * meat * inverse, model = inverse * measured * inverse;
  double caution = 1.0;
  if (cells > kLeastCells)
    for (int i = 1; i < 3; ++i)
      if (measured(i, i) > kFree) caution = std::max(caution, cells / (cells - 3.0) * sandwich(i, i) / model(i, i));
  // Iterates from the prior, so that noise does not reduce its weight.
  Vector3d found = Vector3d::Zero();
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Vector3d prior(1.0, 1.0 / (1.0 + found[1] * found[1] / kFreedom),
                         1.0 / (1.0 + found[2] * found[2] / kFreedom));
    const SmallCholesky<3> cautious(Matrix3d(Matrix3d(prior.asDiagonal()) + measured / caution));
    if (!cautious.succeeded()) return;
    found = cautious.solve(Vector3d(right / caution));
    covariance_ = scale.asDiagonal() * cautious.inverse() * scale.asDiagonal();
  }
  estimate_ = scale.cwiseProduct(found);
}

RigConstants RigRows::evaluate() const {
  RigConstants constants;
  if (covariance_.isZero(0.0)) return constants;
  constants.roll_rad = estimate_[1];
  constants.roll_sigma_rad = std::sqrt(covariance_(1, 1));
  constants.delay_s = estimate_[2];
  constants.delay_sigma_s = std::sqrt(covariance_(2, 2));
  return constants;
}

void RigRows::Cell::fade(double kept) {
  information *= kept;
  right *= kept;
}

void RigRows::Cell::archive(urban_nav_core::Archive& archive) { archive(information, right); }

void RigRows::archive(urban_nav_core::Archive& archive) {
  for (Cell& cell : cells_) archive(cell);
  archive(all_, count_, variance_, estimate_, covariance_);
  archive.require(count_ > 0.0 && variance_ > 0.0, "invalid row variance");
}

}  // namespace swf_vo
