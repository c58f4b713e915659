// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// Returns by how much the right images are stamped later than the left ones (ns; negative: earlier) if that is
/// constant to 2 ms; nullopt for fewer than three images a side, or if it varies. Both in order of time.
std::optional<urban_nav_core::StampNs> constantDelay(const std::vector<urban_nav_core::StampNs>& left,
                                                     const std::vector<urban_nav_core::StampNs>& right);

/// Returns the end of a sentence ("; the right images are stamped ...") that states a constant delay of one side beyond
/// what is paired, and the parameter that takes it away; empty if there is none. Both in order of time.
std::string describeDelay(const std::vector<urban_nav_core::StampNs>& left,
                          const std::vector<urban_nav_core::StampNs>& right);

}  // namespace urban_nav_input
