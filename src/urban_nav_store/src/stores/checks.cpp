// SPDX-License-Identifier: BSD-3-Clause
#include "stores/checks.hpp"

#include <cmath>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

using urban_nav_core::UserError;

void refuseNotFinite(const Connection& connection, const std::string& row, const urban_nav_core::Pose& pose) {
  if (!pose.isFinite() || !(std::abs(pose.q().norm() - 1.0) <= 0.01))
    throw UserError(connection.name(), row + " has a pose that is none", "finite numbers, a quaternion of length 1");
}

void refuseNotFinite(const Connection& connection, const std::string& row, const urban_nav_core::Matrix6d& matrix) {
  if (!matrix.allFinite())
    throw UserError(connection.name(), row + " has a matrix that is not finite", "finite numbers");
}

void refuseNotFinite(const Connection& connection, const std::string& row, double value) {
  if (!std::isfinite(value))
    throw UserError(connection.name(), row + " has a number that is not finite", "finite numbers");
}

}  // namespace urban_nav_store
