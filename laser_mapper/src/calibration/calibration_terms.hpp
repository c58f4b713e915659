// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "laser_mapper/calibration/laser_calibration.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace laser_mapper {

/// Terms of one laser, in the order of CalibrationTerm.
using TermVector = Eigen::Matrix<double, kCalibrationTerms, 1>;

inline double delaySeconds(const TermVector& terms) { return terms(0); }
inline urban_nav_core::Pose statedToTrue(const TermVector& terms) {
  return urban_nav_core::Pose(urban_nav_core::expSo3(terms.tail<3>()), terms.segment<3>(1));
}
/// Returns the terms after a small change, whose rotation is about the axes of the frame as stated.
inline TermVector changedTerms(const TermVector& terms, const TermVector& change) {
  TermVector changed = terms + change;
  changed.tail<3>() =
      urban_nav_core::logSo3(urban_nav_core::expSo3(change.tail<3>()) * urban_nav_core::expSo3(terms.tail<3>()));
  return changed;
}

}  // namespace laser_mapper
