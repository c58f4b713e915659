// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/free_trajectory.hpp"

#include <algorithm>
#include <utility>

#include "urban_nav_core/geometry/dense.hpp"

namespace laser_mapper {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs kLongestStretch = 300'000'000'000, kCorrectionSpacing = 1'000'000'000;

}  // namespace

std::vector<CalibrationInterval> divideTrajectory(const urban_nav_core::Trajectory& T_map_base) {
  std::vector<CalibrationInterval> intervals;
  if (T_map_base.size() < 2) return intervals;
  const StampNs begin = T_map_base.front().stamp, duration = T_map_base.back().stamp - begin + 1;
  const StampNs parts = (duration + kLongestStretch - 1) / kLongestStretch;
  for (StampNs i = 0; i < parts; ++i)
    intervals.push_back({begin + duration * i / parts, begin + duration * (i + 1) / parts});
  return intervals;
}

FreeTrajectory::FreeTrajectory(const urban_nav_core::Trajectory& T_map_base,
                               const urban_nav_core::OdometryChain* odometry, const CalibrationInterval& interval,
                               Index terms)
    : interval_(interval),
      terms_(terms),
      prior_(T_map_base, odometry, interval.begin,
             static_cast<std::size_t>((interval.end - interval.begin - 1) / kCorrectionSpacing) + 2),
      corrections_(prior_.count(), PoseCorrection::Zero()) {}

FreeTrajectory::Share FreeTrajectory::shareAt(StampNs stamp) const {
  const StampNs since = std::clamp(stamp, interval_.begin, interval_.end - 1) - interval_.begin;
  return {static_cast<std::uint32_t>(since / kCorrectionSpacing),
          static_cast<double>(since % kCorrectionSpacing) / static_cast<double>(kCorrectionSpacing)};
}

void FreeTrajectory::clear() {
  const auto size = static_cast<Index>(6 * corrections_.size());
  equations_ = zeroEquations(static_cast<std::size_t>(terms_ / kCalibrationTerms));
  information_.setZero(size, size);
  cross_.setZero(size, terms_);
  gradient_.setZero(size);
  places_.clear();
  prior_.addTo(corrections_, information_, gradient_);
}

void FreeTrajectory::add(PlaceEquations place) {
  equations_.information += place.information.topLeftCorner(terms_, terms_);
  equations_.gradient += place.gradient.head(terms_);
  ++equations_.patches;
  for (std::size_t i = 0; i < place.seconds.size(); ++i) {
    const Index to = 6 * place.seconds[i], from = terms_ + static_cast<Index>(6 * i);
    gradient_.segment<6>(to) += place.gradient.segment<6>(from);
    cross_.middleRows<6>(to) += place.information.block(from, 0, 6, terms_);
    for (std::size_t j = 0; j <= i; ++j)
      information_.block<6, 6>(to, 6 * place.seconds[j]) +=
          place.information.block<6, 6>(from, terms_ + static_cast<Index>(6 * j));
  }
  places_.push_back({std::move(place.seconds), std::move(place.gradient)});
}

TermEquations FreeTrajectory::eliminate() {
  per_term_ = std::move(cross_);
  change_ = std::move(gradient_);
  if (!urban_nav_core::choleskyInPlace(information_)) {
    per_term_.setZero();
    change_.setZero();
    return zeroEquations(static_cast<std::size_t>(terms_ / kCalibrationTerms));
  }
  urban_nav_core::solveLowerInPlace(information_, per_term_);
  urban_nav_core::solveLowerInPlace(information_, change_);
  TermEquations equations = std::move(equations_);
  equations.information -= per_term_.transpose() * per_term_;
  equations.gradient -= per_term_.transpose() * change_;
  urban_nav_core::solveLowerTransposedInPlace(information_, per_term_);
  urban_nav_core::solveLowerTransposedInPlace(information_, change_);
  equations.scatter = prior_.transformed(per_term_);
  for (const PlaceGradient& place : places_) {
    VectorXd gradient = place.gradient.head(terms_);
    for (std::size_t i = 0; i < place.seconds.size(); ++i)
      gradient -= per_term_.middleRows<6>(6 * place.seconds[i]).transpose() *
                  place.gradient.segment<6>(terms_ + static_cast<Index>(6 * i));
    equations.scatter += gradient * gradient.transpose();
  }
  return equations;
}

void FreeTrajectory::move(const VectorXd& change) {
  const VectorXd by = change_ - per_term_ * change;
  for (std::size_t k = 0; k < corrections_.size(); ++k) corrections_[k] += by.segment<6>(static_cast<Index>(6 * k));
}

}  // namespace laser_mapper
