// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav {

/// Returns by how much the right images are stamped later than the left ones (ns; negative: earlier) if that is
/// constant to 2 ms; nullopt for fewer than three images a side, or if it varies. Both in order of time.
std::optional<urban_nav_core::StampNs> constantDelay(const std::vector<urban_nav_core::StampNs>& left,
                                                     const std::vector<urban_nav_core::StampNs>& right);

}  // namespace urban_nav
