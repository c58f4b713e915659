// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/calibration_stretch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double kHeldOutReach = 0.5;                       // m between surfels of a held-out place
constexpr double kRobust = 2.5 * 1.48, kLeastScale = 0.01;  // of the median spread; m
constexpr std::size_t kPatchBatch = 512;                    // places whose equations are in memory at a time

double patchSpread(const CalibrationPatch& patch, const std::vector<CalibrationSurfel>& surfels) {
  double sum = 0.0, weights = 0.0;
  const std::vector<double> offsets = surfelOffsets(patch, surfels);
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const double weight = surfels[patch.surfels[i]].beams();
    sum += weight * offsets[i] * offsets[i];
    weights += weight;
  }
  return std::sqrt(sum / weights);
}

double medianSpread(const std::vector<CalibrationPatch>& patches, const std::vector<CalibrationSurfel>& surfels) {
  std::vector<double> spreads;
  for (const CalibrationPatch& patch : patches) spreads.push_back(patchSpread(patch, surfels));
  if (spreads.empty()) return 0.0;
  std::nth_element(spreads.begin(), spreads.begin() + static_cast<std::ptrdiff_t>(spreads.size() / 2), spreads.end());
  return spreads[spreads.size() / 2];
}

// Columns of a beam's row: terms of its laser, correction at the beginning and at the end of its second, plane,
// residual.
constexpr int kCorrections = kCalibrationTerms, kPlane = kCorrections + 12, kResidual = kPlane + 3,
              kColumns = kResidual + 1;
using Row = Eigen::Matrix<double, kColumns, 1>;
using RowProducts = Eigen::Matrix<double, kColumns, kColumns>;

/// Row of the distance of a beam's end from the plane of a place.
Row beamRow(const CalibrationPatch& patch, const Vector3d& u, const Vector3d& v, const ScanPlace& place,
            const SampledScans::Beam& beam) {
  const Vector3d& n = patch.normal;
  const Vector3d m = place.fromRobot(beam);
  const Vector3d d = place.inMap(beam) - patch.centre;
  const Vector3d n_stated = place.R_map_stated.transpose() * n;
  const Vector3d ray_stated = place.R_map_stated.transpose() * (place.R_map_laser * beam.ray.cast<double>());
  const Vector3d turn = m.cross(n);
  Row row;
  row(0) = -n.dot(place.velocity + place.turn_rate.cross(m));
  row.segment<3>(1) = n_stated;
  row.segment<3>(4) = ray_stated.cross(n_stated);
  row.segment<3>(kCorrections) = (1.0 - place.share) * n;
  row.segment<3>(kCorrections + 3) = (1.0 - place.share) * turn;
  row.segment<3>(kCorrections + 6) = place.share * n;
  row.segment<3>(kCorrections + 9) = place.share * turn;
  row.segment<3>(kPlane) << 1.0, u.dot(d), v.dot(d);
  row(kResidual) = n.dot(d);
  return row;
}

/// Returns the sum of the products of the rows of a surfel's beams.
RowProducts surfelProducts(const SampledScans& samples, const CalibrationPatch& patch, const CalibrationSurfel& surfel,
                           const SurfelSet& set, const std::vector<ScanPlace>& places) {
  const Vector3d u = patch.normal.unitOrthogonal(), v = patch.normal.cross(u);
  RowProducts products = RowProducts::Zero();
  for (std::uint32_t beam = surfel.first; beam < surfel.last; ++beam) {
    const SampledScans::Beam& sampled = samples.beams[set.beams[beam]];
    const Row row = beamRow(patch, u, v, places[sampled.scan], sampled);
    products.noalias() += row * row.transpose();
  }
  return products;
}

/// Beams of one surfel share the constant error of the laser: more of them do not lower it. `ratio`: of its offset over
/// the robust scale.
double surfelWeight(const Parameters& parameters, const CalibrationSurfel& surfel, double ratio) {
  const double noise = std::max(surfel.thickness, parameters.range_sigma), bias = parameters.range_bias;
  return 1.0 / ((noise * noise + surfel.beams() * bias * bias) * (1.0 + ratio * ratio));
}

}  // namespace

/// Equations of one place without its plane: all terms, then the corrections at `seconds`, 6 each.
struct CalibrationStretch::PatchEquations {
  std::vector<std::uint32_t> seconds;
  MatrixXd information;
  VectorXd gradient;
};

/// Equations of all terms and corrections.
struct CalibrationStretch::FullEquations {
  TermEquations terms;
  MatrixXd corrections, cross;  // lower triangle; rows of corrections, columns of terms
  VectorXd gradient;            // of corrections

  void add(const PatchEquations& patch) {
    const Eigen::Index n = terms.gradient.size();
    terms.information += patch.information.topLeftCorner(n, n);
    terms.gradient += patch.gradient.head(n);
    ++terms.patches;
    for (std::size_t i = 0; i < patch.seconds.size(); ++i) {
      const Eigen::Index to = 6 * patch.seconds[i], from = n + static_cast<Eigen::Index>(6 * i);
      gradient.segment<6>(to) += patch.gradient.segment<6>(from);
      cross.middleRows<6>(to) += patch.information.block(from, 0, 6, n);
      for (std::size_t j = 0; j <= i; ++j)
        corrections.block<6, 6>(to, 6 * patch.seconds[j]) +=
            patch.information.block<6, 6>(from, n + static_cast<Eigen::Index>(6 * j));
    }
  }
};

CalibrationStretch::CalibrationStretch(const Parameters& parameters, const std::vector<MountedLaser>& lasers,
                                       const urban_nav_core::Trajectory& T_map_base,
                                       const urban_nav_core::OdometryChain* odometry, SampledScans samples)
    : parameters_(parameters),
      lasers_(lasers),
      T_map_base_(T_map_base),
      samples_(std::move(samples)),
      prior_(T_map_base, odometry, samples_.begin,
             static_cast<std::size_t>((samples_.end - samples_.begin - 1) / 1'000'000'000) + 2),
      corrections_(prior_.count(), PoseCorrection::Zero()) {}

std::vector<ScanPlace> CalibrationStretch::placesWith(const std::vector<TermVector>& terms,
                                                      const std::vector<PoseCorrection>& corrections) const {
  return placeScans(samples_, lasers_, terms, T_map_base_, corrections, std::llround(1e9 * parameters_.max_gap));
}

CalibrationStretch::PatchEquations CalibrationStretch::equationsOf(const CalibrationPatch& patch, const SurfelSet& set,
                                                                   const std::vector<ScanPlace>& places,
                                                                   double scale) const {
  PatchEquations equations;
  std::vector<std::uint32_t>& seconds = equations.seconds;
  for (const std::uint32_t s : patch.surfels)
    for (const std::uint32_t second : {set.surfels[s].window, set.surfels[s].window + 1}) seconds.push_back(second);
  std::sort(seconds.begin(), seconds.end());
  seconds.erase(std::unique(seconds.begin(), seconds.end()), seconds.end());
  const Eigen::Index size = termCount() + static_cast<Eigen::Index>(6 * seconds.size());
  MatrixXd H = MatrixXd::Zero(size + 3, size + 3);
  VectorXd b = VectorXd::Zero(size + 3);
  const std::vector<double> offsets = surfelOffsets(patch, set.surfels);
  for (std::size_t i = 0; i < patch.surfels.size(); ++i) {
    const CalibrationSurfel& surfel = set.surfels[patch.surfels[i]];
    const double weight = surfelWeight(parameters_, surfel, offsets[i] / scale);
    const RowProducts products = weight * surfelProducts(samples_, patch, surfel, set, places);
    const auto slot = std::lower_bound(seconds.begin(), seconds.end(), surfel.window) - seconds.begin();
    const Eigen::Index to[3] = {kCalibrationTerms * surfel.laser, termCount() + 6 * slot, size};
    const int from[4] = {0, kCorrections, kPlane, kResidual};
    for (int r = 0; r < 3; ++r) {
      const int rows = from[r + 1] - from[r];
      for (int c = 0; c < 3; ++c)
        H.block(to[r], to[c], rows, from[c + 1] - from[c]) +=
            products.block(from[r], from[c], rows, from[c + 1] - from[c]);
      b.segment(to[r], rows) -= products.block(from[r], kResidual, rows, 1);
    }
  }
  const Eigen::Matrix3d plane =
      urban_nav_core::SmallCholesky<3>(Eigen::Matrix3d(H.bottomRightCorner<3, 3>())).inverse();
  const MatrixXd share = H.topRightCorner(size, 3) * plane;
  equations.information = H.topLeftCorner(size, size) - share * H.bottomLeftCorner(3, size);
  equations.gradient = b.head(size) - share * b.tail<3>();
  if (!equations.information.allFinite() || !equations.gradient.allFinite()) {
    equations.information.setZero();
    equations.gradient.setZero();
  }
  return equations;
}

TermEquations CalibrationStretch::linearise(const std::vector<TermVector>& terms, double reach) {
  const std::vector<ScanPlace> places = placesWith(terms, corrections_);
  const SurfelSet set = findSurfels(samples_, places);
  std::vector<CalibrationPatch> patches = matchSurfels(set.surfels, reach);
  patches.erase(std::remove_if(patches.begin(), patches.end(), [](const auto& patch) { return patch.is_held_out; }),
                patches.end());
  const double scale = std::max(kLeastScale, kRobust * medianSpread(patches, set.surfels));
  const auto size = static_cast<Eigen::Index>(6 * corrections_.size());
  FullEquations all{zeroEquations(lasers_.size()), MatrixXd::Zero(size, size), MatrixXd::Zero(size, termCount()),
                    VectorXd::Zero(size)};
  prior_.addTo(corrections_, all.corrections, all.gradient);
  std::vector<PatchEquations> equations(patches.size());
  for (std::size_t first = 0; first < patches.size(); first += kPatchBatch) {
    const std::size_t count = std::min(kPatchBatch, patches.size() - first);
    urban_nav_core::forEach(
        count, 16, [&](std::size_t i) { equations[first + i] = equationsOf(patches[first + i], set, places, scale); });
    for (std::size_t i = first; i < first + count; ++i) {
      all.add(equations[i]);
      equations[i].information.resize(0, 0);
    }
  }
  return eliminateTrajectory(std::move(all), equations);
}

TermEquations CalibrationStretch::eliminateTrajectory(FullEquations all, const std::vector<PatchEquations>& patches) {
  const Eigen::Index terms = termCount();
  per_term_ = std::move(all.cross);
  trajectory_change_ = std::move(all.gradient);
  if (!urban_nav_core::choleskyInPlace(all.corrections)) {
    per_term_.setZero();
    trajectory_change_.setZero();
    return zeroEquations(lasers_.size());
  }
  urban_nav_core::solveLowerInPlace(all.corrections, per_term_);
  urban_nav_core::solveLowerInPlace(all.corrections, trajectory_change_);
  all.terms.information -= per_term_.transpose() * per_term_;
  all.terms.gradient -= per_term_.transpose() * trajectory_change_;
  urban_nav_core::solveLowerTransposedInPlace(all.corrections, per_term_);
  urban_nav_core::solveLowerTransposedInPlace(all.corrections, trajectory_change_);
  all.terms.scatter = prior_.transformed(per_term_);
  for (const PatchEquations& patch : patches) {
    VectorXd gradient = patch.gradient.head(terms);
    for (std::size_t i = 0; i < patch.seconds.size(); ++i)
      gradient -= per_term_.middleRows<6>(6 * patch.seconds[i]).transpose() *
                  patch.gradient.segment<6>(terms + static_cast<Eigen::Index>(6 * i));
    all.terms.scatter += gradient * gradient.transpose();
  }
  return all.terms;
}

void CalibrationStretch::moveTrajectory(const VectorXd& change) {
  const VectorXd move = trajectory_change_ - per_term_ * change;
  for (std::size_t k = 0; k < corrections_.size(); ++k)
    corrections_[k] += move.segment<6>(static_cast<Eigen::Index>(6 * k));
}

std::vector<CalibrationStretch::Spread> CalibrationStretch::compareHeldOut(const std::vector<TermVector>& terms) const {
  const std::vector<PoseCorrection> none(corrections_.size(), PoseCorrection::Zero());
  const std::vector<TermVector> stated(lasers_.size(), TermVector::Zero());
  SurfelSet set = findSurfels(samples_, placesWith(stated, none));
  std::vector<CalibrationPatch> patches = matchSurfels(set.surfels, kHeldOutReach);
  patches.erase(std::remove_if(patches.begin(), patches.end(), [](const auto& patch) { return !patch.is_held_out; }),
                patches.end());
  std::vector<Spread> spreads;
  for (const CalibrationPatch& patch : patches) spreads.push_back({patchSpread(patch, set.surfels), 0.0});
  moveSurfels(samples_, placesWith(terms, none), set);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    updatePatch(set.surfels, patches[i]);
    spreads[i].calibrated = patchSpread(patches[i], set.surfels);
  }
  return spreads;
}

}  // namespace laser_mapper
