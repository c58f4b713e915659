// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "calibration/calibration_stretch.hpp"
#include "calibration/term_equations.hpp"
#include "laser_mapper/calibration/laser_calibration.hpp"

namespace laser_mapper {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// m between surfels of one place: initially allows for errors of the calibration, then for the remaining ones.
constexpr double kReaches[] = {0.5, 0.4, 0.3, 0.2, 0.15, 0.1, 0.1, 0.1, 0.1, 0.1};
constexpr int kRefinements = 4;
constexpr double kLastReach = 0.1;     // m
constexpr double kBeyondChance = 3.0;  // standard errors of significance

/// Estimation of the terms of all lasers of a session.
class Calibrator {
 public:
  Calibrator(const Parameters& parameters, urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
             const urban_nav_core::Trajectory& T_map_base, const urban_nav_core::OdometryChain* odometry)
      : lasers_(statedLasers(store, session)), terms_(lasers_.size(), TermVector::Zero()) {
    for (const CalibrationInterval& interval : divideTrajectory(T_map_base))
      stretches_.push_back(std::make_unique<CalibrationStretch>(
          parameters, lasers_, T_map_base, odometry,
          sampleScans(parameters, store, session, lasers_, interval.begin, interval.end)));
  }

  const std::vector<MountedLaser>& lasers() const { return lasers_; }
  const std::vector<TermVector>& terms() const { return terms_; }
  std::size_t places() const { return places_; }

  /// Estimates the terms in `wanted`; the others remain zero.
  TermEstimate estimate(const std::vector<bool>& wanted) {
    for (std::size_t i = 0; i < terms_.size(); ++i)
      for (int t = 0; t < kCalibrationTerms; ++t)
        if (!wanted[kCalibrationTerms * i + static_cast<std::size_t>(t)]) terms_[i](t) = 0.0;
    const bool all = std::all_of(wanted.begin(), wanted.end(), [](bool is_wanted) { return is_wanted; });
    const int iterations = all ? static_cast<int>(std::size(kReaches)) : kRefinements;
    TermEstimate estimate;
    for (int i = 0; i < iterations; ++i) {
      const double reach = all ? kReaches[i] : kLastReach;
      const std::optional<TermStep> moved = step(wanted, reach);
      if (!moved) break;
      estimate = moved->estimate;
      if (reach <= kLastReach && isConverged(*moved)) break;
    }
    return estimate;
  }

  std::vector<CalibrationStretch::Spread> compareHeldOut() const {
    std::vector<CalibrationStretch::Spread> all;
    for (const auto& stretch : stretches_) {
      const auto part = stretch->compareHeldOut(terms_);
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }

 private:
  VectorXd stacked() const {
    VectorXd all(static_cast<Index>(kCalibrationTerms * terms_.size()));
    for (std::size_t i = 0; i < terms_.size(); ++i)
      all.segment<kCalibrationTerms>(static_cast<Index>(kCalibrationTerms * i)) = terms_[i];
    return all;
  }

  /// One Gauss-Newton step of terms and trajectory.
  std::optional<TermStep> step(const std::vector<bool>& wanted, double reach) {
    TermEquations equations = zeroEquations(lasers_.size());
    for (const auto& stretch : stretches_) equations += stretch->linearise(terms_, reach);
    places_ = equations.patches;
    std::optional<TermStep> step = solveTerms(std::move(equations), stacked(), wanted);
    if (!step) return std::nullopt;
    for (std::size_t i = 0; i < terms_.size(); ++i)
      terms_[i] = step->estimate.mean.segment<kCalibrationTerms>(static_cast<Index>(kCalibrationTerms * i));
    for (const auto& stretch : stretches_) stretch->moveTrajectory(step->change);
    return step;
  }

  const std::vector<MountedLaser> lasers_;
  std::vector<TermVector> terms_;
  std::vector<std::unique_ptr<CalibrationStretch>> stretches_;
  std::size_t places_ = 0;
};

void adoptByHeldOut(const std::vector<CalibrationStretch::Spread>& spreads, CalibrationResult& result) {
  result.held_out = spreads.size();
  if (spreads.size() < 2) return;
  const auto count = static_cast<double>(spreads.size());
  double square = 0.0;
  for (const CalibrationStretch::Spread& spread : spreads) {
    const double difference = spread.stated - spread.calibrated;
    result.stated_spread += spread.stated / count;
    result.calibrated_spread += spread.calibrated / count;
    result.improvement += difference / count;
    square += difference * difference / count;
  }
  result.improvement_sigma = std::sqrt(std::max(0.0, square - result.improvement * result.improvement) / (count - 1.0));
  result.improves = result.improvement > kBeyondChance * result.improvement_sigma && result.improvement > 0.0;
}

}  // namespace

CalibrationResult calibrateLasers(const Parameters& parameters, urban_nav_store::Store& store,
                                  const urban_nav_store::SessionId& session,
                                  const urban_nav_core::Trajectory& T_map_base,
                                  const urban_nav_core::OdometryChain* odometry) {
  CalibrationResult result;
  Calibrator calibrator(parameters, store, session, T_map_base, odometry);
  const std::size_t terms = kCalibrationTerms * calibrator.lasers().size();
  if (terms == 0 || T_map_base.size() < 2) return result;
  const TermSelection selected =
      selectTerms(terms, [&](const std::vector<bool>& wanted) { return calibrator.estimate(wanted); });
  if (selected.all.mean.size() == 0) return result;
  result.places = calibrator.places();
  result.unconstrained = describeUnconstrained(selected.all, calibrator.lasers());
  result.is_significant = selected.holdsAny();
  adoptByHeldOut(calibrator.compareHeldOut(), result);
  for (std::size_t i = 0; i < calibrator.lasers().size(); ++i)
    result.lasers.push_back(selected.device(i, calibrator.lasers()[i].frame, result.isAdopted()));
  return result;
}

}  // namespace laser_mapper
