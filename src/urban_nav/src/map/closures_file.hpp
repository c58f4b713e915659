// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav {

/// A row of closures.csv (docs/files.md): two moments that are one place, and what became of it.
struct ClosureRow {
  std::string session_a, session_b;
  urban_nav_core::StampNs stamp_a = 0, stamp_b = 0;
  double probability = 1.0;
  std::string kind = "none";  ///< stereo, icp, none
  std::string verdict;        ///< accepted, rejected
  std::string reason;
  std::optional<urban_nav_core::Pose> T_a_b;
  double sigma_m = 0.0, sigma_rad = 0.0;  ///< of the transform, each axis; 0 where the file does not say
  double weight = 0.0;
  std::string where;    ///< "closures.csv:12"
  std::int64_t id = 0;  ///< in the graph; 0: it did not take it
  /// What the stage loops found; none where a file or a store says it.
  std::optional<urban_nav_core::MetricClosure> measured;
};

/// The first five columns must be there; kind, x...qw, sigma_m and sigma_rad are taken where they are. UserError with
/// file and line.
std::vector<ClosureRow> readClosures(const std::string& path);
/// The same of a text; `name` stands for the path.
std::vector<ClosureRow> parseClosures(std::string_view text, const std::string& name);

/// With the header, in the order and the columns of docs/files.md.
std::string printClosures(const std::vector<ClosureRow>& rows);

}  // namespace urban_nav
