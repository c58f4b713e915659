// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/calibration_stretch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double kHeldOutReach = 0.5;                       // m between surfels of a held-out place
constexpr double kRobust = 2.5 * 1.48, kLeastScale = 0.01;  // factor of the median spread; m
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

// Columns of a beam's row: terms of its laser, corrections at the beginning and at the end of its second, plane,
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

/// Returns the weight of a surfel. Its beams share the constant error of the laser, which their number does not reduce.
/// `ratio`: of its offset to the robust scale.
double surfelWeight(const Parameters& parameters, const CalibrationSurfel& surfel, double ratio) {
  const double noise = std::max(surfel.thickness, parameters.range_sigma), bias = parameters.range_bias;
  return 1.0 / ((noise * noise + surfel.beams() * bias * bias) * (1.0 + ratio * ratio));
}

}  // namespace

CalibrationStretch::CalibrationStretch(const Parameters& parameters, const std::vector<MountedLaser>& lasers,
                                       const urban_nav_core::Trajectory& T_map_base,
                                       const urban_nav_core::OdometryChain* odometry, SampledScans samples)
    : parameters_(parameters),
      lasers_(lasers),
      T_map_base_(T_map_base),
      samples_(std::move(samples)),
      trajectory_(T_map_base, odometry, {samples_.begin, samples_.end}, termCount()) {}

std::vector<ScanPlace> CalibrationStretch::placesWith(const std::vector<TermVector>& terms,
                                                      const std::vector<PoseCorrection>& corrections) const {
  return placeScans(samples_, lasers_, terms, T_map_base_, corrections, std::llround(1e9 * parameters_.max_gap));
}

/// Returns the equations with the plane of the place eliminated.
PlaceEquations CalibrationStretch::linearisePatch(const CalibrationPatch& patch, const SurfelSet& set,
                                                  const std::vector<ScanPlace>& places, double scale) const {
  PlaceEquations equations;
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
  const std::vector<ScanPlace> places = placesWith(terms, trajectory_.corrections());
  const SurfelSet set = findSurfels(samples_, places);
  std::vector<CalibrationPatch> patches = matchSurfels(set.surfels, reach);
  patches.erase(std::remove_if(patches.begin(), patches.end(), [](const auto& patch) { return patch.is_held_out; }),
                patches.end());
  const double scale = std::max(kLeastScale, kRobust * medianSpread(patches, set.surfels));
  trajectory_.clear();
  std::vector<PlaceEquations> equations(std::min(kPatchBatch, patches.size()));
  for (std::size_t first = 0; first < patches.size(); first += kPatchBatch) {
    const std::size_t count = std::min(kPatchBatch, patches.size() - first);
    urban_nav_core::forEach(
        count, 16, [&](std::size_t i) { equations[i] = linearisePatch(patches[first + i], set, places, scale); });
    for (std::size_t i = 0; i < count; ++i) trajectory_.add(std::move(equations[i]));
  }
  return trajectory_.eliminate();
}

std::vector<CalibrationStretch::Spread> CalibrationStretch::compareHeldOut(const std::vector<TermVector>& terms) const {
  const std::vector<PoseCorrection> none(trajectory_.corrections().size(), PoseCorrection::Zero());
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
