// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace pose_graph {

/// Converts a non-negative index to the index type of standard containers.
constexpr std::size_t sz(int i) { return static_cast<std::size_t>(i); }

}  // namespace pose_graph
