// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sqlite/connection.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_store {

/// UserError naming file and row where something is no number; `row`: "node 12 of session 3f...".
void refuseNotFinite(const Connection& connection, const std::string& row, const urban_nav_core::Pose& pose);
void refuseNotFinite(const Connection& connection, const std::string& row, const urban_nav_core::Matrix6d& matrix);
void refuseNotFinite(const Connection& connection, const std::string& row, double value);

}  // namespace urban_nav_store
