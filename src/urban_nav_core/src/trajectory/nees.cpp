// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/nees.hpp"

#include <cassert>

#include "urban_nav_core/geometry/small_matrices.hpp"

namespace urban_nav_core {
namespace {

template <int N>
std::optional<double> normalised(const Eigen::Matrix<double, N, 1>& d, const Eigen::Matrix<double, N, N>& covariance) {
  const SmallCholesky<N> factored(covariance);
  if (!factored.succeeded() || !covariance.allFinite() || !d.allFinite()) return std::nullopt;
  return factored.whiten(d).squaredNorm();
}

}  // namespace

std::optional<double> nees(const Pose& truth, const PoseWithCovariance& estimate) {
  return normalised<6>(boxMinus(truth, estimate.pose), estimate.covariance);
}

std::optional<double> neesTranslation(const Pose& truth, const PoseWithCovariance& estimate) {
  return normalised<3>(boxMinus(truth, estimate.pose).head<3>(), estimate.covariance.topLeftCorner<3, 3>());
}

std::optional<double> neesRotation(const Pose& truth, const PoseWithCovariance& estimate) {
  return normalised<3>(boxMinus(truth, estimate.pose).tail<3>(), estimate.covariance.bottomRightCorner<3, 3>());
}

NeesSummary neesOfTrajectory(const std::vector<Pose>& truth, const std::vector<Pose>& estimate,
                             const std::vector<Matrix6d>& covariances) {
  assert(truth.size() == estimate.size() && truth.size() == covariances.size());
  NeesSummary summary;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Pose relative_truth = truth.front().inverse() * truth[i];
    const PoseWithCovariance relative{estimate.front().inverse() * estimate[i], covariances[i]};
    const auto all = nees(relative_truth, relative);
    const auto translation = neesTranslation(relative_truth, relative),
               rotation = neesRotation(relative_truth, relative);
    if (!all || !translation || !rotation) {
      ++summary.left_out;
      continue;
    }
    summary.mean += *all;
    summary.mean_translation += *translation;
    summary.mean_rotation += *rotation;
    ++summary.count;
  }
  if (summary.count == 0) return summary;
  const auto n = static_cast<double>(summary.count);
  summary.mean /= n;
  summary.mean_translation /= n;
  summary.mean_rotation /= n;
  summary.band = chiSquareMeanBand(6.0, n, 0.99);
  return summary;
}

}  // namespace urban_nav_core
