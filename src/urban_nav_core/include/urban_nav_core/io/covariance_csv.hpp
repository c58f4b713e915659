// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {

/// Row of covariance.csv: covariance of T_first_base in the axes of the first pose (convention of PoseWithCovariance).
struct CovarianceRow {
  StampNs stamp = 0;
  Health status = Health::Ok;
  Matrix6d covariance = Matrix6d::Zero();
};
/// Row of relative_covariance.csv: covariance of T_from_to.
struct RelativeCovarianceRow {
  StampNs from = 0;
  StampNs to = 0;
  Health status = Health::Ok;
  Matrix6d covariance = Matrix6d::Zero();
};

/// Return the header line with its line end. The 36 elements, row by row, are named c11...c66.
std::string covarianceHeader();
std::string relativeCovarianceHeader();
/// Returns a row with its line end. Numbers are read back bit-exactly.
std::string printCovarianceRow(const CovarianceRow& row);
std::string printCovarianceRow(const RelativeCovarianceRow& row);

/// Read the files. Throw UserError with file and line for invalid rows, and for matrices that are not symmetric to 1e-9
/// of their size or have a negative diagonal.
std::vector<CovarianceRow> readCovariances(const std::string& path);
std::vector<CovarianceRow> parseCovariances(std::string_view text, const std::string& name);
std::vector<RelativeCovarianceRow> parseRelativeCovariances(std::string_view text, const std::string& name);

}  // namespace urban_nav_core
