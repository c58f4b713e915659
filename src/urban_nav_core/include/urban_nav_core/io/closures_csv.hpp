// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/types/closure.hpp"

namespace urban_nav_core {

/// Row of closures.csv (docs/files.md): two times that may show the same place, the transform between them, and the
/// verdict on it.
struct ClosureRow {
  PoseRef a, b;                                ///< sessions by their names, or as numbers in the order of the inputs
  double probability = 1.0;                    ///< probability that both times show the same place
  ClosureMethod method = ClosureMethod::None;  ///< column `kind`
  std::optional<ClosureVerdict> verdict;       ///< nullopt: no verdict yet
  std::string reason;                          ///< reason of the verdict
  std::optional<Pose> T_a_b;
  double sigma_m = 0.0, sigma_rad = 0.0;  ///< standard deviations of T_a_b, each axis; 0: not stated
  double weight = 0.0;                    ///< weight in the pose graph
  std::string where;                      ///< file and line, for messages: "closures.csv:12"
};

/// Reads the first five columns, which are required, and kind, x...qw, sigma_m and sigma_rad where the file has them.
/// Verdict, reason and weight are results of an earlier run and are not read. Throws UserError naming file and line.
std::vector<ClosureRow> readClosures(const std::string& path);
/// Parses the content of such a file. `name` replaces the path in `where` and in errors.
std::vector<ClosureRow> parseClosures(std::string_view text, const std::string& name);

/// Prints header and rows with the columns of docs/files.md, in the given order; without `where` and the standard
/// deviations.
std::string printClosures(const std::vector<ClosureRow>& rows);

}  // namespace urban_nav_core
